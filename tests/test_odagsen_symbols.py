# SPDX-License-Identifier: MIT
"""Signs on excavation plans that nobody here drew: the table of ``docs/odagsen.md``, and what is told no longer."""

import re
from pathlib import Path

import numpy as np
import pytest

from foparq.audit import Audit, check_files
from foparq.profile.adjust import with_settings
from foparq.profile.load import load_profile

pytestmark = pytest.mark.shared

ROOT = Path(__file__).resolve().parents[1]
ROW = re.compile(
    r"^\| (?P<sheet>O\w+) \| (?P<block>.+?) × (?P<n>\d+) \((?P<layer>\w+)\)"
    r" \| (?P<before>[\d, ]+) \| (?P<after>[\d, ]+) \|$"
)
ROWS = [
    match for line in (ROOT / "docs" / "odagsen.md").read_text("utf-8").splitlines() if (match := ROW.match(line))
]  # fmt: skip


def check(sheet: str, *settings: str) -> Audit:
    path = ROOT.parent / "shared" / "data" / "drawings" / "odagsen" / f"{sheet}.DXF"
    profile = with_settings(load_profile("et-doc-foparq-a"), settings)
    return check_files([path], profile=profile, scale=50.0, unit="m", plane=None, areas=(), language="en")


def accused(done: Audit) -> set[tuple[str, str, tuple[float, ...]]]:
    findings = done.record.findings
    rows = np.flatnonzero(np.isin(findings.name, ["undershoot", "overshoot"]))
    return {(findings.name[n], findings.item[n], tuple(np.round(findings.place[n], 6).tolist())) for n in rows}


def test_the_table_is_there() -> None:
    assert len(ROWS) == 4


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["sheet"])
def test_signs_are_accused_no_longer_and_nothing_else_changes(row: re.Match[str]) -> None:
    signs, lines = check(row["sheet"]), check(row["sheet"], "linework.symbol=0 mm")
    (drawing,) = signs.record.delivery.drawings
    told = [(block.name, block.inserts, block.layers) for block in drawing.symbols.blocks]
    assert told == [(row["block"], int(row["n"]), ((row["layer"], int(row["n"])),))]
    before, after = accused(lines), accused(signs)
    for said, column in ((before, "before"), (after, "after")):
        counts = [sum(name == rule for name, _, _ in said) for rule in ("undershoot", "overshoot")]
        assert ", ".join(map(str, counts)) == row[column]
    strokes = set(drawing.items.item[drawing.symbols.rows].tolist())
    assert after == {one for one in before if one[1] not in strokes}
