# SPDX-License-Identifier: MIT
"""Several reasons at once: which decides, and that each is told."""

import numpy as np
import pytest
from tests.evaluate.deliveries import (
    counted,
    distances,
    drawing,
    drawn,
    judge,
    listed,
    messages,
    one,
    outcome,
    source,
    spec,
    surveyed,
)

from foparq.evaluate.balance import Balance
from foparq.evaluate.quality import ElementStatus
from foparq.findings.counts import FeatureCounts
from foparq.model.delivery import Delivery, SourceStatus
from foparq.units import Quantity

FAIL, UNDECIDED, NOT_ASSESSED = ElementStatus.FAIL, ElementStatus.UNDECIDED, ElementStatus.NOT_ASSESSED
HERE = drawn(drawing())
BAD = outcome("gap", range(90), checked=100)


def test_preview_names_the_rules_that_found_something() -> None:
    asked = spec("faulty-rate", rules=("gap", "overshoot", "undershoot"))
    outcomes = [
        outcome("gap", checked=100), outcome("overshoot", [1], checked=100, preview=True),
        outcome("undershoot", checked=100, preview=True),
    ]  # fmt: skip
    element = one(asked, delivery=HERE, outcomes=outcomes)
    preview = next(reason for reason in element.why if reason.message == "checks.preview")
    assert dict(preview.fields)["rules"] == ["overshoot"]
    # What a rule on trial checked is no part of the denominator.
    alone = [outcome("gap", checked=7), outcome("overshoot", [1], checked=100, preview=True)]
    assert one(asked, delivery=HERE, outcomes=alone).n == 7


@pytest.mark.parametrize(
    ("survey_sd", "missing", "resolution", "known"),
    [
        (None, 0, 0.0, ["survey-unknown"]), (0.2, 0, 0.0, ["survey-poor"]), (0.01, 1, 0.0, ["missing"]),
        (0.01, 0, 0.1, ["rounding"]), (None, 1, 0.1, ["survey-unknown", "missing", "rounding"]),
        (0.2, 1, 0.1, ["survey-poor", "missing", "rounding"]),
    ],
)  # fmt: skip
def test_every_open_question_of_an_rmse_is_told(
    survey_sd: float | None, missing: int, resolution: float, known: list[str]
) -> None:
    differences = np.where(np.arange(8) % 2, 0.2, -0.2)
    differences[:missing] = np.nan
    lengths = distances(differences, survey_sd=survey_sd, resolution=resolution)
    element = one(spec("relative", limit=Quantity(0.25, "m")), delivery=surveyed(lengths=lengths))
    assert (element.status, messages(element)) == (UNDECIDED, [f"relative.{case}" for case in known])


def test_a_lost_list_is_undecided_and_no_list_is_not_assessed() -> None:
    asked = (spec("omission"), spec("commission"))
    lost = Delivery(title="", sources=(source("a.dxf"), source("f.csv", "features", SourceStatus.REFUSED)))
    for delivery, status, message in ((lost, UNDECIDED, "features.lost"), (HERE, NOT_ASSESSED, "features.no-list")):
        for element in judge(*asked, delivery=delivery).elements:
            assert (element.status, messages(element)) == (status, [message])


def test_no_classes_no_drawing_and_no_counts_are_told_apart() -> None:
    rows = listed(("window", "N", 3))
    asked = spec("omission")
    plain = drawn(drawing(), features=rows)
    bound = drawn(drawing(classes={"J": "window"}), features=rows)
    cases = [
        (drawn(features=rows), "checks.no-drawing"), (plain, "features.no-classes"), (bound, "features.not-counted"),
        (drawn(features=rows, lost=["b.dxf"]), "unseen.file"),
        (drawn(drawing(classes={"J": "window"}, metres=None), features=rows), "features.unit-unknown"),
    ]  # fmt: skip
    assert [messages(one(asked, delivery=delivery, counts=None))[0] for delivery, _ in cases] == [m for _, m in cases]


def test_hidden_layers_hold_back_only_what_they_could_mend() -> None:
    rows = listed(("window", "N", 100), ("door", "N", 100))
    delivery = drawn(drawing(classes={"J": "window", "P": "door"}), features=rows)

    def with_hidden(*hidden: tuple[str, str, str], doors: int) -> ElementStatus:
        made = counted(("window", "N", 80), ("door", "N", doors))
        counts = FeatureCounts(
            feature_class=made.feature_class, facade=made.facade, count=made.count, hidden=tuple(hidden)
        )
        return one(spec("omission"), delivery=delivery, counts=counts).status

    assert with_hidden(doors=100) is FAIL
    assert with_hidden(("window", "N", "J2"), doors=100) is UNDECIDED
    assert with_hidden(("window", "N", "J2"), doors=80) is FAIL
    assert with_hidden(("window", "S", "J2"), doors=100) is FAIL


@pytest.mark.parametrize(
    ("balance", "missing", "least", "net", "surplus", "most"),
    [
        ({"required": 5, "delivered": 3}, 2, 2, 2, 0, 0),
        ({"required": 5, "delivered": 3, "pieces": 4, "accepted": 1}, 2, 1, 1, 0, 0),
        ({"required": 5, "delivered": 3, "pieces": 9, "accepted": 9}, 2, 0, 0, 0, 0),
        ({"required": 5, "optional": 2, "delivered": 9, "most": 12}, 0, 0, 0, 2, 5),
        ({"required": 5, "optional": 2, "delivered": 6, "most": 7}, 0, 0, 0, 0, 0),
        ({"delivered": 4, "most": 2, "pieces": 2}, 0, 0, 0, 4, 4),
    ],
)
def test_numbers_of_a_balance(
    balance: dict[str, int], missing: int, least: int, net: int, surplus: int, most: int
) -> None:
    row = Balance(feature_class="window", facade="N", **balance)
    assert (row.missing, row.missing_least, row.missing_net, row.surplus, row.surplus_most) == (
        missing, least, net, surplus, most,
    )  # fmt: skip
    assert row.label == "window / N"
    assert Balance(feature_class="window", facade="").label == "window"
