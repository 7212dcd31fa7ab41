# SPDX-License-Identifier: MIT
"""Letters as a hasty eye reads them: what looks alike, and what cannot be seen."""

import unicodedata
from collections.abc import Sequence

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
_MOST = 5  #: letters that a message shows


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


def shown_letters(letters: Sequence[str]) -> list[str]:
    """The first letters with their code points: ``["\u0430 (U+0430)"]``."""
    return [f"{letter} (U+{ord(letter):04X})" for letter in letters[:_MOST]]
