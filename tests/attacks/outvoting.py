# SPDX-License-Identifier: MIT
"""Attacks by many rows that nobody can check, and by a survey that nobody could make."""

import numpy as np
from tests.attacks.kinds import TOLD, attack
from tests.attacks.repetition import FINE, NAMED
from tests.tools.offices import Office

_COPIES = 60


def _hiding(office: Office, bad: np.ndarray, good: np.ndarray, off: float, ends: list[tuple[str, str]]) -> Office:
    """Distances off by so much, and good ones under invented names."""
    lengths = np.concatenate([bad, good])
    measured = np.concatenate([bad + off, good + 0.0004])
    rows = office.rows[: len(bad)] if office.rows else []
    return office.change(
        lengths=lengths, measured=measured, ends=[*ends, *((f"s{n}", f"t{n}") for n in range(len(good)))], rows=rows
    )


@attack("one distance sixty times, each longer, that hides four bad ones", "relative.names-alike", office=NAMED)
def _longer(office: Office, rng: np.random.Generator) -> Office:
    off = 0.0002 * office.scale * rng.uniform(1.5, 3.0)
    good = 2.1 + np.cumsum(rng.uniform(0.0006, 0.005, _COPIES))
    bad = 0.5 + 0.31 * np.arange(4)
    return _hiding(office, bad, good, off, [(f"q{n}", f"r{n}") for n in range(4)])


@attack(
    "sixty invented lengths beside four bad distances between points", "relative.names-outvote",
    office={**FINE, "ends_by": "checkpoints"},
)  # fmt: skip
def _outvoted(office: Office, rng: np.random.Generator) -> Office:
    off = 0.0002 * office.scale * rng.uniform(1.5, 3.0)
    return _hiding(office, office.lengths[:4], np.linspace(0.5, 3.5, _COPIES), off, office.ends[:4])


@attack("a survey of a ten thousandth of a millimetre", "absolute.survey-impossible", office=TOLD)
def _points(office: Office, _: np.random.Generator) -> Office:
    return office.state("checkpoints", survey_sd="0.0001 mm")


@attack("distances by tape to a ten thousandth of a millimetre", "relative.survey-impossible", office=TOLD)
def _tape(office: Office, _: np.random.Generator) -> Office:
    return office.state("distances", survey_sd="0.0001 mm")
