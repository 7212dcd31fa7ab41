# SPDX-License-Identifier: MIT
"""Names, titles and elements that a reader could take for those of a specification that comes with foparq."""

import re
import tomllib
from collections.abc import Sequence
from difflib import SequenceMatcher
from functools import cache
from typing import Any

from foparq.errors import ProfileError
from foparq.profile.elements import ElementSpec, results_of
from foparq.profile.find import shipped_profiles
from foparq.profile.letters import odd_letters, shown_letters, skeleton
from foparq.profile.toml_text import TomlText
from foparq.resources import shipped

_OWN_WORD = 6  #: letters of a word that is a specification's own, such as "FOPARQ"
_LIKE = 0.9  #: share of letters in common with which two texts are read as the same
_EXAMPLES = {"name": 'name = "caderno-da-obra"', "title": 'title.pt-BR = "Caderno de encargos da obra"'}
_LONGEST = 200  #: letters of a name or title: it stands in the first lines of every report
_SHOWN = 80  #: letters of a wrong value that a message repeats


def mistaken_for(text: str, *, words: bool = True) -> str | None:
    """Shipped name or title, or a word of a specification's own, that a text could be taken for.

    Parameters
    ----------
    words : bool
        False if such a word alone is none of its claims.
    """
    read = skeleton(text)
    for claim, known in _claims(words=words):
        if known in read or SequenceMatcher(None, read, known, autojunk=False).ratio() >= _LIKE:
            return claim
    return None


@cache
def _claims(*, words: bool) -> tuple[tuple[str, str], ...]:
    """Names, titles and designations of the shipped profiles, and words of their own, with their skeletons."""
    texts = [text for name, data in _shipped().items() for text in (name, *data["title"].values())]
    designations = [text.partition(",")[0] for text in texts]
    single = [word for text in designations for word in re.split(r"[/\s-]", text) if len(word) >= _OWN_WORD]
    return tuple((text, skeleton(text)) for text in dict.fromkeys([*texts, *designations, *(single if words else [])]))


@cache
def _shipped() -> dict[str, dict[str, Any]]:
    """Profiles that come with foparq, as their files say."""
    folder = shipped("rules") / "profiles"
    return {name: tomllib.loads((folder / f"{name}.toml").read_text(encoding="utf-8")) for name in shipped_profiles()}


def refuse_false_claims(text: TomlText) -> None:
    """Refuse a profile of one's own whose name, title or file could be taken for that of a shipped one.

    Raises
    ------
    ProfileError
        Which shows the value, what it could be taken for, and a right example.
    """
    if claim := mistaken_for(text.path.stem, words=False):
        raise ProfileError("profile.file-mistakable", file=str(text.path), other=claim, example="regras.toml")
    title = text.data.get("title", {})
    if not isinstance(title, dict):
        raise ProfileError(
            "toml.wrong-value", file=str(text.path), line=text.line(("title",)), key="title",
            value=str(title)[:_SHOWN], example=_EXAMPLES["title"],
        )  # fmt: skip
    said = [(("name",), text.data.get("name")), *((("title", language), value) for language, value in title.items())]
    for place, value in said:
        if isinstance(value, str):
            _refuse(text, place, value)


def refuse_false_elements(text: TomlText, elements: Sequence[ElementSpec], *, own: bool) -> None:
    """Refuse elements that pass for others.

    Two whose results could not be told apart: what is said of one would hold for the other. And, in a profile of one's
    own, one that bears the id of a shipped element, by which reports name it, and is of another kind.

    Raises
    ------
    ProfileError
        Which names the element and a right example.
    """
    kinds = {one["id"]: one["kind"] for data in _shipped().values() for one in data["element"]} if own else {}
    written = [table.get("id") for table in text.data.get("element", [])]
    for number, spec in enumerate(elements):
        others = [other.id for n, other in enumerate(elements) if n != number and spec.id in results_of(other.id)]
        known = next((id_ for id_ in kinds if spec.id in results_of(id_)), spec.id)
        line = text.line(("element", written.index(spec.id))) if spec.id in written else 1
        place = {"file": str(text.path), "line": line, "value": spec.id, "example": 'id = "Q9"'}
        if others:
            raise ProfileError("profile.element-twice", other=others[0], **place)
        if kinds.get(known, spec.kind) != spec.kind:
            raise ProfileError("profile.element-kind", other=kinds[known], kind=spec.kind, **place)


def _refuse(text: TomlText, place: tuple[str, ...], value: str) -> None:
    fields = {
        "file": str(text.path), "line": text.line(place), "key": ".".join(place), "value": value[:_SHOWN],
        "example": _EXAMPLES[place[0]],
    }  # fmt: skip
    if place == ("name",) and value in shipped_profiles():
        raise ProfileError("profile.name-taken", **{**fields, "example": _EXAMPLES["name"]})
    if len(value) > _LONGEST:
        raise ProfileError("profile.long-name", limit=_LONGEST, **fields)
    if odd := odd_letters(value):
        raise ProfileError("profile.odd-letters", letters=shown_letters(odd), **fields)
    if claim := mistaken_for(value):
        raise ProfileError("profile.mistakable", other=claim, **fields)
    if not skeleton(value):
        raise ProfileError("profile.nameless", **fields)
