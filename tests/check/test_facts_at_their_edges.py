# SPDX-License-Identifier: MIT
"""Hidden items, factors of feet, tolerances that meet, and calls that cannot be made."""

from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from tests.check.test_dimension_statements import lettered, says
from tests.check.test_engine import OF_DRAWINGS, check, drawing

from foparq.check import run as engine
from foparq.check.validate import validate_checks
from foparq.errors import ProfileError
from foparq.findings.outcome import Status
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.profile.load import load_profile


def test_hidden_are_items_of_model_space_that_are_not_seen() -> None:
    made = drawing(
        ["LINESTRING (0 0, 1 0)", "LINESTRING (0 2, 3 2)", "LINESTRING (0 4, 1 4)", "LINESTRING (9 9, 99 99)"],
        layers=["A", "B", "B", "C"], visible=[True, False, False, False],
    )  # fmt: skip
    paper = np.array([False, False, False, True])
    found = check(replace(made, items=replace(made.items, paper=paper)), "hidden-entities").findings
    assert (found.layer.tolist(), found.size.tolist()) == (["B"], [2.0])
    assert found.where[0].bounds == (0.0, 2.0, 3.0, 4.0)


@pytest.mark.parametrize(("factor", "metres"), [(1 / 12, 0.0254), (0.3048, 0.3048), (0.0254, 0.0254)])
def test_small_factors_that_a_pair_of_units_explains(factor: float, metres: float) -> None:
    pairs = [(1000.0 * n, f"{1000 * n * factor:.4f}") for n in (1, 2, 5)]
    assert says(lettered(*pairs)) == pytest.approx([metres])


@pytest.mark.parametrize(
    ("coincide", "reach", "fine"),
    [("1 mm", "1 mm", False), ("1 mm", "1.01 mm", True), ("2 mm", "1 mm", False), ("0.1 mm @ scale", "1 m", True)],
)
def test_reach_is_farther_than_coincide(tmp_path: Path, coincide: str, reach: str, fine: bool) -> None:  # noqa: FBT001
    path = tmp_path / "mine.toml"
    path.write_text(
        f'extends = "et-doc-foparq-a"\nname = "mine"\n[[check]]\nrule = "undershoot"\nseverity = "major"\n'
        f'coincide = "{coincide}"\nreach = "{reach}"\n',
        encoding="utf-8",
    )
    profile = load_profile(str(path))
    if fine:
        validate_checks(profile)
    else:
        with pytest.raises(ProfileError, match=r"profile\.reach"):
            validate_checks(profile)


def test_a_negative_tolerance_is_none_and_nothing_may_be(tmp_path: Path) -> None:
    for text, fine in (("-1 mm", False), ("0 mm", True)):
        path = tmp_path / "mine.toml"
        path.write_text(
            'extends = "et-doc-foparq-a"\nname = "mine"\n[[check]]\nrule = "zero-length"\nseverity = "minor"\n'
            f'coincide = "{text}"\n',
            encoding="utf-8",
        )
        if fine:
            validate_checks(load_profile(str(path)))
        else:
            with pytest.raises(ProfileError, match=r"profile\.tolerance-negative"):
                validate_checks(load_profile(str(path)))


def test_calls_that_cannot_be_made_end_no_audit(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> NoReturn:
        raise RuntimeError

    monkeypatch.setattr(engine, "calls_of", broken)
    checked = check(drawing(["LINESTRING (0 0, 1 0)", "LINESTRING (0.5 -0.004, 0.5 -1)"]))
    assert {found.name for found in checked.outcomes} == OF_DRAWINGS
    assert "undershoot" in checked.findings.name
    assert all(found.status in Status for found in checked.outcomes)


def test_a_rule_that_did_not_run_checked_and_found_nothing() -> None:
    unknown = DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN)
    outcomes = check(drawing(["LINESTRING (0 0, 1 0)", "LINESTRING (0.5 -0.004, 0.5 -1)"], unit=unknown)).outcomes
    idle = [found for found in outcomes if found.status is Status.NOT_RUN]
    assert len(idle) > 5
    assert {(found.checked, found.found, len(found.faulty)) for found in idle} == {(0, 0, 0)}


def test_a_triangle_drawn_as_a_closed_line_bounds_an_area() -> None:
    triangles = ["LINESTRING (0 0, 2 0, 0 2, 0 0)", "LINESTRING (0.5 0, 2.5 0, 0.5 2, 0.5 0)"]
    found = check(drawing(triangles, areas=("0",)), "area-overlap").findings
    assert found.size.tolist() == pytest.approx([1.5**2 / 2])
