# SPDX-License-Identifier: MIT
"""Attacks on completeness: features that are drawn where, or as, none can be."""

from dataclasses import replace

import numpy as np
from tests.attacks.kinds import TOLD, attack
from tests.tools.facades import Part
from tests.tools.offices import Office

SPACE = {**TOLD, "plane": "xz", "targets": "", "ends_by": "places"}


def _moved(part: Part, step: np.ndarray) -> Part:
    def there(spots: object) -> tuple[tuple[float, float, float], ...]:
        return tuple(map(tuple, (np.array(spots, dtype=float) + step).tolist()))

    return replace(part, ring=there(part.ring), inner=tuple(there(line) for line in part.inner))  # type: ignore[arg-type]


def _free(office: Office) -> list[int]:
    """Windows on which no checkpoint lies, at least three."""
    free = []
    for row, part in enumerate(office.facade.parts):
        corners = office.place(np.array([*part.ring, *(spot for line in part.inner for spot in line)]))
        away = np.linalg.norm(corners[:, None] - office.drawn[None], axis=2).min() > 0.01
        if part.kind == "window" and away:
            free.append(row)
    return free


def _replaced(office: Office, made: object, share: float = 0.1) -> Office:
    """As many windows as surely are too many missing, put elsewhere or exchanged."""
    parts, free = list(office.facade.parts), _free(office)
    count = max(3, int(share * office.facade.count("window")) + 1)
    for n, row in enumerate(free[:count]):
        parts[row] = made(n, parts[row])  # type: ignore[operator]
    return office.change(facade=replace(office.facade, parts=parts))


@attack("windows 100 to 500 m aside", office=SPACE)
def _aside(office: Office, rng: np.random.Generator) -> Office:
    step = np.array([rng.uniform(100, 500) * rng.choice([-1, 1]), 0, 0])
    return _replaced(office, lambda _, part: _moved(part, step))


@attack("windows 40 m below or above the facade", office=SPACE)
def _below(office: Office, rng: np.random.Generator) -> Office:
    step = np.array([0, 40 * rng.choice([-1, 1]), 0])
    return _replaced(office, lambda _, part: _moved(part, step))


@attack("windows 40 m before or behind the facade", office=SPACE)
def _before(office: Office, rng: np.random.Generator) -> Office:
    step = np.array([0, 0, 40 * rng.choice([-1, 1])])
    return _replaced(office, lambda _, part: _moved(part, step))


@attack("windows exchanged for frames of 33 m", office=SPACE)
def _frames(office: Office, _: np.random.Generator) -> Office:
    def frame(n: int, part: Part) -> Part:
        low = -4.0 - n
        return replace(part, ring=((-3, low, 0), (30, low, 0), (30, low + 0.5, 0), (-3, low + 0.5, 0)), inner=())

    return _replaced(office, frame)


@attack("windows exchanged for marks of 20 cm", office=SPACE)
def _marks(office: Office, _: np.random.Generator) -> Office:
    def mark(n: int, part: Part) -> Part:
        left = 0.05 + 0.3 * n
        return replace(part, ring=((left, -1, 0), (left + 0.2, -1, 0), (left, -0.8, 0)), inner=())

    return _replaced(office, mark)
