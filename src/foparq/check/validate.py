# SPDX-License-Identifier: MIT
"""A profile against the rules that exist: a wrong tolerance is told before any file is read."""

from collections.abc import Iterable, Mapping

from foparq.check.registry import all_rules
from foparq.check.rule import Rule
from foparq.errors import ProfileError
from foparq.names import nearest
from foparq.profile.schema import CheckSpec, Profile
from foparq.units import Quantity

_SCALES = (10.0, 100.0)  #: tolerances are compared at a large and at a small scale
_EXAMPLES = {"m": "0.2 mm @ scale", "m2": "1 m2", "1": "10 %", "items": "5 items", "rad": "15 deg"}


def validate_checks(profile: Profile) -> None:
    """Compare the checks and elements of a profile with the rules.

    Raises
    ------
    ProfileError
        If a rule is unknown, or a tolerance is missing, unknown or of the wrong kind of unit.
    """
    by_name = {rule.name: rule for rule in all_rules().values()}
    for spec in profile.checks:
        if spec.rule not in by_name:
            raise _unknown(spec.rule, by_name, spec.file, spec.line)
        _validate_tolerances(spec, by_name[spec.rule], profile.linework.tolerances)
    for element in profile.elements:
        for name in element.uses:
            if name not in by_name:
                raise _unknown(name, by_name, profile.path, 1)


def _unknown(name: str, known: Iterable[str], file: str, line: int) -> ProfileError:
    return ProfileError("profile.unknown-rule", value=name, example=nearest(name, known)[0], file=file, line=line)


def _validate_tolerances(spec: CheckSpec, rule: Rule, common: Mapping[str, Quantity]) -> None:
    place = {"file": spec.file, "line": spec.line, "rule": rule.name}
    wanted = dict(rule.tolerances)
    for name, quantity in spec.tolerances.items():
        if name not in wanted:
            known = ", ".join(nearest(name, wanted)) or "-"
            raise ProfileError("profile.unknown-tolerance", key=name, known=known, **place)
        if quantity.symbol != wanted[name]:
            example = _EXAMPLES[wanted[name]]
            raise ProfileError("profile.tolerance-unit", key=name, value=str(quantity), example=example, **place)
        if quantity.number < 0:
            raise ProfileError("profile.tolerance-negative", key=name, value=str(quantity), **place)
    for name, symbol in wanted.items():
        if name not in spec.tolerances and name not in common:
            raise ProfileError(
                "profile.missing-tolerance", key=name, example=f'{name} = "{_EXAMPLES[symbol]}"', **place
            )
    if {"coincide", "reach"} <= set(wanted):
        coincide, reach = spec.tolerances["coincide"], spec.tolerances["reach"]
        if any(reach.si(scale) <= coincide.si(scale) for scale in _SCALES):
            raise ProfileError("profile.reach", value=str(reach), other=str(coincide), **place)
