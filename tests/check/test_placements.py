# SPDX-License-Identifier: MIT
"""Windows looked for where the list has them."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from tests.check.windows import FAIL, GAP, METRES, PASS, PLACES, UNDECIDED, drawing, frame
from tests.evaluate.deliveries import drawn, judge, listed, messages, spec

from foparq.check.drawn.placements import count_listed
from foparq.evaluate.quality import ClassBalance, QualityReport
from foparq.findings.counts import Listed
from foparq.model.drawing import Drawing, DrawingUnit, UnitOrigin
from foparq.model.plane import plane_of
from foparq.model.tables import FeatureList
from foparq.read.table.tables import read_feature_list

NEAR = 0.05
MIDDLES = np.array([(x + 0.5, y + 0.75) for x, y in PLACES])


def placed(axes: str = "xy", tol: float = np.nan, middles: np.ndarray = MIDDLES) -> FeatureList:
    """A list of windows with the middle of each, in two axes."""
    table = listed(*[("window", "N", 1)] * len(middles))
    place = np.full((len(middles), 3), np.nan)
    for column, axis in zip(middles.T, axes, strict=True):
        place[:, "xyz".index(axis)] = column
    return replace(table, place=place, tol=np.full(len(middles), tol))


def report(features: FeatureList, *drawings: Drawing) -> QualityReport:
    counts = count_listed(drawings, features=features, gap=GAP, near=NEAR)
    return judge(
        spec("commission", id="Q4"), spec("omission", id="Q5"), delivery=drawn(*drawings, features=features),
        counts=counts,
    )  # fmt: skip


def lies(features: FeatureList, *drawings: Drawing) -> list[str]:
    counts = count_listed(drawings, features=features, gap=GAP, near=NEAR)
    assert counts is not None
    assert counts.placements is not None
    return counts.placements.lies.tolist()


def window(told: QualityReport) -> ClassBalance:
    (balance,) = (balance for balance in told.balances if balance.feature_class == "window")
    return balance


def statuses(told: QualityReport) -> tuple[Any, ...]:
    return tuple(element.status for element in told.elements)


WINDOWS = [frame(*place) for place in PLACES]


def test_every_window_is_where_it_is_listed() -> None:
    told = report(placed(), drawing(WINDOWS))
    assert statuses(told) == (PASS, PASS)
    assert not window(told).only_counted
    assert lies(placed(), drawing(WINDOWS)) == [Listed.THERE] * 20


def test_one_missing_and_one_surplus_do_not_cancel() -> None:
    elsewhere = drawing([*WINDOWS[:18], frame(40, 0), frame(43, 0)])
    assert statuses(report(listed(("window", "N", 20)), elsewhere)) == (PASS, PASS), "by count they do"
    told = report(placed(), elsewhere)
    assert statuses(told) == (FAIL, FAIL)
    assert (window(told).missing, window(told).surplus) == ((2, 2), (2, 2))
    assert window(told).absent == ("F18", "F19")
    assert "features.absent" in messages(told.elements[1])


def test_another_class_stands_there() -> None:
    shapes, layers = [*WINDOWS[:19], frame(*PLACES[19])], ["JANELA"] * 19 + ["PORTA"]
    thing = drawing(shapes, layer=layers, classes={"JANELA": "window", "PORTA": "door"})
    told = report(placed(), thing)
    assert (window(told).absent, window(told).other) == (("F19",), ("F19",))


@pytest.mark.parametrize(("tol", "there"), [(0.2, False), (0.3, True), (np.nan, False)])
def test_the_tolerance_says_how_far_a_window_may_lie(tol: float, *, there: bool) -> None:
    aside = drawing([*WINDOWS[:19], frame(PLACES[19][0] + 0.75, PLACES[19][1])])
    assert (lies(placed(tol=tol), aside)[19] == Listed.THERE) is there


@pytest.mark.parametrize("axes", ["xz", "yz", "xy"])
def test_a_flat_drawing_is_seen_in_the_axes_of_the_list(axes: str) -> None:
    assert set(lies(placed(axes), drawing(WINDOWS))) == {Listed.THERE}


@pytest.mark.parametrize(("plane", "order"), [("xz", (0, 2, 1)), ("yz", (2, 0, 1))])
@pytest.mark.parametrize("metres", [1.0, 0.001])
def test_axes_and_unit_of_the_drawing(plane: str, order: tuple[int, int, int], metres: float) -> None:
    flat = drawing(WINDOWS)
    upright = flat.items.geometry.copy()
    for n, shape in enumerate(upright):
        points = np.column_stack([shapely.get_coordinates(shape), np.full(5, 12.2)])
        upright[n] = shapely.LineString(points[:, list(order)] / metres)
    stood = replace(
        flat, items=replace(flat.items, geometry=upright), plane=plane_of(plane, upright),
        unit=DrawingUnit(metres=metres, name="", origin=UnitOrigin.STATED) if metres != 1.0 else METRES,
    )  # fmt: skip
    assert set(lies(placed(plane), stood)) == {Listed.THERE}


@pytest.mark.parametrize("shift", [(500.0, 0.0), (0.0, -40.0)])
def test_places_of_another_drawing_prove_nothing(shift: tuple[float, float]) -> None:
    features = placed(middles=MIDDLES + shift)
    told = report(features, drawing(WINDOWS))
    assert statuses(told) == (UNDECIDED, UNDECIDED)
    assert messages(told.elements[1])[0] == "features.elsewhere"
    assert window(told).only_counted
    assert statuses(report(features, drawing(WINDOWS[:10]))) == (UNDECIDED, FAIL), "ten are missing wherever they are"


def test_a_pane_where_a_window_is_listed_is_not_enough() -> None:
    shapes = [*WINDOWS[:19], frame(*PLACES[18], 0.1)]
    middles = MIDDLES.copy()
    middles[19] = MIDDLES[18]
    told = report(placed(middles=middles), drawing(shapes))
    assert window(told).unsure == ("F19",)
    assert window(told).missing == (0, 1)


def test_rows_without_a_place_are_counted() -> None:
    features = placed()
    place = features.place.copy()
    place[10:] = np.nan
    some = replace(features, place=place)
    assert statuses(report(some, drawing(WINDOWS))) == (PASS, PASS)
    less = report(some, drawing(WINDOWS[:17]))
    assert (window(less).missing, window(less).only_counted, window(less).absent) == ((3, 3), True, ())
    assert window(report(some, drawing(WINDOWS[2:]))).absent == ("F0", "F1")


def test_order_of_the_list_changes_nothing() -> None:
    thing = drawing([*WINDOWS[:17], frame(50, 50)])
    features, order = placed(), np.random.default_rng(1).permutation(20)
    turned = replace(
        features, id=features.id[order], place=features.place[order], feature_class=features.feature_class,
    )  # fmt: skip
    assert window(report(turned, thing)) == window(report(features, thing))


def test_columns_of_the_table(tmp_path: Path) -> None:
    path = tmp_path / "f.csv"
    path.write_text("id;classe;fachada;x;z;tol (mm)\nJ1;janela;N;1,25;2,5;150\nJ2;janela;N;;;\n", encoding="utf-8")
    features = read_feature_list(path)
    assert features.place[0].tolist() == pytest.approx([1.25, np.nan, 2.5], nan_ok=True)
    assert features.tol.tolist() == pytest.approx([0.15, np.nan], nan_ok=True)
    assert np.isnan(features.place[1]).all()
