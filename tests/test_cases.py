# SPDX-License-Identifier: MIT
"""Cases of rules, as data: ``cases/<CODE>.toml``. Run one rule with ``-k TOP011``."""

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.check.registry import all_rules
from foparq.model.inputs import Areas, Features, Lines, areas_of, features_of, lines_of
from foparq.units import parse_quantity

CASES = Path(__file__).with_name("cases")
MAKERS = {Lines: ("lines", lines_of), Areas: ("areas", areas_of), Features: ("features", features_of)}


def _cases() -> list[Any]:
    found = []
    for file in sorted(CASES.glob("*.toml")):
        table = tomllib.loads(file.read_text("utf-8"))
        rule = all_rules().get(table["rule"])
        if rule is None:
            pytest.exit(f"{file.name}: no rule has this code yet; write it (CONTRIBUTING, step 4)", returncode=1)
        if rule.subject in MAKERS:
            found += [pytest.param(table["rule"], case, id=f"{table['rule']}-{case['name']}") for case in table["case"]]
    return found


def _given(subject: type, given: dict[str, Any]) -> Any:
    name, make = MAKERS[subject]
    with np.errstate(invalid="ignore"):
        made = make([text or None for text in given[name]])
    if "bounds" in given:
        made = replace(made, bounds=np.isin(np.arange(len(made)), given["bounds"]))
    if "item" in given:
        made = replace(made, row=np.array(given["item"]))
    return made


@pytest.mark.parametrize(("code", "case"), _cases())
def test_case(code: str, case: dict[str, Any]) -> None:
    record = all_rules()[code]
    symbols = dict(record.tolerances)
    tolerances = {name: parse_quantity(text, symbols[name]).si() for name, text in case.get("with", {}).items()}
    hits = record.check(_given(record.subject, case["given"]), **tolerances)
    expected = case["find"]
    assert hits.row.tolist() == [want["row"] for want in expected]
    for n, want in enumerate(expected):
        if "size" in want:
            assert hits.size[n] == pytest.approx(want["size"], rel=want.get("precise", 1e-6), abs=1e-12)
        if "other" in want:
            assert hits.other[n] == want["other"]
        if "where" in want:
            place = shapely.from_wkt(want["where"])
            same = (
                shapely.equals(place, hits.where[n])
                if place.is_empty
                else shapely.hausdorff_distance(place, hits.where[n]) < 1e-6
            )
            assert same, f"found at {hits.where[n]}"
