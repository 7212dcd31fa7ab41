# SPDX-License-Identifier: MIT
"""The engine: what is set aside, what is not run, what a crash does, and what names a finding."""

import pickle
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
import pytest
import shapely

from foparq.check import run as engine
from foparq.check.bounds import Bounded, Broken, Budget
from foparq.check.drawn.features import count_features
from foparq.check.registry import all_rules, required_by
from foparq.check.run import Begun, Checked, Result, check_part, results_of
from foparq.check.subjects.drawing import DrawingSubject
from foparq.findings.because import Because
from foparq.findings.hits import Hits, hits
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Severity, join_findings
from foparq.model.drawing import Drawing, DrawingUnit, Reading, UnitOrigin
from foparq.model.inputs import Lines
from foparq.model.items import Items, Role
from foparq.model.part import Part
from foparq.model.plane import Plane, plane_of
from foparq.profile.adjust import choose
from foparq.profile.load import load_profile
from foparq.profile.schema import Profile

PROFILE = load_profile("et-doc-foparq-a")
#: names of the rules of the profile that look at drawings
OF_DRAWINGS = {rule.name for rule in all_rules().values() if DrawingSubject.knows(rule.subject)} & {
    spec.rule for spec in PROFILE.checks
}
METRES = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)


def drawing(
    shapes: Sequence[str | None],
    *,
    layers: Sequence[str] | None = None,
    role: str = Role.LINE,
    unit: DrawingUnit = METRES,
    plane: str = "xy",
    visible: Sequence[bool] | None = None,
    inserts: Sequence[str] | None = None,
    **said: object,
) -> Drawing:
    n = len(shapes)
    geometry = np.empty(n, dtype=object)
    with np.errstate(invalid="ignore"):  # some are no numbers
        geometry[:] = [None if shape is None else shapely.from_wkt(shape) for shape in shapes]
    names = np.array([f"{row:X}" for row in range(16, 16 + n)], dtype=object)
    roles = [Role.AREA if shape and shape.startswith("POLYGON") else role for shape in shapes]
    items = Items(
        geometry=geometry, layer=np.array(layers or ["0"] * n, dtype=object), kind=np.full(n, "LINE", dtype=object),
        role=np.array(roles, dtype=object), item=names, handle=names.copy(),
        inserts=np.array(inserts or [""] * n, dtype=object), colour=np.full(n, 256, dtype=np.int32),
        closed=np.zeros(n, dtype=bool), visible=np.array(visible or [True] * n, dtype=bool),
        paper=np.zeros(n, dtype=bool),
    )  # fmt: skip
    frame = plane_of(plane, geometry)
    return Drawing(path="a.dxf", items=items, reading=Reading(), unit=unit, plane=frame, **said)  # type: ignore[arg-type]


def check(thing: Drawing, *rules: str, scale: float = 50) -> Checked:
    return check_part(thing, choose(PROFILE, rules, required_by(rules)) if rules else PROFILE, scale)


def outcome(checked: Checked, name: str) -> Outcome:
    return next(found for found in checked.outcomes if found.name == name)


T_JUNCTION_4MM_SHORT = ["LINESTRING (0 0, 1 0)", "LINESTRING (0.5 -0.004, 0.5 -1)", "LINESTRING (0 0, 0.5 -1, 1 0)"]


def test_a_fault_has_place_size_item_layer_limit_and_unit() -> None:
    table = check(drawing(T_JUNCTION_4MM_SHORT), "undershoot").findings
    assert len(table) == 1
    assert table.item[0] == "11"
    assert table.other[0] == "10"
    assert table.size[0] == pytest.approx(0.004)
    assert (table.unit[0], table.limit[0], table.layer[0]) == ("m", 0.0005, "0")
    assert shapely.get_coordinates(table.where, include_z=True)[0] == pytest.approx([0.5, -0.004, 0])


def test_every_rate_has_its_denominator() -> None:
    found = outcome(check(drawing(T_JUNCTION_4MM_SHORT), "undershoot"), "undershoot")
    assert (found.status, found.checked, found.found, found.faulty.tolist()) == (Status.FAULTY, 3, 1, [1])
    parameters = {name: value for name, value, _ in found.parameters}
    assert (parameters["coincide"], parameters["reach"]) == (0.0005, 0.01)
    assert (parameters["ahead"], parameters["remainder"]) == (pytest.approx(np.pi / 3), 3.0)  # of [linework]


