# SPDX-License-Identifier: MIT
"""What the script that mutates the source changes, and what it leaves alone."""

import ast
import os
import subprocess
import sys
from pathlib import Path

from tests.tools.mutants import by_chance, by_hand, changes, functions

TEXT = '''
"""A number: 1 < 2."""
LIMIT: "Annotated[int, 3 < 4]" = 5
Either = Box | Other


class Box:
    size: int = 6

    def fits(self, other: int = 7) -> bool:
        """Whether 8 < 9."""
        if not other and self.size >= 10:
            raise ValueError(f"{other + 11}", 12)
        return because("x", n=13) or max(self.size, other) - 1.5 < LIMIT
'''
ROOT = Path(__file__).resolve().parents[1]


def test_operators_constants_and_swaps_are_changed_and_words_are_not() -> None:
    made = {(one.kind, one.old, one.new, one.function) for one in changes("x.py", TEXT)}
    assert made == {
        ("constant", "5", "6", ""), ("constant", "6", "7", ""), ("constant", "7", "8", ""),
        ("drop-not", "not other", "other", "Box.fits"), ("and-or", "and", "or", "Box.fits"),
        ("compare", ">=", ">", "Box.fits"), ("constant", "10", "11", "Box.fits"), ("and-or", "or", "and", "Box.fits"),
        ("swap", "max", "min", "Box.fits"), ("operator", "-", "+", "Box.fits"),
        ("drop-term", "max(self.size, other) - 1.5", "max(self.size, other)", "Box.fits"),
        ("constant", "1.5", "3.0", "Box.fits"), ("compare", "<", "<=", "Box.fits"),
    }  # fmt: skip


def test_every_change_is_one_change_that_parses() -> None:
    for one in changes("x.py", TEXT):
        changed = one.applied(TEXT)
        ast.parse(changed)
        assert changed != TEXT
        assert len(changed) - len(TEXT) == len(one.new) - len(one.old)
        assert one.diff(TEXT).startswith("x.py\n@@")


def test_offsets_are_those_of_letters_not_of_bytes() -> None:
    text = "unit = 'µm', 'ção'; limit = 1 < 2\n"
    assert {one.applied(text) for one in changes("x.py", text) if one.kind == "compare"} == {text.replace("<", "<=")}


def test_functions_are_told_by_their_lines() -> None:
    assert list(functions(TEXT)) == [("Box.fits", 10, 14)]


def test_the_same_seed_gives_the_same_mutants() -> None:
    source = ROOT / "src" / "foparq"
    first, second, other = by_chance(source, 12, 4), by_chance(source, 12, 4), by_chance(source, 12, 5)
    assert [one.key for one in first] == [one.key for one in second] != [one.key for one in other]
    assert len(first) == 12


def test_a_mutant_whose_text_is_gone_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("x = 1\ny = 1\n", encoding="utf-8")
    data = tmp_path / "mutants.toml"
    rows = [("a.py", "x = 1"), ("a.py", "= 1"), ("a.py", "z"), ("b.py", "x")]
    data.write_text(
        "".join(f'[[mutant]]\nfile = "{file}"\nold = "{old}"\nnew = "q"\nwhy = "w"\n' for file, old in rows),
        encoding="utf-8",
    )
    made, stale = by_hand(data, tmp_path)
    assert [(one.start, one.old, one.why) for one in made] == [(0, "x = 1", "w")]
    assert stale == ["a.py: 2 times: = 1", "a.py: 0 times: z", "b.py: 0 times: x"]


DEEP = """
import sitecustomize

def deep():
    deep()

try:
    deep()
except RecursionError:
    pass
sitecustomize.resume()
from foparq.units import parse_scale
parse_scale("1:50")
"""


def test_calls_are_still_told_after_a_test_whose_recursion_ran_out_of_depth(tmp_path: Path) -> None:
    told = tmp_path / "reach"
    told.touch()
    given = {"PYTHONPATH": str(ROOT / "tests" / "tools" / "trace"), "FOPARQ_REACH": str(told)}
    subprocess.run([sys.executable, "-c", DEEP], env={**os.environ, **given}, check=True)
    assert "units.py\x1fparse_scale\x1f" in told.read_text()


def test_every_mutant_by_hand_changes_the_source_as_it_is() -> None:
    made, stale = by_hand(ROOT / "tests" / "tools" / "mutants.toml", ROOT / "src" / "foparq")
    assert stale == []
    assert made
