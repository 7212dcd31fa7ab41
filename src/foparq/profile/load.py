# SPDX-License-Identifier: MIT
"""Profiles and manifests from files, with errors that name file, line, key, value and a right example."""

import contextlib
import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from foparq.errors import ManifestError, ProfileError, QuantityError, UsageError
from foparq.profile.elements import ElementSpec
from foparq.profile.manifest import Manifest
from foparq.profile.schema import CheckSpec, Profile
from foparq.profile.toml_text import TomlText, read_toml
from foparq.resources import shipped

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
    "limits",
    "check",
    "element",
}
#: a right example for a key, shown when its value is wrong
_EXAMPLES = {
    "coarsest": 'coarsest = "1:200"',
    "drawing": "[[drawing]]",
    "apart": 'apart = "1 mm @ scale"',
    "areas": 'areas = ["REVESTIMENTO"]',
    "blocks": 'blocks = "explode"',
    "classes": 'classes = { "PORTA*" = "door" }',
    "crs": 'crs = "local"',
    "facade": 'facade = "N"',
    "finest": 'finest = "1:1"',
    "gap": 'gap = "0.2 mm @ scale"',
    "hidden": 'hidden = "leave"',
    "by": 'by = "name and office"',
    "confirmed": "[[confirmed]]",
    "kind": 'kind = "omission"',
    "language": 'language = "pt-BR"',
    "layers": 'layers = ["PAREDE*"]',
    "on": 'on = { reference = ["EIXO*"] }',
    "limit": 'limit = "5 %"',
    "path": 'path = "fachada.dxf"',
    "plane": 'plane = "xz"',
    "product_class": 'product_class = "A"',
    "profile": 'profile = "et-doc-foparq-a"',
    "reason": 'reason = "why it is right all the same"',
    "required": "required = true",
    "rule": 'rule = "undershoot"',
    "search": 'search = "1 mm @ scale"',
    "sagitta": 'sagitta = "0.001 mm @ scale"',
    "scale": 'scale = "1:50"',
    "severity": 'severity = "major"',
    "survey_sd": 'survey_sd = "3 mm"',
    "tie": 'tie = "0.02 mm @ scale"',
    "title": 'title = "Estação"',
    "unit": 'unit = "m"',
    "value": 'value = "mm"',
    "visible": 'visible = "0.2 mm @ scale"',
    "what": 'what = "unit"',
}

_SHOWN = 80  #: letters of a wrong value that a message repeats

_Model = TypeVar("_Model", bound=BaseModel)


def shipped_profiles() -> list[str]:
    """Names of the profiles that travel with foparq."""
    return sorted(path.stem for path in (shipped("rules") / "profiles").glob("*.toml"))


def load_profile(name: str, beside: Path | None = None) -> Profile:
    """Profile by shipped name or path.

    Parameters
    ----------
    name : str
        ``"et-doc-foparq-a"``, or a path ending in ``.toml``.
    beside : Path, optional
        Folder that a relative path starts from.

    Raises
    ------
    ProfileError
        If there is none, or something in it is wrong.
    """
    path = _find(name, beside)
    text = read_toml(path, ProfileError)
    data = dict(text.data)
    digest = hashlib.sha256(path.read_bytes())
    if "extends" in data:
        base_path = _find(str(data.pop("extends")), path.parent)
        base = read_toml(base_path, ProfileError)
        if "extends" in base.data:
            raise ProfileError(
                "profile.extends-twice", file=str(path), line=text.line(("extends",)), value=base_path.stem
            )
        digest.update(base_path.read_bytes())
        checks = _replace(_checks(base), _checks(text), "rule")
        elements = _replace(_elements(base), _elements(text), "id")
        data = {**base.data, **data}
    else:
        checks, elements = _checks(text), _elements(text)
    for key in data:
        if key not in _TOP_KEYS:
            raise ProfileError(
                "toml.unknown-key",
                file=str(path),
                line=text.line((key,)),
                key=key,
                example=", ".join(sorted(_TOP_KEYS)),
            )
    plain = {key: value for key, value in data.items() if key not in {"check", "element"}}
    made = {
        **plain,
        "checks": tuple(checks),
        "elements": tuple(elements),
        "path": str(path),
        "sha256": digest.hexdigest(),
    }
    profile = _validated(Profile, made, text, ProfileError)
    if profile.name in shipped_profiles() and path.parent.resolve() != (shipped("rules") / "profiles").resolve():
        line = text.line(("name",))
        raise ProfileError(
            "profile.name-taken", file=str(path), line=line, value=profile.name, example='name = "my-own"'
        )
    return profile


def load_manifest(path: Path) -> Manifest:
    """Manifest of a delivery.

    Raises
    ------
    ManifestError
        If the file cannot be read or something in it is wrong.
    """
    text = read_toml(path, ManifestError)
    return _validated(Manifest, text.data, text, ManifestError)


def _find(name: str, beside: Path | None) -> Path:
    path = None
    if name.endswith(".toml"):
        path = (beside or Path()) / name
    elif "/" not in name and "\\" not in name:
        path = shipped("rules") / "profiles" / f"{name}.toml"
    with contextlib.suppress(OSError):  # of a name that is longer than the file system allows
        if path is not None and path.is_file():
            return path
    raise ProfileError(
        "profile.unknown", value=name[:_SHOWN], known=", ".join(shipped_profiles()), example="et-doc-foparq-a"
    )


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
            raise ProfileError("profile.unknown-kind", value=kind, known=", ".join(sorted(ElementSpec.KINDS)), **place)
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
        example = _EXAMPLES.get(known, "").partition(" = ")[2].strip('"') or error.fields.get("example", "")
        fields = {**error.fields, "example": example, "file": str(text.path), "line": text.line((*prefix, *place))}
        raise kind(f"{error.message}-at", key=".".join(map(str, place)), **fields) from None
    except ValidationError as errors:
        first = errors.errors(include_url=False)[0]
        place = _resolved(data, first["loc"], missing=first["type"] == "missing")
        key = str(next((part for part in reversed(place) if isinstance(part, str)), ""))
        fields = {"file": str(text.path), "line": text.line((*prefix, *place)), "key": key}
        if first["type"] == "extra_forbidden":
            raise kind("toml.unknown-key", example=", ".join(_keys(model, place)), **fields) from None
        if first["type"] == "missing":
            raise kind("toml.missing-key", example=_EXAMPLES.get(key, f"{key} = ..."), **fields) from None
        example = _EXAMPLES.get(key, str(first["msg"]))
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
    return sorted(found.model_fields)


def _model_in(annotation: Any) -> type[BaseModel] | None:  # noqa: ANN401 - a type expression has no type of its own
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((made for part in getattr(annotation, "__args__", ()) if (made := _model_in(part))), None)
