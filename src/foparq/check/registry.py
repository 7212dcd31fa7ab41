# SPDX-License-Identifier: MIT
"""All rules, found by walking ``check.rules``: one file a rule, file name = rule name."""

import graphlib
import importlib
import pkgutil
from collections.abc import Collection, Mapping
from functools import cache
from types import MappingProxyType

import foparq.check.rules
from foparq.check.rule import Rule
from foparq.errors import RuleError


@cache
def all_rules() -> Mapping[str, Rule]:
    """Every rule by code, in order of codes.

    Raises
    ------
    RuleError
        If a code or a name is used twice, or a required rule does not exist.
    """
    found: dict[str, Rule] = {}
    for module in pkgutil.walk_packages(foparq.check.rules.__path__, "foparq.check.rules."):
        if module.ispkg:
            continue
        name = module.name.rpartition(".")[2]
        record = getattr(getattr(importlib.import_module(module.name), name, None), "rule", None)
        if not isinstance(record, Rule) or record.name != name.replace("_", "-"):
            raise RuleError("rule.file-name", file=module.name, name=name, example=name.replace("_", "-"))
        if record.code in found:
            raise RuleError("rule.code-twice", code=record.code, file=module.name, other=found[record.code].name)
        found[record.code] = record
    for record in found.values():
        for needed in record.requires:
            if needed not in found:
                raise RuleError("rule.requires-unknown", code=record.code, requires=needed)
    return MappingProxyType(dict(sorted(found.items())))


def in_order(codes: set[str]) -> list[str]:
    """Codes so that every rule comes after those it requires; ties by code."""
    rules = all_rules()
    sorter = graphlib.TopologicalSorter(
        {code: [c for c in rules[code].requires if c in codes] for code in sorted(codes)}
    )
    sorter.prepare()
    ordered: list[str] = []
    while sorter.is_active():
        ready = sorted(sorter.get_ready())
        ordered.extend(ready)
        sorter.done(*ready)
    return ordered


def required_by(names: Collection[str]) -> set[str]:
    """Names of all rules that some rules require, directly or through others, without themselves."""
    rules = {rule.name: rule for rule in all_rules().values()}
    waiting, found = [rules[name] for name in names], set[str]()
    while waiting:
        needed = {all_rules()[code].name for code in waiting.pop().requires} - found
        found |= needed
        waiting.extend(rules[name] for name in needed)
    return found - set(names)
