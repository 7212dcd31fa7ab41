# SPDX-License-Identifier: MIT
"""Style sheets and scripts enter a page unescaped, so none of them may end its element."""

from pathlib import Path

import pytest

from foparq.report import templates


@pytest.mark.parametrize(
    ("text", "fine"), [("a > b { }", True), ("x = '</script>'", False), ("a <!-- b", False), ("if (a < b) {}", True)]
)
def test_a_text_that_would_end_its_element_is_refused(
    tmp_path: Path, text: str, fine: bool, monkeypatch: pytest.MonkeyPatch  # noqa: FBT001
) -> None:  # fmt: skip
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "x.js").write_text(text, encoding="utf-8")
    monkeypatch.setattr(templates, "shipped", lambda _: tmp_path)
    if fine:
        assert templates.shipped_text("page", "x.js") == text
    else:
        with pytest.raises(ValueError, match="markup"):
            templates.shipped_text("page", "x.js")
