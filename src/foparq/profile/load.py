# SPDX-License-Identifier: MIT
"""Profiles and manifests from files, with errors that name file, line, key, value and a right example."""

import hashlib
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError

from foparq.errors import ManifestError, ProfileError, QuantityError, UsageError
from foparq.names import nearest
from foparq.profile.claims import refuse_false_claims, refuse_false_elements
from foparq.profile.elements import ElementSpec
from foparq.profile.examples import EXAMPLES
from foparq.profile.find import find_profile, is_shipped, shipped_profiles
from foparq.profile.manifest import Language, Manifest, spoken
from foparq.profile.schema import CheckSpec, Profile, ProfileFile
from foparq.profile.toml_text import TomlText, read_toml

__all__ = ["load_manifest", "load_profile", "shipped_profiles"]

_CHECK_KEYS = {"rule", "severity", "layers", "on", "apart"}
_TOP_KEYS = {
    "name",
    "extends",
    "title",
    "product_class",
    "norms",
    "scale",
    "reading",
    "completeness",
    "evidence",
    "linework",
    "mesh",
    "limits",
    "check",
    "element",
}
#: what a profile of one's own says itself: it inherits no claim
_OWN_KEYS = {"name", "title", "norms"}
#: where a manifest that is not TOML states its language
_LANGUAGE_LINE = re.compile(r"""^\s*language\s*=\s*["']([\w-]{2,8})["']""", re.MULTILINE)
_FIRST_BYTES = 65_536  #: of such a file
_SHOWN = 80  #: letters of a wrong value that a message repeats

_Model = TypeVar("_Model", bound=BaseModel)


def load_profile(name: str, beside: Path | None = None, within: Path | None = None) -> Profile:
    """Profile by shipped name or path.

    Parameters
    ----------
    name : str
        ``"et-doc-foparq-a"``, or a path ending in ``.toml``.
    beside : Path, optional
        Folder that a relative path starts from.
    within : Path, optional
        Folder that neither the profile nor what it extends may lie outside of, if they are not shipped.

    Returns
    -------
    Profile
        One that is not shipped inherits checks, elements and settings of what it extends, never its name, title or
        norms.

    Raises
    ------
    ProfileError
        If there is none, something in it is wrong, or its name or title could be taken for a shipped one.
    """
    path = find_profile(name, beside, within)
    text = read_toml(path, ProfileError)
    base = _base(text, within)
    data = {key: value for key, value in text.data.items() if key != "extends"}
    checks, elements = _checks(text), _elements(text)
    if base is not None:
        checks = _replace(_checks(base), checks, "rule")
        elements = _replace(_elements(base), elements, "id")
        mine = set() if is_shipped(path) else _OWN_KEYS
        data = {**{key: value for key, value in base.data.items() if key not in mine}, **data}
    for key in data:
        if key not in _TOP_KEYS:
            raise ProfileError(
                "toml.unknown-key",
                file=str(path),
                line=text.line((key,)),
                key=key,
                example=", ".join(nearest(key, sorted(_TOP_KEYS))),
            )
    own = [part for part in (text, base) if part is not None and not is_shipped(part.path)]
    for part in own:
        refuse_false_claims(part)
    refuse_false_elements(text, elements, own=bool(own))
    plain = {key: value for key, value in data.items() if key not in {"check", "element"}}
    made = {
        **plain,
        "checks": tuple(checks),
        "elements": tuple(elements),
        "path": str(path),
        "sha256": text.sha256 if base is None else _joint_hash(text.sha256, base.sha256),
        "extends": "" if base is None else base.path.stem if is_shipped(base.path) else str(base.path),
        "files": tuple(ProfileFile(path=part.path, sha256=part.sha256, bytes=part.size) for part in own),
    }
    return _validated(Profile, made, text, ProfileError)


def _base(text: TomlText, within: Path | None) -> TomlText | None:
    """What a profile extends."""
    if "extends" not in text.data:
        return None
    place = {"file": str(text.path), "line": text.line(("extends",))}
    name = text.data["extends"]
    if not isinstance(name, str):
        raise ProfileError("toml.wrong-value", key="extends", value=name, example=EXAMPLES["extends"], **place)
    base = read_toml(find_profile(name, text.path.parent, within, place), ProfileError)
    if "extends" in base.data:
        raise ProfileError("profile.extends-twice", value=base.path.stem, **place)
    return base


def _joint_hash(own: str, base: str) -> str:
    """Hash of a profile and of what it extends: of two lines, the SHA-256 of the one and of the other."""
    return hashlib.sha256(f"{own}\n{base}\n".encode()).hexdigest()


def load_manifest(path: Path) -> Manifest:
    """Manifest of a delivery.

    Raises
    ------
    ManifestError
        If the file cannot be read or something in it is wrong.
    """
    text = read_toml(path, ManifestError)
    return _validated(Manifest, text.data, text, ManifestError)


def stated_language(path: Path) -> str | None:
    """Language that a manifest asks for, whatever else may be wrong in it; ``None`` if it names none that is known."""
    try:
        delivery = read_toml(path, ManifestError).data.get("delivery")
    except ManifestError:
        return _language_line(path)
    language = spoken(delivery.get("language")) if isinstance(delivery, Mapping) else None
    return str(language) if language in get_args(Language) else None


def _language_line(path: Path) -> str | None:
    """Language that a line of a file states which is not TOML."""
    try:
        with path.open("rb") as file:
            text = file.read(_FIRST_BYTES).decode("utf-8", errors="replace")
    except OSError:
        return None
    stated = _LANGUAGE_LINE.search(text)
    language = spoken(stated[1]) if stated else None
    return str(language) if language in get_args(Language) else None


