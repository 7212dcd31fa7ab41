# SPDX-License-Identifier: MIT
"""The cases of rules over geometry, as data: ``cases/<CODE>.toml``."""

import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from foparq.check.registry import all_rules
from foparq.check.rule import Rule
from foparq.findings.hits import Hits
from foparq.model.inputs import Areas, Features, Lines, Named, areas_of, features_of, lines_of
from foparq.model.layers import bonds
from foparq.profile.schema import LineworkSpec
from foparq.units import parse_quantity

FOLDER = Path(__file__).with_name("cases")
MAKERS: dict[type, tuple[str, Any]] = {
    Lines: ("lines", lines_of),
    Areas: ("areas", areas_of),
    Features: ("features", features_of),
}


@dataclass(frozen=True, kw_only=True)
class Case:
    """A small drawing, the tolerances it is looked at with, and what must be found."""

    rule: Rule
    name: str
    given: Any  #: columns of the input of the rule
    tolerances: dict[str, float]  #: SI
    find: list[dict[str, Any]]
    tie: bool  #: of equals the first by x, then y, is named: another one in a turned drawing

    def run(self, columns: Named | None = None) -> Hits:
        """What the rule finds in the drawing, or in a changed one."""
        with np.errstate(invalid="ignore"):
            return self.rule.check(self.given if columns is None else columns, **self.tolerances)


def geometry_cases() -> list[Any]:
    """Every case of every rule over geometry, as a parameter named ``CODE-name``."""
    found = []
    for file in sorted(FOLDER.glob("*.toml")):
        table = tomllib.loads(file.read_text("utf-8"))
        rule = all_rules().get(table["rule"])
        if rule is None:
            pytest.exit(f"{file.name}: no rule has this code yet; write it (CONTRIBUTING, step 4)", returncode=1)
        if rule.subject in MAKERS:
            found += [pytest.param(_case(rule, case), id=f"{rule.code}-{case['name']}") for case in table["case"]]
    return found


def common(rule: Rule) -> dict[str, float]:
    """Tolerances of a rule that profiles state for all rules, as the shipped ones have them, at 1:50."""
    stated = LineworkSpec().tolerances
    return {name: stated[name].si(50) for name, _ in rule.tolerances if name in stated}


def _case(rule: Rule, case: dict[str, Any]) -> Case:
    units = dict(rule.tolerances)
    return Case(
        rule=rule,
        name=case["name"],
        given=_columns(rule.subject, case["given"]),
        tolerances=common(rule)
        | {name: parse_quantity(text, units[name]).si() for name, text in case.get("with", {}).items()},
        find=case["find"],
        tie=case.get("tie", False),
    )


def _columns(subject: type, given: dict[str, Any]) -> Any:
    name, make = MAKERS[subject]
    with np.errstate(invalid="ignore"):
        made = make([text or None for text in given[name]])
    if "bounds" in given:
        made = replace(made, bounds=np.isin(np.arange(len(made)), given["bounds"]))
    if "layers" in given:
        layers = np.array(given["layers"], dtype=object)
        bond = bonds(layers, given.get("classes", {}), given.get("bind", []))
        made = replace(made, layer=layers, **({"bond": bond} if subject is Lines else {}))
    if "item" in given:
        made = replace(made, row=np.array(given["item"]))
    return made
