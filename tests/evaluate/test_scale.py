# SPDX-License-Identifier: MIT
"""The stated scale against the product's, and against what sheets say."""

from dataclasses import replace
from typing import Any

import pytest
from tests.evaluate.deliveries import drawing, drawn

from foparq.evaluate.evidence import Evidence
from foparq.evaluate.scale import scale_doubts
from foparq.model.drawing import StatedScale
from foparq.model.statements import Confirmation
from foparq.profile.load import load_profile

PROFILE = load_profile("et-doc-foparq-a")


def said(
    scale: float | None, *stated: StatedScale, metres: float | None = 1.0, **given: Any
) -> tuple[list[str], list[str]]:
    """Doubts and remarks on a scale, beside one drawing that states these."""
    one = drawing(n=1, metres=metres)
    delivery = replace(drawn(replace(one, reading=replace(one.reading, scales=stated))), **given)
    doubts, remarks = scale_doubts(PROFILE, Evidence(delivery=delivery, outcomes=(), counts=None, scale=scale))
    return [reason.message for reason in doubts], [reason.message for reason in remarks]


def lettered(denominator: float) -> StatedScale:
    return StatedScale(witness="lettering", said=f"ESC 1:{denominator:g}", denominator=denominator)


def viewport(ratio: float) -> StatedScale:
    return StatedScale(witness="viewport", said="VIEWPORT 2F", ratio=ratio)


@pytest.mark.parametrize("scale", [1.0, 20.0, 200.0, None])
def test_scales_of_the_product_are_beyond_doubt_the_ends_included(scale: float | None) -> None:
    assert said(scale) == ([], [])


@pytest.mark.parametrize("scale", [0.99, 200.5, 500.0])
def test_scales_beyond_it_are_doubtful_until_somebody_answers_for_them(scale: float) -> None:
    assert said(scale) == (["scale.unusual"], [])
    for value, left in (
        (f"1:{scale:g}", []),
        (f"1 / {scale:g}", []),
        ("1:50", ["scale.unusual"]),
        ("?", ["scale.unusual"]),
    ):
        one = Confirmation(what="scale", value=value, by="a name", reason="a reason")
        assert said(scale, confirmed=(one,))[0] == left


def test_one_witness_is_a_remark_and_two_are_a_doubt() -> None:
    assert said(50.0, lettered(100)) == ([], ["scale.contradicted"])
    assert said(50.0, viewport(0.1)) == ([], ["scale.contradicted"])
    assert said(50.0, lettered(100), viewport(0.1)) == (["scale.contradicted"], [])
    assert said(50.0, lettered(100), viewport(0.05)) == ([], ["scale.contradicted"])


def test_a_sheet_with_details_names_the_stated_scale_too() -> None:
    assert said(50.0, lettered(10), lettered(50), lettered(20), viewport(0.01), viewport(0.0502)) == ([], [])


def test_a_viewport_is_read_in_the_unit_of_the_drawing() -> None:
    assert said(50.0, viewport(50.0), metres=0.001) == ([], [])
    assert said(50.0, viewport(0.05), metres=0.001) == ([], ["scale.contradicted"])
    assert said(50.0, viewport(0.05), metres=None) == ([], [])
