# SPDX-License-Identifier: MIT
"""Cases of the rules over facts of a file, as data: ``cases/<CODE>.toml`` with ``given.rows``."""

import tomllib
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.check.registry import all_rules
from foparq.model.inputs import Bombs, HiddenItems, LayerNames, LayerPatterns, Repairs, UnitEvidence, nameless
from foparq.units import parse_quantity

CASES = Path(__file__).parents[1] / "cases"
FACTS = {Repairs, Bombs, HiddenItems, LayerNames, LayerPatterns, UnitEvidence}


def fact_cases() -> list[Any]:
    found = []
    for code, rule in all_rules().items():
        if rule.subject in FACTS:
            table = tomllib.loads((CASES / f"{code}.toml").read_text(encoding="utf-8"))
            found += [pytest.param(code, case, id=f"{code}-{case['name']}") for case in table["case"]]
    return found


def given(subject: Any, rows: list[dict[str, Any]]) -> Any:
    columns: dict[str, Any] = dict(nameless(len(rows)))
    for field in fields(subject):
        values = [row.get(field.name, columns.get(field.name, [""] * len(rows))[n]) for n, row in enumerate(rows)]
        if field.name == "where":
            values = [shapely.from_wkt(text) for text in values]
        kind = np.intp if field.name == "row" else object
        known = next((t for t in (bool, float) if values and all(isinstance(v, t) for v in values)), kind)
        columns[field.name] = np.array(values, dtype=known)
    return subject(**columns)


@pytest.mark.parametrize(("code", "case"), fact_cases())
def test_case(code: str, case: dict[str, Any]) -> None:
    rule = all_rules()[code]
    symbols = dict(rule.tolerances)
    tolerances = {name: parse_quantity(text, symbols[name]).si() for name, text in case.get("with", {}).items()}
    subject = given(rule.subject, case["given"]["rows"])
    hits = rule.check(subject, **tolerances)
    assert hits.row.tolist() == [want["row"] for want in case["find"]]
    assert hits.size.tolist() == pytest.approx([want["size"] for want in case["find"]], rel=1e-12, nan_ok=True)
    assert [place.wkt for place in hits.where] == [want["where"] for want in case["find"]]


@pytest.mark.parametrize("code", [code for code, rule in all_rules().items() if rule.subject in FACTS])
def test_rows_in_any_order_give_the_same_findings(code: str) -> None:
    rule = all_rules()[code]
    table = tomllib.loads((CASES / f"{code}.toml").read_text(encoding="utf-8"))
    for case in table["case"]:
        rows = case["given"]["rows"]
        tolerances = {
            n: parse_quantity(text, dict(rule.tolerances)[n]).si() for n, text in case.get("with", {}).items()
        }
        ahead = rule.check(given(rule.subject, rows), **tolerances)
        behind = rule.check(given(rule.subject, rows[::-1]), **tolerances)
        assert ahead.row.tolist() == sorted(len(rows) - 1 - row for row in behind.row)
        assert sorted(map(str, ahead.size)) == sorted(map(str, behind.size))
