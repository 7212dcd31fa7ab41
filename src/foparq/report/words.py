# SPDX-License-Identifier: MIT
"""Sentences, numbers and dates in the language of the user.

Texts live in gettext catalogues under ``reports/templates/locale``, one file a domain and language; those of rules, the
domain ``rules``, in one file a rule under ``rules/texts``. A message is named ``"domain.id"``:
``words("rules.TOP021.finding", size="4,0 mm")``. Code never holds a sentence.
"""

import gettext
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from foparq.errors import FoparqError
from foparq.report.rule_texts import rule_text
from foparq.resources import shipped

LANGUAGES = ("pt-BR", "en")
DOMAINS = ("cli", "errors", "evaluate", "report")  #: of gettext

#: how a quantity is written for people, by SI unit: below which value, unit, factor from SI, decimals
_OF_FILE = frozenset({"u", "u2"})  #: units of the file, where nobody knows what they are
_LADDERS = {
    "m": ((1e-4, "µm", 1e6, 2), (1.0, "mm", 1e3, 2), (float("inf"), "m", 1.0, 3)),
    "m2": ((1e-2, "mm²", 1e6, 1), (float("inf"), "m²", 1.0, 4)),
    "1": ((1e-4, "%", 1e2, 4), (float("inf"), "%", 1e2, 2)),
    "items": ((float("inf"), "", 1.0, 0),),
    "rad": ((float("inf"), "°", 180 / math.pi, 1),),
}
_PROBABILITY = 3  #: decimals of the probability of a test
MINUS = "\N{MINUS SIGN}"
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Words:
    """Texts of one language.

    Parameters
    ----------
    language : str
        ``"pt-BR"`` or ``"en"``.
    """

    def __init__(self, language: str) -> None:
        if language not in LANGUAGES:
            raise FoparqError("usage.language", value=language, example="pt-BR")
        self.language = language
        self._catalogues: dict[str, gettext.NullTranslations] = {}

    def __call__(self, message: str, /, **fields: object) -> str:
        """Sentence of a message id, with its fields filled in.

        Parameters
        ----------
        message : str
            ``"domain.id"``. In its text ``{count:item|items}`` is the first word where the field says one, the other
            elsewhere, and ``{p:=}`` is ``= 0,204`` or ``< 0,001``.
        **fields : object
            Numbers are written in the manner of the language; a pair (value, unit) is a quantity.

        Raises
        ------
        KeyError
            If the catalogue has no such message or the message names a field that is not given.
        """
        text = self.find(message)
        if text is None:
            raise KeyError(f"no message {message!r} in {self.language}")
        return text.format_map(_Filled(self, fields)) if "{" in text else text

    def find(self, message: str) -> str | None:
        """Text of a message id as it stands in the catalogue, or ``None``."""
        domain, _, key = message.partition(".")
        if domain == "rules":
            return rule_text(key, self.language)
        text = self._catalogue(domain).gettext(key)
        return None if text == key else text

    def joined(self, sentences: Iterable[str]) -> str:
        """Sentences one behind the other; what is no whole sentence is parted by semicolons."""
        made = list(sentences)
        return (" " if all(text.endswith(".") for text in made) else "; ").join(made)

    def listed(self, values: Iterable[object]) -> str:
        """Values in one line, parted by commas."""
        return _write(self, list(values))

    def error(self, error: FoparqError) -> str:
        """Sentence of an error."""
        return self(f"errors.{error.message}", **error.fields)

    def number(self, value: float, decimals: int = 3) -> str:
        """Number with a decimal comma or point: ``"0,010"``."""
        if value != value:  # noqa: PLR0124 - not a number
            return "–"
        text = f"{value:,.{decimals}f}"
        text = text.replace("-", MINUS if text.strip("-0.") else "")
        if self.language == "pt-BR":
            text = text.translate(str.maketrans(",.", ".,"))
        return text

    def count(self, value: float) -> str:
        """Whole number with separators: ``"1.000"``."""
        return self.number(value, 0)

    def quantity(self, value: float, unit: str) -> str:
        """Quantity as people write it: ``"9,79 mm"``, ``"15 mm"``, ``"0,3 m²"``, ``"6,76 %"``.

        A bare number that is not nought is not written as nought: ``"3 × 10⁻⁷"``.
        """
        if unit in _OF_FILE:
            return self(f"report.quantity.{unit}", value=self.number(value, 3).rstrip("0").rstrip(".,"))
        ladder = _LADDERS.get(unit, ((float("inf"), unit, 1.0, 3),))
        name, factor, decimals = next((row[1:] for row in ladder if abs(value) < row[0]), ladder[-1][1:])
        if not unit and 0.0 < abs(value) < 0.5 * 10.0**-decimals:
            digit, power = f"{value:.0e}".split("e")
            digit = digit.replace("-", MINUS)
            return f"{digit} × 10{str(int(power)).translate(_RAISED)}"
        text = self.number(value * factor, decimals)
        if decimals:
            text = text.rstrip("0").rstrip(".,")
        return f"{text}°" if name == "°" else f"{text} {name}".rstrip()

    def probability(self, value: float) -> str:
        """Probability of a test: ``"0,204"``; one that would be written as nought as ``"< 0,001"``."""
        if 0.0 <= value < 10.0**-_PROBABILITY:
            return f"< {self.number(10.0**-_PROBABILITY, _PROBABILITY)}"
        return self.number(value, _PROBABILITY).rstrip("0").rstrip(".,")

    def column(self, values: Sequence[float]) -> list[str]:
        """Lengths of one column of a table, metres, in the unit of the greatest and with as many decimals each."""
        ladder = _LADDERS["m"]
        greatest = max(map(abs, values), default=0.0)
        name, factor, decimals = next((row[1:] for row in ladder if greatest < row[0]), ladder[-1][1:])
        return [f"{self.number(value * factor, decimals)} {name}" for value in values]

    def _catalogue(self, domain: str) -> gettext.NullTranslations:
        if domain not in self._catalogues:
            self._catalogues[domain] = _load(domain, self.language.replace("-", "_"))
        return self._catalogues[domain]


