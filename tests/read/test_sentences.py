# SPDX-License-Identifier: MIT
"""What the readers say has a sentence in every language."""

import re
from pathlib import Path

import pytest

from foparq.report.words import LANGUAGES, Words

MESSAGE = re.compile(r'"((?:read|table|manifest|dxf)\.[a-z-]+)"')


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_message_of_the_readers(repository: Path, language: str) -> None:
    said = {
        key
        for path in (repository / "src/foparq/read").rglob("*.py")
        for key in MESSAGE.findall(path.read_text("utf-8"))
    }
    words = Words(language)
    assert len(said) > 40
    assert {key for key in said if words.find(f"errors.{key}") is None} == set()
