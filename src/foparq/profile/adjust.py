# SPDX-License-Identifier: MIT
"""Profiles changed for one run: rules chosen, tolerances set."""

from collections.abc import Collection, Mapping, Sequence

from pydantic import BaseModel, ValidationError

from foparq.errors import QuantityError, UsageError
from foparq.names import nearest
from foparq.profile.schema import CheckSpec, LineworkSpec, Profile, ReadingSpec
from foparq.units import parse_any_quantity

_EXAMPLE = "undershoot.reach=10mm"
#: tables of a profile of which single keys may be set
_SECTIONS: Mapping[str, tuple[type[BaseModel], str]] = {
    "reading": (ReadingSpec, "reading.blocks=skip"), "linework": (LineworkSpec, "linework.alongside=10deg")
}  # fmt: skip
_SHOWN = 8  #: tolerances that a message names, nearest first


def choose(profile: Profile, names: Collection[str], helpers: Collection[str] = ()) -> Profile:
    """Profile that runs only the named rules, with the elements that need no other.

    Parameters
    ----------
    names : collection of str
        Rules whose findings are told.
    helpers : collection of str
        Rules that those require: they run in silence, so that what they find at fault is not judged twice.
    """
    kept = set(names)
    checks = tuple(
        spec.model_copy(update={"helper": spec.rule not in kept})
        for spec in profile.checks
        if spec.rule in kept or spec.rule in helpers
    )
    elements = tuple(spec for spec in profile.elements if set(spec.uses) <= kept)
    return profile.model_copy(update={"checks": checks, "elements": elements})


def with_settings(profile: Profile, settings: Sequence[str]) -> Profile:
    """Profile with tolerances and reading options set on the command line.

    Parameters
    ----------
    settings : sequence of str
        ``"undershoot.reach=10mm"``, ``"*.coincide=1um"`` for every rule that has the tolerance,
        ``"reading.blocks=skip"``, ``"linework.alongside=10deg"``.

    Raises
    ------
    UsageError
        If a setting is not understood, or names nothing of the profile.
    """
    for setting in settings:
        profile = _with_setting(profile, setting)
    return profile


def _with_setting(profile: Profile, setting: str) -> Profile:
    target, equals, text = setting.partition("=")
    name, dot, key = target.strip().rpartition(".")
    if not equals or not dot:
        raise UsageError("usage.setting", value=setting, example=_EXAMPLE)
    if name in _SECTIONS:
        return _with_section(profile, name, key, text.strip(), setting)
    try:
        quantity = parse_any_quantity(text)
    except QuantityError:
        raise UsageError("usage.setting", value=setting, example=_EXAMPLE) from None
    changed = 0
    checks: list[CheckSpec] = []
    for spec in profile.checks:
        if name in {spec.rule, "*"} and key in spec.tolerances:
            changed += 1
            checks.append(spec.model_copy(update={"tolerances": {**spec.tolerances, key: quantity}}))
        else:
            checks.append(spec)
    if not changed:
        known = sorted(f"{spec.rule}.{tolerance}" for spec in profile.checks for tolerance in spec.tolerances)
        near = nearest(target.strip(), known)
        shown = ", ".join([*near[:_SHOWN], *([f"+{len(near) - _SHOWN}"] if len(near) > _SHOWN else [])])
        example = f"{near[0]}={_EXAMPLE.partition('=')[2]}" if near else _EXAMPLE
        raise UsageError("usage.setting-unknown", value=target.strip(), known=shown, example=example)
    return profile.model_copy(update={"checks": tuple(checks)})


def _with_section(profile: Profile, section: str, key: str, text: str, setting: str) -> Profile:
    model, example = _SECTIONS[section]
    if key not in model.model_fields:
        raise UsageError(
            "usage.setting-unknown",
            value=f"{section}.{key}",
            known=", ".join(nearest(key, model.model_fields)),
            example=example,
        )
    try:
        changed = model.model_validate({**dict(getattr(profile, section)), key: text})
    except (ValidationError, QuantityError):
        raise UsageError("usage.setting", value=setting, example=example) from None
    return profile.model_copy(update={section: changed})