def test_units_of_the_file_come_back_in_the_place() -> None:
    in_mm = [
        shape.replace("0.5", "500").replace("-0.004", "-4").replace(" -1", " -1000").replace("1 0", "1000 0")
        for shape in T_JUNCTION_4MM_SHORT
    ]
    thing = drawing(in_mm, unit=DrawingUnit(metres=0.001, name="mm", origin=UnitOrigin.STATED))
    table = check(thing, "undershoot").findings
    assert table.size[0] == pytest.approx(0.004)
    assert shapely.get_coordinates(table.where)[0] == pytest.approx([500, -4])


@pytest.mark.parametrize(("plane", "lift"), [("xz", lambda x, y: (x, 7.0, y)), ("yz", lambda x, y: (7.0, x, y))])
def test_a_facade_is_checked_in_its_plane_and_found_in_space(plane: str, lift) -> None:  # noqa: ANN001
    shapes = []
    for shape in T_JUNCTION_4MM_SHORT:
        flat = shapely.get_coordinates(shapely.from_wkt(shape))
        shapes.append(shapely.LineString([lift(x, y) for x, y in flat]).wkt)
    table = check(drawing(shapes, plane=plane), "undershoot").findings
    assert len(table) == 1
    assert shapely.get_coordinates(table.where, include_z=True)[0] == pytest.approx(lift(0.5, -0.004))


def test_an_item_that_failed_a_required_rule_is_set_aside_and_counted() -> None:
    twice = ["LINESTRING (0 0, 1 0)", "LINESTRING (0 0, 1 0)", "LINESTRING (0 0, 0 1)"]
    checked = check(drawing(twice), "duplicate", "free-end")
    free = outcome(checked, "free-end")
    assert (free.checked, free.skipped) == (2, 1)
    assert free.found == 2, "the copy hides no free end: (1 0) and (0 1) are free"


def test_what_cannot_be_a_line_is_counted_as_skipped_and_found_invalid() -> None:
    broken = [None, "LINESTRING EMPTY", "LINESTRING (0 0, 1 0)"]
    checked = check(drawing(broken), "invalid-geometry", "free-end")
    assert outcome(checked, "invalid-geometry").faulty.tolist() == [0, 1]
    assert (outcome(checked, "free-end").checked, outcome(checked, "free-end").skipped) == (1, 2)


def test_an_item_beyond_all_distances_is_set_aside_and_changes_nothing_for_others() -> None:
    rules = ("undershoot", "duplicate", "self-intersection", "area-overlap")
    sound = check(drawing(T_JUNCTION_4MM_SHORT), *rules)
    for far in ("LINESTRING (9 9, 1e308 9)", "LINESTRING (9 9, -1e308 1e308)", "LINESTRING (9 9, 9 -1e200)"):
        checked = check(drawing([*T_JUNCTION_4MM_SHORT, far]), *rules)
        assert not checked.log
        assert checked.findings.key.tolist() == sound.findings.key.tolist()
        (aside,) = outcome(checked, "undershoot").aside
        assert (aside.item, aside.open) == ("13", True), "nobody judged it: whether it is sound stays open"


@pytest.mark.parametrize("plane", ["xy", "xz", "fit"])
@pytest.mark.parametrize("where", [-1e20, 1e20, -1e100, -1e14])
def test_an_item_absurdly_far_away_costs_others_no_digits(plane: str, where: float) -> None:
    upright = [shape.replace("(", "Z (").replace(",", " 0,").replace(")", " 0)") for shape in T_JUNCTION_4MM_SHORT]
    if plane != "xy":
        flat = [shapely.get_coordinates(shapely.from_wkt(shape)) for shape in T_JUNCTION_4MM_SHORT]
        upright = [shapely.LineString([(x, 0, y) for x, y in way]).wkt for way in flat]
    far = [f"LINESTRING Z (9 0 9, {where} 0 9)", f"LINESTRING Z (9 0 9, 9 {where} {where})"]
    alone = check(drawing(upright, plane=plane), "undershoot", "duplicate").findings
    table = check(drawing([*upright, *far], plane=plane), "undershoot", "duplicate").findings
    assert [(row, size) for row, size in zip(table.item, table.size, strict=True) if row in {"10", "11", "12"}] == [
        (row, pytest.approx(size)) for row, size in zip(alone.item, alone.size, strict=True)
    ]


