# SPDX-License-Identifier: MIT
"""Small tables as files, and what is wrong with them."""

from pathlib import Path

import pytest

from foparq.errors import UnreadableError
from foparq.profile.manifest import SurveySection
from foparq.read.table.tables import read_checkpoints
from foparq.report.words import LANGUAGES, Words

METRES = SurveySection(path="t.csv")


def written(folder: Path, text: str, name: str = "t.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def fault(path: Path) -> UnreadableError:
    """Why a table of checkpoints is refused; it has a sentence in every language."""
    with pytest.raises(UnreadableError) as caught:
        read_checkpoints(path, METRES)
    assert all(Words(language).error(caught.value) for language in LANGUAGES)
    return caught.value
