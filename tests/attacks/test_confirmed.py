# SPDX-License-Identifier: MIT
"""A person who confirms a statement by name decides a doubt, and is printed with the verdict."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests.attacks import facades  # noqa: F401 - enters its attacks
from tests.attacks.evidence import both, redrawn
from tests.attacks.kinds import ATTACKS, BY_ID, BY_NAME, DXF
from tests.attacks.statements import MODERN
from tests.tools.offices import FRAMES, STYLES, Office, office
from tests.tools.sound import audited

from foparq.audit import Audit

WHO = {"by": "Revisora responsável", "reason": "vistoria de 12 de março"}


def _above(made: Office) -> Office:
    return both(made, np.arange(2), np.array([0, 3.0, 0]))


def _long(made: Office) -> Office:
    return made.change(measured=made.measured + 500, lengths=made.lengths + 500)


def _two_witnesses(made: Office) -> Office:
    """Metres, beside a header and lettering that say millimetres."""
    return made.change(header=4, letter_suffix=" mm")


def _scale(made: Office) -> Office:
    return made.change(title_scale=500, view_scale=500)


def _fine(made: Office) -> Office:
    """The scale of a sheet for a study of the whole front: beyond those of the product, and larger errors with it."""
    return made.change(title_scale=250, view_scale=250).state("delivery", scale="1:250")


#: what is confirmed, its value, what makes it doubtful, and the deliveries
DOUBTS = {
    "points": ("checkpoints", "not drawn", _above, BY_ID),
    "distances": ("distances", "not drawn", _long, BY_NAME),
    "unit": ("unit", "m", _two_witnesses, {**MODERN, "unit": "m", "lettering": "m"}),
    "scale of the sheet": ("scale", "", _scale, {**MODERN, "title": True}),
    "scale beyond the product": ("scale", "1:250", _fine, {**DXF, "scale": 100}),
}


def printed(done: Audit) -> list[dict[str, object]]:
    quality = done.record.quality
    said = (*quality.why, *quality.remarks)
    told = [dict(reason.fields) for reason in said if reason.message == "verdict.confirmed"]
    return [{name: value for name, value in fields.items() if name != "when" or value} for fields in told]


@pytest.mark.parametrize("name", DOUBTS)
def test_a_doubt_passes_when_it_is_confirmed(name: str, tmp_path: Path) -> None:
    what, value, doubt, wishes = DOUBTS[name]
    change: Callable[[Office], Office] = doubt
    wrong = {}
    for seed in range(10):
        made = change(office(2000 + seed, **{"n": 9, **wishes}))
        said = {"what": what, "value": value or f"1:{made.scale}", **WHO}
        before = audited(made, tmp_path / f"{seed}-doubtful").record.quality.verdict
        done = audited(made.change(confirmed=(said,)), tmp_path / f"{seed}-confirmed")
        if (before, done.record.quality.verdict, printed(done)) != ("undecided", "accepted", [said]):
            wrong[seed] = (str(before), str(done.record.quality.verdict), done.record.quality.why)
    assert not wrong


def _aside(made: Office) -> Office:
    return redrawn(made, lambda spots: spots + np.array([0.07, 0.11, 0.0]))


def _mirrored(made: Office) -> Office:
    return redrawn(made, lambda spots: np.array([made.facade.width, 0, 0]) + spots * [-1, 1, 1])


def _exchanged(made: Office) -> Office:
    return made.change(delivered=made.columns[:, [1, 0, 2]], surveyed=made.surveyed[:, [1, 0, 2]])


def _other_lengths(made: Office) -> Office:
    """Lengths that are not those between ends which are in the drawing."""
    longer = np.linspace(0.3, 2.0, len(made.lengths))
    return made.change(measured=made.measured + longer, lengths=made.lengths + longer)


#: what is confirmed as "not drawn", what is drawn all the same, and the element that must stay open
REFUTED = {
    "points beside a drawing that was moved": ("checkpoints", _aside, "Q1-X"),
    "points of a drawing that was mirrored": ("checkpoints", _mirrored, "Q1-X"),
    "points with exchanged axes": ("checkpoints", _exchanged, "Q1-X"),
    "lengths between points that are drawn": ("distances", _other_lengths, "Q2"),
}


@pytest.mark.parametrize("name", REFUTED)
def test_not_drawn_covers_nothing_that_is_drawn(name: str, tmp_path: Path) -> None:
    what, change, id_ = REFUTED[name]
    said = {"what": what, "value": "not drawn", **WHO}
    wrong = {}
    for seed in range(6):
        made = change(office(2000 + seed, n=9, **BY_ID)).change(confirmed=(said,))
        quality = audited(made, tmp_path / str(seed)).record.quality
        states = {element.id: str(element.status) for element in quality.elements}
        if (quality.verdict, states[id_]) != ("undecided", "undecided"):
            wrong[seed] = (str(quality.verdict), states[id_])
    assert not wrong


def test_openings_measured_from_left_to_right(tmp_path: Path) -> None:
    """Every row names its ends alike; widths that differ are no repetition."""
    wide = 1.0 + 0.37 * np.arange(6)
    for seed in range(6):
        made = office(2100 + seed, n=9, **{**BY_NAME, "table_unit": "m", "digits": 4})
        errors = 0.00006 * made.scale * np.where(np.arange(len(wide)) % 2, 1, -1)
        made = made.change(lengths=wide, measured=wide + errors, ends=[("esq.", "dir.")] * len(wide))
        quality = audited(made, tmp_path / str(seed)).record.quality
        assert next(element.n for element in quality.elements if element.id == "Q2") == len(wide)


def test_most_points_not_drawn_is_the_word_of_who_confirms(tmp_path: Path) -> None:
    """It is accepted, and the first reason names the person; one point of nine or twelve does not come first."""
    said = {"what": "checkpoints", "value": "not drawn", **WHO}
    for seed in range(6):
        made = office(2200 + seed, n=9, **{**BY_ID, "ends_by": "names"})
        every = np.arange(len(made.ids)) if seed % 2 else np.arange(len(made.ids) // 2 + 1)
        # Each point elsewhere above the roof: no shift of all puts them on the drawing.
        up = made.facade.height + 0.37 * (1 + every % 4) + 0.11 * every
        moved = both(made, every, np.column_stack([0.23 * every % 1.7, up, 0 * up])).change(confirmed=(said,))
        quality = audited(moved, tmp_path / f"{seed}-most").record.quality
        assert quality.verdict == "accepted"
        assert (quality.why[0].message, dict(quality.why[0].fields)["by"]) == ("evidence.most-confirmed", WHO["by"])
        few = both(made, every[:1], np.array([0.0, 3.0, 0.0])).change(confirmed=(said,))
        quality = audited(few, tmp_path / f"{seed}-one").record.quality
        assert (quality.verdict, quality.why[0].message) == ("accepted", "verdict.accepted")
        told = [dict(one.fields)["ids"] for one in quality.remarks if one.message == "evidence.absent-confirmed"]
        assert told
        assert all(ids == [str(made.ids[0])] for ids in told)


@pytest.mark.parametrize(("share", "state"), [(0.8, ("accepted", "pass")), (1.1, ("undecided", "undecided"))])
def test_points_farther_away_than_the_drawing_is_large_are_not_of_it(
    share: float, state: tuple[str, str], tmp_path: Path
) -> None:
    said = {"what": "checkpoints", "value": "not drawn", **WHO}
    for seed in range(6):
        made = office(
            2300 + seed,
            n=9,
            **{
                **BY_ID,
                "ends_by": "names",
                "axes": False,
                "lettering": "",
                "style": STYLES[0],
                "table_unit": "m",
                "digits": 4,
            },
        )
        corners = made.facade.corners()
        diagonal = float(np.linalg.norm(np.ptp(corners, axis=0)[: 2 if made.flat else 3]))
        # The highest corner, straight up: as far from the linework as it was moved.
        top = int(np.argmax(made.drawn @ FRAMES[made.plane][1]))
        room = float(corners[:, 1].max() - ((made.drawn - made.origin) @ FRAMES[made.plane].T)[top, 1])
        far = room + diagonal * share
        moved = both(made, np.array([top]), np.array([0.0, far, 0.0])).change(confirmed=(said,))
        quality = audited(moved, tmp_path / str(seed)).record.quality
        states = {element.id: str(element.status) for element in quality.elements}
        assert (quality.verdict, states["Q1-X"]) == state


def test_two_facades_that_are_alike_are_accepted_when_somebody_says_so(tmp_path: Path) -> None:
    kind = next(one for one in ATTACKS if one.name == "the drawing moved aside under another facade, with its points")
    said = {"what": "facade", "value": "S", **WHO}
    for seed in range(4):
        made = kind.change(office(2400 + seed, n=9, **kind.office), np.random.default_rng(seed))
        assert audited(made, tmp_path / f"{seed}-alike").record.quality.verdict == "undecided"
        done = audited(made.change(confirmed=(said,)), tmp_path / f"{seed}-confirmed")
        assert (str(done.record.quality.verdict), printed(done)) == ("accepted", [said])