def test_a_line_in_space_too_short_to_be_squared_has_a_place() -> None:
    checked = check(drawing(["LINESTRING Z (0 0 4.7, 1e-310 2e-310 4.7)", "LINESTRING Z (5 5 4.7, 6 5 4.7)"]))
    assert not checked.log
    assert outcome(checked, "zero-length").faulty.tolist() == [0]
    at = shapely.get_coordinates(checked.findings.where, include_z=True)[checked.findings.name == "zero-length"]
    assert at[0] == pytest.approx([0, 0, 4.7])


def test_without_a_unit_no_rule_with_a_length_runs() -> None:
    checked = check(drawing(T_JUNCTION_4MM_SHORT, unit=DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN)))
    for found in checked.outcomes:
        metric = any(unit in {"m", "m2"} for _, unit in all_rules()[found.rule].tolerances)
        assert (found.because == "unit-unknown") == metric
        if metric:
            assert (found.status, found.checked) == (Status.NOT_RUN, 0)


def test_a_doubted_header_stops_metric_rules_until_the_user_states_the_unit() -> None:
    header = DrawingUnit(
        metres=1.0, name="m", origin=UnitOrigin.HEADER, header="EPSG:3857", header_metres=1.0, stretch=1.56
    )
    thing = drawing(T_JUNCTION_4MM_SHORT, unit=header)
    doubted = check(thing)
    assert outcome(doubted, "unit-contradiction").status is Status.FAULTY
    assert outcome(doubted, "undershoot").because == "unit-doubtful"
    stated = check(replace(thing, unit=replace(header, origin=UnitOrigin.STATED)))
    assert outcome(stated, "undershoot").status is Status.FAULTY


def broken(_lines: object, **_tolerances: float) -> None:
    raise ZeroDivisionError("planted")


def test_a_crash_is_ours_and_ends_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    rules = dict(all_rules())
    code = next(code for code, rule in rules.items() if rule.name == "undershoot")

    rules[code] = replace(rules[code], check=broken)  # type: ignore[arg-type]
    monkeypatch.setattr(engine, "all_rules", lambda: rules)
    checked = check(drawing(T_JUNCTION_4MM_SHORT), "undershoot", "overshoot")
    assert outcome(checked, "undershoot").status is Status.CRASHED
    assert outcome(checked, "overshoot").status is Status.CLEAN
    assert "planted" in checked.log[0]
    assert len(checked.findings) == 0


def test_hidden_items_are_reported_and_not_checked() -> None:
    thing = drawing(T_JUNCTION_4MM_SHORT, layers=["0", "OFF", "0"], visible=[True, False, True])
    checked = check(thing)
    assert outcome(checked, "hidden-entities").found == 1
    assert outcome(checked, "undershoot").checked == 2
    assert outcome(checked, "undershoot").status is Status.CLEAN


def test_layers_apart_are_coverages_of_their_own() -> None:
    squares = ["POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", "POLYGON ((0.5 0, 2 0, 2 1, 0.5 1, 0.5 0))"]
    together = check(drawing(squares), "area-overlap")
    apart = check(drawing(squares, layers=["A*[1]", "B"]), "area-overlap")
    assert together.findings.size.tolist() == pytest.approx([0.5])
    assert len(apart.findings) == 0
    assert [found.checked for found in apart.outcomes if found.name == "area-overlap"] == [1, 1]


def test_closed_lines_bound_areas_only_where_the_manifest_says_so() -> None:
    rings = ["LINESTRING (0 0, 1 0, 1 1, 0 1, 0 0)", "LINESTRING (0.5 0, 2 0, 2 1, 0.5 1, 0.5 0)"]
    assert outcome(check(drawing(rings), "area-overlap"), "area-overlap").because == "nothing-to-check"
    assert check(drawing(rings, areas=("0",)), "area-overlap").findings.size.tolist() == pytest.approx([0.5])


def test_findings_do_not_depend_on_the_order_of_the_file() -> None:
    shapes = [
        *T_JUNCTION_4MM_SHORT,
        "LINESTRING (0 0, 1 0)",
        "LINESTRING (3 3, 4 4, 4 3, 3 4)",
        "LINESTRING (0.2 0.003, 0.2 1)",
    ]
    thing = drawing(shapes)
    order = np.random.default_rng(7).permutation(len(shapes))
    shuffled = replace(thing, items=thing.items.take(order))
    first, second = check(thing).findings, check(shuffled).findings
    assert first.key.tolist() == second.key.tolist()
    assert first.item.tolist() == second.item.tolist()


