# SPDX-License-Identifier: MIT
"""Names on the page are broken at their separators only, say what they said, and stay harmless."""

import html
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foparq.report.page.breaks import breakable

ALLOWED = re.compile(r'<wbr>|<span class="torn">|</span>')


@given(st.text(alphabet="AÇb_-.$|/ <>&\"'19", max_size=80))
def test_a_name_says_what_it_said_and_is_no_markup(name: str) -> None:
    written = str(breakable(name))
    bare = ALLOWED.sub("", written)
    assert not re.search(r"[<>\"']", bare)
    assert html.unescape(bare) == name


@pytest.mark.parametrize(
    ("name", "pieces"),
    [
        ("CIMALHA", ["CIMALHA"]), ("ESQUADRIA_PORTA", ["ESQUADRIA_PORTA"]), ("", [""]),
        ("ARQ-ESQUADRIA-PORTA-01", ["ARQ-", "ESQUADRIA-", "PORTA-", "01"]),
        ("MURO__DE__FECHO__SUL", ["MURO__", "DE__", "FECHO__", "SUL"]),
    ],
)  # fmt: skip
def test_a_name_is_broken_after_its_separators_only(name: str, pieces: list[str]) -> None:
    written = str(breakable(name))
    assert written.split("<wbr>") == pieces
    assert "torn" not in written


def test_only_a_part_without_room_may_be_broken_anywhere() -> None:
    assert str(breakable("A_" + "X" * 17)) == f'<span class="torn">A_<wbr>{"X" * 17}</span>'
    assert str(breakable("A_" * 10 + "X" * 16)).count("torn") == 0


def test_a_very_long_name_costs_no_more_than_itself() -> None:
    name = "_A" * 50_000
    assert len(str(breakable(name))) < len(name) + 100
