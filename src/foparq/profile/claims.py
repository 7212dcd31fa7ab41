# SPDX-License-Identifier: MIT
"""Names and titles that a reader could take for those of a specification that comes with foparq."""

import tomllib
import unicodedata
from collections.abc import Iterator
from difflib import SequenceMatcher
from functools import cache

from foparq.errors import ProfileError
from foparq.profile.find import shipped_profiles
from foparq.profile.toml_text import TomlText
from foparq.resources import shipped

#: letters and signs of European texts that do not decompose into ASCII, and what they are read as
_USUAL = {
    "æ": "ae", "œ": "oe", "ø": "o", "đ": "d", "ð": "d", "þ": "p", "ł": "l", "ı": "i", "ß": "ss", "€": "e",
    **dict.fromkeys("–—‘’“”«»·§°•", ""),
}  # fmt: skip
#: what is read as another letter
_ALIKE = str.maketrans(
    {
        **dict.fromkeys("0", "o"), **dict.fromkeys("1i!|", "l"), **dict.fromkeys("3", "e"), **dict.fromkeys("5$", "s"),
        **dict.fromkeys("4@", "a"), **dict.fromkeys("7+", "t"), **dict.fromkeys("68", "b"), **dict.fromkeys("9g", "q"),
        **dict.fromkeys("2", "z"), **dict.fromkeys("(<", "c"),
    }
)  # fmt: skip
_PAIRS = (("rn", "m"), ("vv", "w"), ("cl", "d"))  #: two letters that are read as one
_OWN_WORD = 6  #: letters of a word that is a specification's own, such as "FOPARQ"
_LIKE = 0.9  #: share of letters in common with which two texts are read as the same
_EXAMPLES = {"name": 'name = "caderno-da-obra"', "title": 'title.pt-BR = "Caderno de encargos da obra"'}
_LONGEST = 200  #: letters of a name or title: it stands in the first lines of every report
_SHOWN = 80  #: letters of a wrong value that a message repeats


def skeleton(text: str) -> str:
    """What is left of a text for a hasty eye: small letters without accents, signs and spaces.

    Examples
    --------
    >>> skeleton("ＥＴ/D0C\u2011Fóparq_A") == skeleton("et-doc-foparq-a")
    True
    """
    plain = unicodedata.normalize("NFKD", unicodedata.normalize("NFKD", text).casefold())
    read = "".join(_USUAL.get(letter, letter) for letter in plain).translate(_ALIKE)
    letters = "".join(letter for letter in read if "a" <= letter <= "z")
    for pair, letter in _PAIRS:
        letters = letters.replace(pair, letter)
    return letters


def odd_letters(text: str) -> list[str]:
    """Letters and signs of other scripts, invisible ones, and marks that belong to no letter, each once."""
    composed = unicodedata.normalize("NFC", text)
    return list(dict.fromkeys(letter for letter in composed if not _is_usual(letter)))


def _is_usual(letter: str) -> bool:
    if letter.casefold() in _USUAL:
        return True
    base = [part for part in unicodedata.normalize("NFKD", letter) if not unicodedata.combining(part)]
    return bool(base) and all(part.isascii() and part.isprintable() for part in base)


def mistaken_for(text: str) -> str | None:
    """Shipped name, title or word of a specification that a text could be taken for."""
    read = skeleton(text)
    for claim, known in _claims():
        if known in read or SequenceMatcher(None, read, known, autojunk=False).ratio() >= _LIKE:
            return claim
    return None


@cache
def _claims() -> tuple[tuple[str, str], ...]:
    """Names, titles, designations and own words of the shipped profiles, with their skeletons."""
    texts = dict.fromkeys(text for name in shipped_profiles() for text in _of_shipped(name))
    return tuple((text, skeleton(text)) for text in texts)


def _of_shipped(name: str) -> Iterator[str]:
    data = tomllib.loads((shipped("rules") / "profiles" / f"{name}.toml").read_text(encoding="utf-8"))
    yield name
    for title in data["title"].values():
        yield title
        designation, _, _ = title.partition(",")
        yield designation
        yield from (word for word in designation.replace("/", " ").replace("-", " ").split() if len(word) >= _OWN_WORD)


def refuse_false_claims(text: TomlText) -> None:
    """Refuse a profile of one's own whose name or title could be taken for that of a shipped one.

    Raises
    ------
    ProfileError
        Which shows the value, what it could be taken for, and a right example.
    """
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


def _refuse(text: TomlText, place: tuple[str, ...], value: str) -> None:
    fields = {
        "file": str(text.path), "line": text.line(place), "key": ".".join(place), "value": value[:_SHOWN],
        "example": _EXAMPLES[place[0]],
    }  # fmt: skip
    if place == ("name",) and value in shipped_profiles():
        raise ProfileError("profile.name-taken", **{**fields, "example": _EXAMPLES["name"]})
    if odd := odd_letters(value):
        shown = [f"{letter} (U+{ord(letter):04X})" for letter in odd[:5]]
        raise ProfileError("profile.odd-letters", letters=shown, **fields)
    if claim := mistaken_for(value):
        raise ProfileError("profile.mistakable", other=claim, **fields)
    if not skeleton(value):
        raise ProfileError("profile.nameless", **fields)
    if len(value) > _LONGEST:
        raise ProfileError("profile.long-name", limit=_LONGEST, **fields)