def test_keys_of_all_drawings_are_told_apart_however_often_tables_are_joined() -> None:
    twice = ["LINESTRING (0 0, 1 0)", "LINESTRING (0 0, 1 0)", "LINESTRING (0 0, 1 0)"]
    tables = [check(replace(drawing(twice), path=path)).findings for path in ("a.dxf", "b.dxf")]
    keys = join_findings([join_findings(tables)]).key.tolist()
    assert len(keys) == len(set(keys)) > 4


def test_input_columns_are_read_only() -> None:
    with pytest.raises(ValueError, match="read-only"):
        drawing(T_JUNCTION_4MM_SHORT).items.geometry[0] = None


def test_features_are_clusters_and_inserts() -> None:
    shapes = [
        "LINESTRING (0 0, 1 0)", "LINESTRING (1.004 0, 1.004 1)",  # 4 mm apart: one window, with an undershoot
        "LINESTRING (5 0, 6 0, 6 1, 5 0)",  # another window
        "LINESTRING (8 0, 9 0)", "LINESTRING (8 5, 9 5)",  # one block insert
        "LINESTRING (20 0, 21 0)",  # on a layer of no class
    ]  # fmt: skip
    thing = drawing(
        shapes,
        layers=["JANELA", "JANELA", "JANELA", "JANELA", "JANELA", "PAREDE"],
        inserts=["", "", "", "A1", "A1", ""],
        facade="N",
        classes={"janela*": "window", "PORTA": "door"},
    )
    counts = count_features([thing], gap=0.01)
    assert counts is not None
    # No layer matches PORTA: that is no evidence that doors are missing, the pattern may be misspelt.
    assert list(zip(counts.feature_class, counts.facade, counts.count, strict=True)) == [("window", "N", 3)]
    assert counts.unmapped == (("PAREDE", 1),)


def test_without_classes_nothing_is_counted() -> None:
    assert count_features([drawing(T_JUNCTION_4MM_SHORT)], gap=0.01) is None


@pytest.mark.parametrize("name", ["xy", "xz", "yz", "fit"])
def test_a_plane_takes_coordinates_there_and_back(name: str) -> None:
    points = np.random.default_rng(3).normal(size=(20, 3)) * [10, 5, 0.1] + [7.4e6, 4.4e5, 700]
    plane = plane_of(name, np.array([shapely.LineString(points)], dtype=object))
    assert plane.lift(plane.project(points, 0.001), 0.001) == pytest.approx(points, abs=1e-6)
    assert np.linalg.det(plane.frame) == pytest.approx(1)


def test_a_fitted_plane_of_a_facade_stands_upright() -> None:
    along = np.array([np.cos(0.3), np.sin(0.3), 0.0])
    corner = np.array([100.0, 50.0, 10.0])
    points = np.array([corner + u * along + np.array([0, 0, v]) for u in range(5) for v in range(3)])
    plane = plane_of("fit", np.array([shapely.LineString(points)], dtype=object))
    assert plane.up == pytest.approx((0, 0, 1))
    assert plane.right == pytest.approx(tuple(along))
    assert plane.project(points, 1.0)[:, 2] == pytest.approx(np.zeros(15), abs=1e-9)


def test_depth_of_a_facade_grows_towards_the_reader() -> None:
    plane = Plane("xz", (0, 0, 0), (1, 0, 0), (0, 0, 1))
    assert plane.project(np.array([[0.0, -2.0, 0.0]]), 1.0)[0, 2] == 2


# --- what rules require ----------------------------------------------------------------------------------------------

POST_TWICE = [
    "LINESTRING (0 0, 1 0)", "LINESTRING (0.5 -0.004, 0.5 -1)", "LINESTRING (0.5 -0.004, 0.5 -1)",
    "LINESTRING (0 0, 0.5 -1, 1 0)",
]  # fmt: skip


def without(*names: str) -> Profile:
    """The shipped profile less some rules."""
    checks = tuple(spec for spec in PROFILE.checks if spec.rule not in names)
    return PROFILE.model_copy(update={"checks": checks})


def test_a_chosen_rule_runs_with_what_it_requires_in_silence() -> None:
    checked = check(drawing(POST_TWICE), "undershoot")
    assert checked.findings.name.tolist() == ["undershoot"]
    assert outcome(checked, "duplicate").helper
    assert not outcome(checked, "undershoot").helper