def _checks(text: TomlText) -> list[CheckSpec]:
    made = []
    for number, table in enumerate(_tables(text, "check")):
        tolerances = {key: value for key, value in table.items() if key not in _CHECK_KEYS}
        known = {key: value for key, value in table.items() if key in _CHECK_KEYS}
        spec = {**known, "tolerances": tolerances, "file": str(text.path), "line": text.line(("check", number))}
        made.append(_validated(CheckSpec, spec, text, ProfileError, ("check", number)))
    return made


def _elements(text: TomlText) -> list[ElementSpec]:
    made = []
    for number, table in enumerate(_tables(text, "element")):
        kind = table.get("kind")
        known = ElementSpec.KINDS.get(kind) if isinstance(kind, str) else None
        if kind is not None and known is None:
            place = {"file": str(text.path), "line": text.line(("element", number, "kind"))}
            kinds = ", ".join(nearest(str(kind), sorted(ElementSpec.KINDS)))
            raise ProfileError("profile.unknown-kind", value=kind, known=kinds, **place)
        made.append(_validated(known or ElementSpec, table, text, ProfileError, ("element", number)))
    return made


def _tables(text: TomlText, key: str) -> list[Mapping[str, Any]]:
    tables = text.data.get(key, [])
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise ProfileError(
            "toml.wrong-value", file=str(text.path), line=text.line((key,)), key=key, value=tables, example=f"[[{key}]]"
        )
    return tables


def _replace(base: Sequence[_Model], own: Sequence[_Model], key: str) -> list[_Model]:
    """Entries of the base, those with the same key replaced in their place, new ones behind."""
    inherited, mine = _by_key(base, key), _by_key(own, key)
    return [entry for name in {**inherited, **mine} for entry in mine.get(name, inherited.get(name, []))]


def _by_key(entries: Sequence[_Model], key: str) -> dict[str, list[_Model]]:
    grouped: dict[str, list[_Model]] = {}
    for entry in entries:
        grouped.setdefault(getattr(entry, key), []).append(entry)
    return grouped


def _validated(
    model: type[_Model],
    data: Mapping[str, Any],
    text: TomlText,
    kind: type[UsageError],
    prefix: tuple[str | int, ...] = (),
) -> _Model:
    try:
        return model.model_validate(data)
    except QuantityError as error:
        place = _place_of(data, error.fields.get("value"))
        known = str(place[-1]) if place else ""
        example = EXAMPLES.get(known, "").partition(" = ")[2].strip('"') or error.fields.get("example", "")
        if error.message == "quantity.unknown-unit":
            example = f'{known} = "{error.fields["example"]}"'
        fields = {**error.fields, "example": example, "file": str(text.path), "line": text.line((*prefix, *place))}
        raise kind(f"{error.message}-at", key=".".join(map(str, place)), **fields) from None
    except ValidationError as errors:
        first = errors.errors(include_url=False)[0]
        place = _resolved(data, first["loc"], missing=first["type"] == "missing")
        key = str(next((part for part in reversed(place) if isinstance(part, str)), ""))
        fields = {"file": str(text.path), "line": text.line((*prefix, *place)), "key": key}
        if first["type"] == "extra_forbidden":
            raise kind("toml.unknown-key", example=", ".join(nearest(key, _keys(model, place))), **fields) from None
        if first["type"] == "missing":
            raise kind("toml.missing-key", example=EXAMPLES.get(key, f"{key} = ..."), **fields) from None
        example = EXAMPLES.get(key, str(first["msg"]))
        raise kind("toml.wrong-value", value=str(first["input"])[:_SHOWN], example=example, **fields) from None


def _resolved(data: object, loc: Sequence[str | int], *, missing: bool) -> tuple[str | int, ...]:
    """The part of pydantic's way that exists in the file; the rest names branches of a type."""
    way: list[str | int] = []
    for part in loc:
        if isinstance(data, Mapping) and part in data:
            data = data[str(part)]
        elif isinstance(data, list | tuple) and isinstance(part, int) and part < len(data):
            data = data[part]
        elif not (missing and isinstance(data, Mapping)):
            break
        way.append(part)
    return tuple(part for part in way if part != "tolerances")


def _place_of(data: object, value: object) -> tuple[str | int, ...]:
    """Way to the value that was not understood; a QuantityError leaves pydantic without its place."""
    pairs: list[tuple[str | int, object]] = []
    if isinstance(data, Mapping):
        pairs = list(data.items())
    elif isinstance(data, list | tuple):
        pairs = list(enumerate(data))
    for key, part in pairs:
        way: tuple[str | int, ...] = () if key == "tolerances" else (key,)
        if part is value or (isinstance(part, str) and part == value):
            return way
        if (deeper := _place_of(part, value)) != ():
            return (*way, *deeper)
    return ()


def _keys(model: type[BaseModel], place: tuple[str | int, ...]) -> list[str]:
    """Keys that the table at this place knows."""
    found: Any = model
    for part in place[:-1]:
        if isinstance(part, int):
            continue
        field = getattr(found, "model_fields", {}).get(part)
        if field is None:
            break
        found = _model_in(field.annotation) or found
    return sorted(field.alias or name for name, field in found.model_fields.items())


def _model_in(annotation: Any) -> type[BaseModel] | None:  # noqa: ANN401 - a type expression has no type of its own
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((made for part in getattr(annotation, "__args__", ()) if (made := _model_in(part))), None)
