# SPDX-License-Identifier: MIT
"""Names that people write, compared as people read them."""

import difflib
import unicodedata
from collections.abc import Iterable
from functools import lru_cache

_REMEMBERED = 4096  #: names: lists repeat a few of them thousands of times
_SHORT = 3  #: letters of a word that is not taken for a plural: ``"S"`` is a facade
#: plurals of Portuguese that change more than their last letter: vãos, portões, painéis, óis, gradis
_ENDINGS = {"oes": "ao", "aes": "ao", "ais": "al", "eis": "el", "ois": "ol", "is": "il"}


@lru_cache(maxsize=_REMEMBERED)
def folded(name: str) -> str:
    """Name without regard to case, blanks around it, and whether accents are composed.

    Examples
    --------
    >>> folded(" Pe\u0301-direito ") == folded("P\u00c9-DIREITO")
    True
    """
    if name.isascii():
        return name.strip().casefold()
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name.strip()).casefold())


def unaccented(name: str) -> str:
    """Name folded, and without accents.

    Examples
    --------
    >>> unaccented("Obrigat\u00f3rio")
    'obrigatorio'
    """
    letters = unicodedata.normalize("NFD", folded(name))
    return "".join(letter for letter in letters if not unicodedata.combining(letter))


def likeness(one: str, two: str) -> float:
    """Share of letters that two names have in common, 0 to 1, without regard to case and accents."""
    return difflib.SequenceMatcher(None, unaccented(one), unaccented(two), autojunk=False).ratio()


def nearest(word: str, known: Iterable[str]) -> list[str]:
    """Known names, those that are most like a word first; others stay in their order.

    Examples
    --------
    >>> nearest("chek", ["audit", "check", "init"])
    ['check', 'audit', 'init']
    """
    names = list(known)
    alike = [likeness(word, name) for name in names]
    return [names[n] for n in sorted(range(len(names)), key=lambda n: -alike[n])]


@lru_cache(maxsize=_REMEMBERED)
def of_kind(name: str) -> str:
    """Key of a kind of thing: singular and plural, with and without accents, have one.

    A key to compare by, and no word to show: of what English and Portuguese add in plurals it leaves only what they
    have in common.

    Examples
    --------
    >>> of_kind("Janelas") == of_kind("janela"), of_kind("arches") == of_kind("Arch")
    (True, True)
    >>> of_kind("Port\u00f5es de ferro") == of_kind("portao de ferro")
    True
    """
    return " ".join(_singular(word) for word in unaccented(name).split())


def _singular(word: str) -> str:
    if len(word) <= _SHORT:
        return word
    for plural, ending in _ENDINGS.items():
        if word.endswith(plural):
            return word.removesuffix(plural) + ending
    if word.endswith("s") and not word.endswith("ss"):
        word = word.removesuffix("s")
    if word.endswith("ie"):
        return word.removesuffix("ie") + "y"
    # flor, flores; arch, arches; fixture, fixtures
    return word.removesuffix("e") if word.endswith(("re", "ze", "se", "che", "she", "xe")) else word