def test_a_rule_whose_requirement_is_not_bound_is_not_run() -> None:
    found = outcome(check_part(drawing(POST_TWICE), without("duplicate"), 50), "undershoot")
    assert (found.status, found.because, found.names) == (Status.NOT_RUN, Because.REQUIRED_UNBOUND, ("duplicate",))


def test_a_rule_whose_requirement_is_bound_to_other_layers_is_not_run() -> None:
    checks = tuple(
        spec.model_copy(update={"layers": ("A*",)}) if spec.rule == "duplicate" else spec for spec in PROFILE.checks
    )
    thing = drawing(POST_TWICE, layers=["A1", "A2", "A2", "B"])
    found = outcome(check_part(thing, PROFILE.model_copy(update={"checks": checks}), 50), "undershoot")
    assert (found.because, found.names) == (Because.REQUIRED_UNBOUND, ("duplicate",))
    inside = drawing(POST_TWICE, layers=["A1", "A2", "A2", "a3"])
    checked = check_part(inside, PROFILE.model_copy(update={"checks": checks}), 50)
    assert outcome(checked, "undershoot").status is Status.FAULTY


def test_a_rule_whose_requirement_crashed_is_not_run(monkeypatch: pytest.MonkeyPatch) -> None:
    rules = dict(all_rules())
    rules["TOP001"] = replace(rules["TOP001"], check=broken)
    monkeypatch.setattr(engine, "all_rules", lambda: rules)
    checked = check(drawing(POST_TWICE), "undershoot", "self-intersection")
    assert outcome(checked, "undershoot").because is Because.REQUIRED_CRASHED
    assert outcome(checked, "self-intersection").status is Status.CLEAN


def test_what_rests_on_a_rule_that_did_not_run_does_not_run() -> None:
    unknown = DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN)
    checked = check(drawing(POST_TWICE, unit=unknown), "self-intersection")
    assert outcome(checked, "self-intersection").because is Because.UNIT_UNKNOWN


def test_items_set_aside_stay_as_linework_that_others_meet() -> None:
    # Two strokes of 0.3 mm, less than coincide, close a corner: without them its sides would end 0.6 mm apart.
    chain = [
        "LINESTRING (0 0, 1 0)", "LINESTRING (1 0, 1.0003 0)", "LINESTRING (1.0003 0, 1.0006 0)",
        "LINESTRING (1.0006 0, 2 0, 2 2, 0 2, 0 0)",
    ]  # fmt: skip
    checked = check(drawing(chain))
    assert outcome(checked, "zero-length").found == 2
    assert outcome(checked, "undershoot").skipped == 2
    assert {one.rule for one in outcome(checked, "undershoot").aside} == {"zero-length"}
    for name in ("undershoot", "overshoot", "free-end"):
        assert outcome(checked, name).found == 0


def severity_of(name: str, severity: Severity) -> Profile:
    """The shipped profile with another severity of one rule."""
    checks = tuple(
        spec.model_copy(update={"severity": severity}) if spec.rule == name else spec for spec in PROFILE.checks
    )
    return PROFILE.model_copy(update={"checks": checks})


NOT_FINITE = ["LINESTRING (0 0, 1 0)", "LINESTRING (0 1, nan 1)"]


def test_an_item_that_only_a_silent_rule_accuses_leaves_the_question_open() -> None:
    told = check(drawing(NOT_FINITE))
    assert not outcome(told, "duplicate").opens
    silent = check(drawing(NOT_FINITE), "duplicate")
    (aside,) = outcome(silent, "duplicate").aside
    assert (aside.item, aside.rule, aside.told) == ("11", "invalid-geometry", False)
    assert outcome(silent, "duplicate").opens


def test_an_item_that_a_note_accuses_leaves_the_question_open() -> None:
    noted = check_part(drawing(NOT_FINITE), severity_of("invalid-geometry", Severity.NOTE), 50)
    assert outcome(noted, "duplicate").opens


def test_a_copy_that_a_silent_rule_leaves_out_leaves_nothing_open() -> None:
    checked = check(drawing(POST_TWICE), "undershoot")
    assert outcome(checked, "undershoot").skipped == 1
    assert not outcome(checked, "undershoot").opens


