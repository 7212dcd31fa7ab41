# SPDX-License-Identifier: MIT
"""No attack is accepted, and none is rejected for what it is not; ten variants of each kind."""

from pathlib import Path

import numpy as np
import pytest
from tests.attacks import (  # noqa: F401 - enter their attacks
    blocks,
    evidence,
    facades,
    marks,
    outvoting,
    placing,
    references,
    repetition,
    sheets,
    statements,
)
from tests.attacks.kinds import ATTACKS, Attack
from tests.tools.offices import office
from tests.tools.sound import audited

from foparq.audit import Audit


def reasons(done: Audit) -> set[str]:
    """Messages of the verdict and of all elements."""
    quality = done.record.quality
    every = (*quality.why, *quality.remarks, *(reason for element in quality.elements for reason in element.why))
    return {reason.message for reason in every}


@pytest.mark.parametrize("kind", ATTACKS, ids=lambda kind: kind.name)
def test_attack(kind: Attack, tmp_path: Path) -> None:
    wrong = {}
    for seed in range(kind.variants):
        rng = np.random.default_rng([seed, 77])
        made = kind.change(office(1000 + seed, **{"n": int(rng.integers(7, 13)), **kind.office}), rng)
        done = audited(made, tmp_path / str(seed))
        said = reasons(done)
        verdict = str(done.record.quality.verdict)
        if verdict != kind.verdict or (kind.says and not said & set(kind.says)):
            wrong[seed] = (verdict, sorted(said))
    assert not wrong
