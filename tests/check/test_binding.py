# SPDX-License-Identifier: MIT
"""Linework is drawn twice within what binds, and shared between what does not; what repeats another joins nothing."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import shapely
from tests.evaluate.deliveries import drawing, drawn, one, parameter

from foparq.check.run import Checked, check_part
from foparq.evaluate.quality import Element, ElementStatus
from foparq.model.drawing import Drawing
from foparq.profile.load import load_profile

PROFILE = load_profile("et-doc-foparq-a")
SCALE = 50.0  # coincide 0.5 mm, reach 10 mm
Q3 = next(element for element in PROFILE.elements if element.id == "Q3")
Line = tuple[str, Sequence[tuple[float, float]]]

BEAM: Line = ("VIGA", [(0, 3), (4, 3)])
SILL: Line = ("PISO", [(0, 0), (4, 0)])
POST: Line = ("PILAR", [(2, 0), (2, 2.9937)])
FRAME = [BEAM, SILL, ("PILAR", [(0, 0), (0, 3)]), ("PILAR", [(4, 0), (4, 3)])]


def sketch(lines: Sequence[Line], **said: object) -> Drawing:
    """Lines by layer, in the plane xz."""
    made = drawing("a.dxf", n=len(lines))
    shapes, layers = np.empty(len(lines), dtype=object), np.empty(len(lines), dtype=object)
    shapes[:] = [shapely.LineString([(x, 0.0, z) for x, z in line]) for _, line in lines]
    layers[:] = [layer for layer, _ in lines]
    return replace(made, items=replace(made.items, geometry=shapes, layer=layers), **said)  # type: ignore[arg-type]


def checked(lines: Sequence[Line], **said: object) -> Checked:
    found = check_part(sketch(lines, **said), PROFILE, SCALE)
    assert not found.log
    return found


def counts(lines: Sequence[Line], **said: object) -> dict[str, int]:
    return dict(Counter(checked(lines, **said).findings.name.tolist()))


def q3(lines: Sequence[Line], **said: object) -> Element:
    part = sketch(lines, **said)
    return one(Q3, delivery=drawn(part), outcomes=check_part(part, PROFILE, SCALE).outcomes, scale=SCALE)


@pytest.mark.parametrize("whole", [True, False], ids=["whole", "a stretch"])
@pytest.mark.parametrize(("same_layer", "same_class", "bound"), [
    (True, False, False), (False, True, False), (False, False, True), (True, True, True), (False, False, False),
])  # fmt: skip
def test_a_fault_within_what_binds_and_a_note_beside_it(
    *, same_layer: bool, same_class: bool, bound: bool, whole: bool
) -> None:
    second = "CAIXILHO" if same_layer else "CANTARIA"
    lines = [("Caixilho", [(0, 0), (2, 0), (2, 1)]), (second, [(2, 1), (2, 0), (0, 0)][: 3 if whole else 2])]
    if not whole:
        lines[1] = (second, [(2, 0.9), (2, 0), (0.1, 0)])
    classes = {"CAIXILHO": "janela", "CANTARIA": "Janelas"} if same_class else {}
    bind = (("caix*", "cant*"),) if bound else ()
    found = counts(lines, classes=classes, bind=bind)
    fault = "duplicate" if whole else "line-overlap"
    told = {"duplicate", "line-overlap", "shared-edge"} & set(found)
    assert told == {fault if same_layer or same_class or bound else "shared-edge"}
    assert all(found[name] == 1 for name in told)


def test_what_binds_with_the_same_binds_with_each_other() -> None:
    lines: list[Line] = [("A", [(0, 0), (3, 0)]), ("C", [(3, 0), (0, 0)])]
    assert counts(lines, bind=(("A", "B"), ("B", "C")))["shared-edge"] == 1, "no layer B is there to join them"
    both = [*lines, ("B", [(9, 9), (12, 9)])]
    assert "duplicate" in counts(both, bind=(("A", "B"), ("B", "C")))


def test_one_pattern_for_everything() -> None:
    lines: list[Line] = [("A", [(0, 0), (3, 0)]), ("B", [(3, 0), (0, 0)])]
    assert "shared-edge" in counts(lines)
    assert "duplicate" in counts(lines, bind=(("*",),))


WHOLE = {
    "alike": [POST[1]],
    "backwards": [POST[1][::-1]],
    "a hair aside": [[(2.0004, 0), (2.0004, 2.9937)]],
    "with a vertex": [[(2, 0), (2, 1), (2, 2.9937)]],
    "twice": [POST[1], POST[1]],
}
#: on the post's own layer these are line overlaps
IN_PART = {
    "its upper part": [[(2, 1), (2, 2.9937)]],
    "longer below": [[(2, -1), (2, 2.9937)]],
    "in two": [[(2, 0), (2, 1.3)], [(2, 1.3), (2, 2.9937)]],
}


@pytest.mark.parametrize(
    ("layer", "copy"),
    [
        *(pytest.param("PILAR", copy, id=f"own layer, {name}") for name, copy in WHOLE.items()),
        *(pytest.param("COPIA", copy, id=name) for name, copy in {**WHOLE, **IN_PART}.items()),
    ],
)
def test_a_post_drawn_twice_does_not_hold_itself(layer: str, copy: list[list[tuple[float, float]]]) -> None:
    """It stops 6.3 mm short of the beam, whatever layer draws it again."""
    found = checked([*FRAME, POST, *((layer, line) for line in copy)]).findings
    short = found.name == "undershoot"
    assert np.round(found.size[short], 6).tolist() == [0.0063]
    assert found.place[short][:, [0, 2]].tolist() == [pytest.approx([2.0, 2.9937], abs=0.0005)]


def test_what_rests_on_a_line_that_two_layers_draw_stays_connected() -> None:
    post: Line = ("PILAR", [(2, 0), (2, 3)])
    found = counts([*FRAME, ("FORRO", BEAM[1]), post])
    assert found == {"shared-edge": 1}


def test_three_layers_tell_every_pair_and_judge_one() -> None:
    lines = [*FRAME, POST, ("B", POST[1]), ("C", POST[1])]
    assert counts(lines) == {"shared-edge": 3, "undershoot": 1}


def test_copies_on_other_layers_dilute_no_rate() -> None:
    """Two of five are at fault; copies of the sound ones, whole or nearly, hide nothing."""
    short = ("PILAR", [(3, 0), (3, 2.9937)])
    lines: list[Line] = [BEAM, SILL, FRAME[2], POST, short]
    alone = q3(lines)
    again = [(f"COPIA {n}", [line[0], line[1]]) for n in range(30) for _, line in lines[:3]]
    nearly = [("QUASE", [(0.001, 3), (3.999, 3)]), ("QUASE", [(0.001, 0), (3.999, 0)])]
    hidden = q3([*lines, *again, *nearly])
    assert (alone.status, alone.value, alone.n) == (ElementStatus.FAIL, pytest.approx(2 / 5), 5)
    assert (hidden.status, hidden.value, hidden.n) == (alone.status, alone.value, alone.n)
    assert parameter(hidden, "drawn-again") == 92.0


def test_every_record_names_both_layers() -> None:
    lines: list[Line] = [("CANTARIA", [(0, 0), (3, 0)]), ("REBOCO", [(1, 0), (2, 0)])]
    found = checked(lines).findings
    (row,) = np.flatnonzero(found.name == "shared-edge")
    assert (found.layer[row], found.other_layer[row]) == ("REBOCO", "CANTARIA")