def test_pieces_of_a_plan_at_several_heights_need_no_plane() -> None:
    level = ["LINESTRING Z (0 0 0, 3 0 0)", "LINESTRING Z (0 2 1, 3 2 1)", "LINESTRING Z (0 1 0.5, 3 1 0.5)"]
    for shapes, because in (
        (level, Because.RAN),
        ([*level, "LINESTRING Z (0 0 0, 0 0 3)"], Because.PLANE_DOUBTFUL),
        (["LINESTRING Z (0 0 0, 9 0 0)", "LINESTRING Z (0 0 3, 9 0 3)"], Because.PLANE_DOUBTFUL),
    ):
        thing = drawing(shapes)
        assumed = replace(thing, plane=plane_of(None, thing.items.geometry))
        assert outcome(check(assumed), "duplicate").because is because


def test_hits_on_items_set_aside_are_not_told() -> None:
    # A bow tie overlaps a sound area: the one that crosses itself is not judged, the pair of sound ones is.
    areas = [
        "POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))", "POLYGON ((0 0, 0.5 0, 0.5 1, 0 1, 0 0))",
        "POLYGON ((0.4 0, 0.9 0, 0.9 1, 0.4 1, 0.4 0))",
    ]  # fmt: skip
    checked = check(drawing(areas), "area-overlap")
    assert checked.findings.size.tolist() == pytest.approx([0.1])
    aside = outcome(checked, "area-overlap").aside
    assert [(one.item, one.layer, one.rule) for one in aside] == [("10", "0", "self-intersection")]


def test_an_area_with_a_defect_below_coincide_takes_part() -> None:
    # A spike of 0.05 mm that crosses itself on a square of 1 m2; half of it is covered by another.
    spike = "POLYGON ((0 0, 1 0, 1 1, 0.5 1, 0.50002 1.00005, 0.49998 1.00005, 0.5001 1, 0 1, 0 0))"
    assert not shapely.from_wkt(spike).is_valid
    checked = check(drawing([spike, "POLYGON ((0.5 0, 1.5 0, 1.5 1, 0.5 1, 0.5 0))"]))
    assert outcome(checked, "self-intersection").found == 0
    assert outcome(checked, "area-overlap").found == 1
    assert checked.findings.size[checked.findings.name == "area-overlap"].tolist() == pytest.approx([0.5], abs=1e-4)


ODD = {
    "no number": "LINESTRING (5 5, nan 6)", "infinite": "LINESTRING (5 5, inf 6)",
    "deep": "LINESTRING Z (5 5 3, 6 6 3)",
    "hole without vertices": "POLYGON ((8 8, 9 8, 9 9, 8 9, 8 8), EMPTY)", "empty": "POLYGON EMPTY",
    "hole outside, deep": "POLYGON Z ((8 8 4, 9 8 4, 9 9 4, 8 9 4, 8 8 4), (20 20 4, 21 20 4, 21 21 4, 20 20 4))",
    "no number, deep": "LINESTRING Z (5 5 nan, 6 6 2)", "bow tie": "POLYGON ((8 8, 9 9, 9 8, 8 9, 8 8))",
    "beyond numbers": "POLYGON ((1e308 -1e308, 9 8, 9 9, 1e308 -1e308))",
}  # fmt: skip


@pytest.mark.parametrize("odd", [*ODD, "all of them"])
def test_an_odd_item_changes_nothing_for_the_others(odd: str) -> None:
    good = ["POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", "POLYGON ((0.9 0, 2 0, 2 1, 0.9 1, 0.9 0))", *T_JUNCTION_4MM_SHORT]
    shapes = list(ODD.values()) if odd == "all of them" else [ODD[odd]]
    alone, beside = check(drawing(good)), check(drawing([*good, *shapes]))
    assert not beside.log
    assert not [found for found in beside.outcomes if found.status is Status.CRASHED]
    ours = [n for n, item in enumerate(beside.findings.item) if int(item, 16) < 16 + len(good)]
    assert set(alone.findings.key) == set(beside.findings.key[ours])


@pytest.mark.parametrize(
    "empty",
    [drawing([]), drawing(T_JUNCTION_4MM_SHORT, visible=[False] * 3), drawing(["POINT (0 0)"], role=Role.ANNOTATION)],
    ids=["no item", "none visible", "lettering only"],
)
def test_a_drawing_without_anything_to_check_crashes_no_rule(empty: Drawing) -> None:
    checked = check(empty)
    assert checked.log == ()
    geometric = [found for found in checked.outcomes if not found.about_file]
    assert {found.because for found in geometric} == {Because.NOTHING}


