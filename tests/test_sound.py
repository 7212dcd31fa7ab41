# SPDX-License-Identifier: MIT
"""Sound deliveries of small offices are accepted at once: doubt is no refuge."""

from pathlib import Path

import numpy as np
import pytest
from tests.tools.offices import office
from tests.tools.sound import audited

from foparq.report.sentences import reason_sentence
from foparq.report.words import Words

#: ten of the sixty that ``python -m tests.tools.sound --seed 1`` makes: every format, version, plane, unit and table;
#: and two whose depths are round numbers, of which a spreadsheet shows few digits
SAMPLE = (2, 3, 4, 5, 20, 25, 31, 32, 34, 40, 5096, 5108)


@pytest.mark.parametrize("seed", SAMPLE)
def test_a_sound_delivery_is_accepted_with_the_figures_it_was_made_with(seed: int, tmp_path: Path) -> None:
    made = office(seed)
    quality = audited(made, tmp_path / "delivery").record.quality
    words = Words("en")
    assert quality.verdict == "accepted", [reason_sentence(words, reason) for reason in quality.why]
    found = {element.id: element for element in quality.elements}
    half = 0.5 * 10.0**-made.digits * {"m": 1.0, "cm": 0.01, "mm": 0.001}[made.table_unit]
    true = np.sqrt(np.mean((made.drawn - made.surveyed) ** 2, axis=0))
    for axis, name in enumerate("XYZ"):
        assert found[f"Q1-{name}"].n == len(made.ids)
        assert found[f"Q1-{name}"].value == pytest.approx(true[axis], abs=2 * half)
    assert found["Q2"].value == pytest.approx(np.sqrt(np.mean((made.lengths - made.measured) ** 2)), abs=2 * half)
    assert found["Q4"].value == found["Q5"].value == 0.0


def test_a_flat_drawing_without_delivered_coordinates_says_what_is_missing(tmp_path: Path) -> None:
    made = office(7, plane="xy", told=False)
    quality = audited(made, tmp_path / "delivery").record.quality
    assert quality.verdict == "undecided"
    assert quality.why[0].message == "absolute.none-delivered"
    assert dict(quality.why[0].fields)["element"] == "Q1-Z"
