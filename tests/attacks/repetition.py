# SPDX-License-Identifier: MIT
"""Attacks by repetition, and by copying the survey."""

import numpy as np
from tests.attacks.kinds import TOLD, attack
from tests.tools.offices import FRAMES, STYLES, Office

FINE = {**TOLD, "table_unit": "m", "digits": 4, "scale": 50, "style": STYLES[0]}
NAMED, PLACED = {**FINE, "ends_by": "names"}, {**FINE, "ends_by": "places"}


def _points(office: Office, ids: list[str], surveyed: np.ndarray, drawn: np.ndarray) -> Office:
    """Other checkpoints; the distances keep their lengths and lose their ends."""
    names = [(f"a{n}", f"b{n}") for n in range(len(office.lengths))]
    return office.change(ids=ids, surveyed=surveyed, drawn=drawn, ends=names, ends_by="names", rows=[])


def _errors(rng: np.random.Generator, n: int, sd: float) -> np.ndarray:
    return rng.normal(0.0, sd, (n, 3))


@attack("one mark seven times under seven names", "absolute.few", office=FINE)
def _mark(office: Office, rng: np.random.Generator) -> Office:
    at = np.repeat(office.drawn[:1], 7, axis=0)
    return _points(office, [f"M{n}" for n in range(7)], at + _errors(rng, 7, 0.004), at)


def _copies(office: Office, rng: np.random.Generator, apart: float) -> Office:
    """Seven points that are off by twice the limit in every axis, and thirty of one good place along its lower edge."""
    limit = 0.0003 * office.scale
    bad = office.drawn[:7] + 2 * limit * np.where(np.arange(7)[:, None] % 2, 1.0, -1.0)
    window = next(part for part in office.facade.parts if part.kind == "window")
    left = office.place(window.ring[:1])[0]
    good = left + np.arange(30)[:, None] * apart * FRAMES[office.plane][0]
    drawn = np.concatenate([office.drawn[:7], good])
    if office.flat:
        drawn[:, 2] = 0.0
        bad[:, 2] -= office.drawn[:7, 2]
    ids = [f"{kind}{n}" for kind, count in (("R", 7), ("C", 30)) for n in range(count)]
    return _points(office, ids, np.concatenate([bad, drawn[7:] + _errors(rng, 30, 0.003)]), drawn)


@attack("thirty copies 0.1 mm aside that hide seven bad points", "absolute.fail", verdict="rejected", office=FINE)
def _near(office: Office, rng: np.random.Generator) -> Office:
    return _copies(office, rng, 0.0001)


@attack("thirty copies 11 mm aside that hide seven bad points", "absolute.fail", verdict="rejected", office=FINE)
def _aside(office: Office, rng: np.random.Generator) -> Office:
    return _copies(office, rng, 0.011)


def _thirty(office: Office, names: list[tuple[str, str]], rows: list[tuple[int, int]]) -> Office:
    """Four distances that are off by twice the limit, and thirty times one that is right."""
    off, length = 2 * 0.0002 * office.scale, office.lengths[4]
    lengths = np.concatenate([office.lengths[:4], np.full(30, length)])
    measured = np.concatenate([office.lengths[:4] + off, np.full(30, length + 0.0004)])
    return office.change(
        lengths=lengths, measured=measured, ends=[*office.ends[:4], *names], rows=[*office.rows[:4], *rows]
    )


@attack("one distance thirty times", "relative.fail", verdict="rejected", office={**FINE, "ends_by": "checkpoints"})
def _same_ends(office: Office, _: np.random.Generator) -> Office:
    return _thirty(office, [office.ends[4]] * 30, [office.rows[4]] * 30)


@attack(
    "one distance thirty times, ends exchanged", "relative.fail", verdict="rejected",
    office={**FINE, "ends_by": "checkpoints"},
)  # fmt: skip
def _swapped(office: Office, _: np.random.Generator) -> Office:
    (a, b), (i, j) = office.ends[4], office.rows[4]
    return _thirty(office, [(a, b), (b, a)] * 15, [(i, j), (j, i)] * 15)


@attack(
    "one distance thirty times between places",
    "relative.fail",
    verdict="rejected",
    office=PLACED,
)
def _same_places(office: Office, _: np.random.Generator) -> Office:
    return _thirty(office, [(f"a{n}", f"b{n}") for n in range(30)], [office.rows[4]] * 30)


@attack("one distance thirty times under invented names", "relative.fail", verdict="rejected", office=NAMED)
def _invented(office: Office, _: np.random.Generator) -> Office:
    return _thirty(office, [(f"a{n}", f"b{n}") for n in range(30)], [])


def _copied(office: Office, surveyed: np.ndarray) -> Office:
    return office.change(surveyed=surveyed, survey_sd=0.003)


@attack("delivered equal to surveyed", "evidence.too-good", office=FINE)
def _equal(office: Office, _: np.random.Generator) -> Office:
    return _copied(office, office.drawn.copy())


@attack("delivered equal to surveyed, to the millimetre", "evidence.too-good", office={**FINE, "n": 9})
def _rounded(office: Office, _: np.random.Generator) -> Office:
    return _copied(office, np.round(office.drawn, 3))


@attack("delivered equal to surveyed on one axis", "evidence.too-good", office=FINE)
def _one_axis(office: Office, rng: np.random.Generator) -> Office:
    surveyed, axis = office.surveyed.copy(), int(rng.integers(3))
    surveyed[:, axis] = office.drawn[:, axis]
    return _copied(office, surveyed)


@attack("seven points to 1.1 mm with a survey of 3 mm", "evidence.good", verdict="accepted", office={**FINE, "n": 7})
def _paper(office: Office, _: np.random.Generator) -> Office:
    """What Campos et al. 2015 report of their Y: luck, or a survey better than stated, and no fault."""
    surveyed = office.surveyed.copy()
    errors = (office.surveyed - office.drawn)[:, 1]
    surveyed[:, 1] = office.drawn[:, 1] + errors * 0.0011 / np.sqrt(np.mean(errors**2))
    return office.change(surveyed=surveyed, survey_sd=0.003)