def test_every_finding_has_one_place_on_its_fault() -> None:
    u_shaped = "POLYGON ((0 0, 3 0, 3 3, 2 3, 2 1, 1 1, 1 3, 0 3, 0 0))"
    checked = check(drawing([u_shaped, u_shaped]), "area-overlap")
    (where,), (place,) = checked.findings.where, checked.findings.place
    assert shapely.intersects(where, shapely.Point(place))


def test_findings_cross_processes_whole() -> None:
    table = check(drawing(POST_TWICE)).findings
    back = pickle.loads(pickle.dumps(table))
    for column in fields(table):
        one, two = getattr(table, column.name), getattr(back, column.name)
        assert one.dtype == two.dtype
        assert one.tolist() == two.tolist() or (
            column.name in {"limit", "place"} and np.array_equal(one, two, equal_nan=True)
        )


# --- bounds ----------------------------------------------------------------------------------------------------------


def stopping_at(name: str, broken: Broken) -> Bounded:
    """A run that is stopped whenever it comes to one rule."""

    def run(function: Callable[..., Iterator[object]], args: tuple, budget: Budget) -> Iterator[object]:
        assert budget.at_once < budget.seconds
        for event in function(*args):
            yield event
            if isinstance(event, Begun) and event.outcome.name == name:
                yield broken
                return

    return run


def test_a_rule_that_exceeds_its_bounds_is_stopped_and_the_others_run() -> None:
    thing = drawing(POST_TWICE)
    whole = check(thing)
    bounded = check_part(thing, PROFILE, 50, bounded=stopping_at("self-intersection", Broken(Because.LIMIT)))
    stopped = outcome(bounded, "self-intersection")
    assert (stopped.status, stopped.because) == (Status.NOT_RUN, Because.LIMIT)
    assert outcome(bounded, "gap").because is Because.NOTHING
    assert bounded.findings.key.tolist() == whole.findings.key.tolist()
    assert len(bounded.outcomes) == len(whole.outcomes)


def test_what_requires_a_stopped_rule_is_not_run() -> None:
    bounded = check_part(drawing(POST_TWICE), PROFILE, 50, bounded=stopping_at("duplicate", Broken(Because.LIMIT)))
    for name in ("undershoot", "overshoot", "free-end", "line-overlap"):
        assert outcome(bounded, name).because is Because.REQUIRED_NOT_RUN


def test_a_child_that_fails_is_a_crash_with_its_last_words() -> None:
    broken = Broken(Because.CRASHED, "exit status -11")
    bounded = check_part(drawing(POST_TWICE), PROFILE, 50, bounded=stopping_at("duplicate", broken))
    assert outcome(bounded, "duplicate").status is Status.CRASHED
    assert bounded.log == ("exit status -11",)


def test_a_part_whose_inputs_exceed_the_bounds_has_no_rule_run() -> None:
    def at_once(function: object, args: object, budget: object) -> Iterator[object]:  # noqa: ARG001 - the protocol
        yield Broken(Because.LIMIT)

    bounded = check_part(drawing(POST_TWICE), PROFILE, 50, bounded=at_once)
    assert {found.because for found in bounded.outcomes} == {Because.LIMIT}
    assert len(bounded.outcomes) == len(OF_DRAWINGS)


@pytest.mark.parametrize("told", range(1, 19))
def test_every_check_has_an_outcome_wherever_a_run_breaks_off(told: int) -> None:
    def run(function: Callable[..., Iterator[object]], args: tuple, budget: Budget) -> Iterator[object]:  # noqa: ARG001 - the protocol
        results = 0
        for event in function(*args):
            yield event
            results += isinstance(event, Result)
            if results == told:
                yield Broken(Because.LIMIT)
                return

    areas = ["POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", "POLYGON ((2 0, 3 0, 3 1, 2 1, 2 0))"]
    thing = drawing(areas, layers=["A", "B"])
    bounded = check_part(thing, PROFILE, 50, bounded=run)
    assert {found.name for found in bounded.outcomes} == OF_DRAWINGS
    names = [event.outcome.name for event in results_of(thing, PROFILE, 50, ()) if isinstance(event, Result)]
    # Of a rule that runs layer by layer, nobody knows whether the last layer was done.
    begun = set(names[:told]) - ({names[told - 1]} & {"area-overlap", "gap"})
    stopped = sorted(found.name for found in bounded.outcomes if found.because is Because.LIMIT)
    assert stopped == sorted(set(names) - begun)
    assert sorted(found.name for found in bounded.outcomes) == sorted([*names[:told], *stopped])


