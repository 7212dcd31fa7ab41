# SPDX-License-Identifier: MIT
"""The cases of rules over geometry and over meshes, as data: ``cases/<CODE>.toml``."""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.mesh.parts import given_surface, input_of, part_of

from foparq.check.registry import all_rules
from foparq.check.rule import Rule
from foparq.findings.hits import Hits
from foparq.model.inputs import Areas, Features, Lines, Named, areas_of, features_of, lines_of
from foparq.model.layers import bonds
from foparq.model.mesh import Mesh
from foparq.model.surface import Faces, Surface, Vertices
from foparq.profile.schema import LineworkSpec
from foparq.units import parse_quantity

FOLDER = Path(__file__).with_name("cases")
MAKERS: dict[type, tuple[str, Any]] = {
    Lines: ("lines", lines_of),
    Areas: ("areas", areas_of),
    Features: ("features", features_of),
}
ON_MESHES = frozenset({Faces, Surface, Vertices})


@dataclass(frozen=True, kw_only=True)
class Case:
    """A small drawing, the tolerances it is looked at with, and what must be found."""

    rule: Rule
    name: str
    given: Any  #: columns of the input of the rule
    tolerances: dict[str, float]  #: SI
    find: list[dict[str, Any]]
    tie: bool  #: of equals the first by x, then y, is named: another one in a turned drawing
    faulty: list[int] | None = None  #: rows at fault, where the case says so; hits may tell of many

    def run(self, columns: Named | None = None) -> Hits:
        """What the rule finds in the drawing, or in a changed one."""
        with np.errstate(invalid="ignore"):
            return self.rule.check(self.given if columns is None else columns, **self.tolerances)


@dataclass(frozen=True, kw_only=True)
class MeshCase(Case):
    """A small mesh; ``given`` is what the rule gets of it. Rows and vertices are counted as they are given."""

    part: Mesh
    weld: str
    exact: bool  #: rounding decides: the case is not looked at where coordinates are rounded
    reverse: int | None  #: findings if every face looks to the other side, where that is another number

    def seen(self, part: Mesh) -> Named:
        """What the rule gets of another mesh, looked at in the same way."""
        return input_of(self.rule.subject, part, weld=self.weld)


def geometry_cases() -> list[Any]:
    """Every case of every rule over geometry, as a parameter named ``CODE-name``."""
    return _cases(frozenset(MAKERS), _case)


def mesh_cases() -> list[Any]:
    """Every case of every rule over meshes, as a parameter named ``CODE-name``."""
    return _cases(ON_MESHES, _mesh_case)


def _cases(subjects: frozenset[type], make: Callable[[Rule, dict[str, Any]], Case]) -> list[Any]:
    found = []
    for file in sorted(FOLDER.glob("*.toml")):
        table = tomllib.loads(file.read_text("utf-8"))
        rule = all_rules().get(table["rule"])
        if rule is None:
            pytest.exit(f"{file.name}: no rule has this code yet; write it (CONTRIBUTING, step 4)", returncode=1)
        if rule.subject in subjects:
            found += [
                pytest.param(make(rule, case), id=f"{rule.code}-{case['name']}", marks=_open(case))
                for case in table["case"]
            ]
    return found


def _open(case: dict[str, Any]) -> list[Any]:
    """A case that says why it is ``open`` is known to fail, and is told once it does not."""
    return [pytest.mark.xfail(reason=case["open"], strict=True)] if "open" in case else []


def common(rule: Rule) -> dict[str, float]:
    """Tolerances of a rule that profiles state for all rules, as the shipped ones have them, at 1:50."""
    stated = LineworkSpec().tolerances
    return {name: stated[name].si(50) for name, _ in rule.tolerances if name in stated}


def _case(rule: Rule, case: dict[str, Any]) -> Case:
    return Case(**_said(rule, case), given=_columns(rule.subject, case["given"]))


def _mesh_case(rule: Rule, case: dict[str, Any]) -> MeshCase:
    given = case["given"]
    part = part_of(given_surface(given), closed=given.get("closed"), rims=given.get("rims"))
    weld = "identical" if given.get("weld", True) else "none"
    return MeshCase(
        **_said(rule, case), given=input_of(rule.subject, part, weld=weld), part=part, weld=weld,
        exact=case.get("exact", False), reverse=case.get("reversed"),
    )  # fmt: skip


def _said(rule: Rule, case: dict[str, Any]) -> dict[str, Any]:
    """What cases of drawings and of meshes have in common."""
    units = dict(rule.tolerances)
    stated = {name: parse_quantity(text, units[name]).si() for name, text in case.get("with", {}).items()}
    return {
        "rule": rule, "name": case["name"], "tolerances": common(rule) | stated, "find": case["find"],
        "tie": case.get("tie", False), "faulty": case.get("faulty"),
    }  # fmt: skip


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