class _Filled(dict[str, "_Field"]):
    """Fields of a sentence, written in the manner of the language."""

    def __init__(self, words: Words, fields: Mapping[str, object]) -> None:
        super().__init__({name: _Field(words, value) for name, value in fields.items()})


@dataclass(frozen=True, slots=True)
class _Field:
    """One field; ``{n:item|items}`` is the word that goes with it, ``{p:=}`` a probability with its sign."""

    words: Words
    value: object

    def __format__(self, spec: str) -> str:
        told = _write(self.words, self.value)
        if "|" in spec:
            one, _, many = spec.partition("|")
            return one if told == "1" else many
        if spec == "=":
            number = self.value[0] if isinstance(self.value, tuple) else self.value
            told = self.words.probability(number) if isinstance(number, float) else told
            return told if told.startswith("<") else f"= {told}"
        return format(told, spec)


def _write(words: Words, value: object) -> str:
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], int | float) and isinstance(value[1], str):  # noqa: PLR2004
        return words.quantity(float(value[0]), value[1])
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return words.number(value)
    if isinstance(value, list | tuple | set | frozenset):
        return ", ".join(_write(words, part) for part in value)
    return printable(str(value))


def printable(text: str) -> str:
    """Text of a delivery made safe to show: control and bidirectional characters as escapes."""
    return text if text.isprintable() else "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in text)


def language_named(text: str) -> str | None:
    """Language of a tag or locale: ``"pt"``, ``"pt_BR.UTF-8"``, ``"en-GB"``; ``None`` if it is none that is spoken.

    Examples
    --------
    >>> language_named("pt"), language_named("EN_us"), language_named("de")
    ('pt-BR', 'en', None)
    """
    tag = text.strip().replace("_", "-").partition(".")[0].partition("@")[0].partition("-")[0].casefold()
    return {"pt": "pt-BR", "en": "en", "c": "en", "posix": "en"}.get(tag)


def language_of(asked: str | None = None) -> str:
    """Language to speak: as asked, else the locale's, else English.

    Parameters
    ----------
    asked : str, optional
        ``--lang`` or the manifest's ``language``.
    """
    candidates = [asked or "", *(os.environ.get(name, "") for name in ("LC_ALL", "LC_MESSAGES", "LANGUAGE", "LANG"))]
    spoken = (language_named(part) for candidate in candidates for part in candidate.split(":"))
    return next((language for language in spoken if language), "en")


@cache
def _load(domain: str, language: str) -> gettext.NullTranslations:
    return gettext.translation(domain, shipped("templates") / "locale", languages=[language])