def test_time_is_that_of_the_processor(monkeypatch: pytest.MonkeyPatch) -> None:
    def waiting(lines: Lines, **_tolerances: float) -> Hits:
        time.sleep(0.3)
        return hits(np.empty(0, dtype=np.intp), lines.geometry[:0], np.empty(0))

    rules = dict(all_rules())
    rules["TOP001"] = replace(rules["TOP001"], check=waiting)
    monkeypatch.setattr(engine, "all_rules", lambda: rules)
    assert outcome(check(drawing(POST_TWICE), "duplicate"), "duplicate").seconds < 0.2


def test_a_part_of_no_known_kind_crashes_every_rule_and_ends_nothing() -> None:
    @dataclass(frozen=True, kw_only=True)
    class Odd(Part):
        features = 0
        vertices = 0

    checked = check_part(Odd(path="x"), PROFILE, 50)
    assert {found.status for found in checked.outcomes} == {Status.CRASHED}
    assert len(checked.log) == 1


def test_memory_that_runs_out_is_a_limit_and_no_crash(monkeypatch: pytest.MonkeyPatch) -> None:
    def greedy(_lines: object, **_tolerances: float) -> None:
        raise MemoryError

    rules = dict(all_rules())
    rules["TOP001"] = replace(rules["TOP001"], check=greedy)  # type: ignore[arg-type]
    monkeypatch.setattr(engine, "all_rules", lambda: rules)
    checked = check(drawing(POST_TWICE), "duplicate")
    assert (outcome(checked, "duplicate").because, checked.log) == (Because.LIMIT, ())


def test_one_rising_line_among_many_does_not_turn_a_drawing() -> None:
    many = [f"LINESTRING ({n} 0, {n} 5)" for n in range(200)]
    rising = "LINESTRING Z (0 9 0, 1 9 1000)"
    checked = check(drawing([*many, rising]), "undershoot")
    assert outcome(checked, "undershoot").because is Because.RAN
    few = check(drawing([*many[:20], rising]), "undershoot")
    assert outcome(few, "undershoot").because in {Because.PLANE_DOUBTFUL, Because.PLANE_CONTRADICTED}


@pytest.mark.parametrize("name", ["xy", "xz", "yz"])
@pytest.mark.parametrize("holes", ["", ", (2 2 0, 2 3 0, 3 3 0, 2 2 0)"])
@pytest.mark.parametrize("ends", [(1, 0), (0, 1)])
def test_a_ring_that_closes_in_plan_only_is_open_in_an_elevation(name: str, holes: str, ends: tuple[int, int]) -> None:
    """Its item alone is not judged as an area."""
    ring = f"POLYGON Z ((0 0 {ends[0]}, 9 0 0, 9 9 5, 0 9 5, 0 0 {ends[1]}){holes})"
    others = [f"POLYGON Z (({x} 20 0, {x + 1} 20.5 0, {x + 1} 21 3, {x} 20 0))" for x in range(3)]
    thing = drawing([*others, ring])
    # The areas lie aslant, which no named plane shows well: that is another question, and somebody has answered it.
    plane = plane_of(name, thing.items.geometry)
    checked = check(replace(thing, plane=plane, areas=("*",), confirmed=frozenset({"plane"})))
    assert not checked.log
    judged = outcome(checked, "area-overlap")
    assert [one.item for one in judged.aside] == ([] if name == "xy" else [thing.items.item[3]])


def test_a_depth_beyond_numbers_does_not_hide_how_wide_a_drawing_is() -> None:
    # In metres the depth of the plan is larger than any number; in the plane it is 40 by 40, and the posts 1 m high.
    km = DrawingUnit(metres=1000.0, name="km", origin=UnitOrigin.STATED)
    plan = [f"LINESTRING Z (0 {n}e-3 1e306, 40e-3 {n}e-3 1e306)" for n in range(41)]
    posts = [f"LINESTRING Z ({n}e-4 20e-3 0, {n}e-4 20e-3 1e-3)" for n in range(200, 202)]
    checked = check(drawing([*plan, *posts], unit=km), "undershoot")
    assert outcome(checked, "undershoot").because is Because.RAN
    alone = check(drawing(posts, unit=km), "undershoot")
    assert outcome(alone, "undershoot").because is Because.PLANE_DOUBTFUL
