# SPDX-License-Identifier: MIT
"""Numbers in the lines of a text."""

import math
import re
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index, Reals
from foparq.read.mesh.text import Bytes, Piece, counts_by_line, decoded, lines_of, uncommented, word_starts

_GREATEST = 1 << 62  #: whole numbers from here on may be others, cut off
#: a number; or what is none, as C libraries write it, those of Windows with a mark
_REAL = re.compile(
    r"[+-]?(?:(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?)"
    r"|(?P<odd>nan(?:\([a-z0-9_]*\))?|inf(?:inity)?|1\.#(?:ind|qnan|snan|inf)))"
)


def reals(text: Bytes, words: int) -> Reals | None:
    """Numbers of a text that holds nothing else; ``None`` if some word is no number.

    Parameters
    ----------
    text : (b,) uint8
    words : int
        Number of words in it.

    Notes
    -----
    O(b). Whole numbers are read as such, which is some times faster, unless they are too large for it.
    """
    if not ((text > ord("9")) | (text == ord("."))).any():
        whole = wholes(text, words)
        if whole is not None and len(whole) and np.abs(whole).max() < _GREATEST:
            return whole.astype(np.float64)
    values: Reals | None = _numbers(text, words, np.float64)
    return values


def wholes(text: Bytes, words: int) -> Index | None:
    """As :func:`reals`, of whole numbers; one that is too large becomes the largest."""
    values: Index | None = _numbers(text, words, np.int64)
    return values


def _numbers(text: Bytes, words: int, kind: type) -> Any:  # noqa: ANN401 - an array of that kind, or None
    if not words:
        return np.empty(0, dtype=kind)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)  # so numpy before 2.3 says that it stopped
            values: NDArray[Any] = np.fromstring(text.tobytes(), dtype=kind, sep=" ")
    except (ValueError, DeprecationWarning):
        return None
    # Two numbers without a blank between them would be two: "1-2".
    return values if len(values) == words else None


def real(word: str) -> float | None:
    """Number that a single word is, also as C libraries write what is none; ``None`` if it is no number."""
    found = _REAL.fullmatch(word.lower())
    if found is None:
        return None
    if found["number"]:
        return float(word)
    value = math.inf if found["odd"].startswith("inf") or found["odd"].endswith("#inf") else math.nan
    return -value if word.startswith("-") else value


def table_of(piece: Piece, chosen: Flags, widths: tuple[int, ...] | None, example: str) -> tuple[Reals, Index]:
    """Numbers of some lines that hold nothing else.

    Parameters
    ----------
    chosen : (k,) bool
        By line; j are chosen.
    widths : tuple of int or None
        How many numbers a line may hold; any number if ``None``.
    example : str
        A right line, for messages.

    Returns
    -------
    value : (n,) float
        All numbers.
    start : (j + 1,) int
        First of each line.

    Raises
    ------
    UnreadableError
        If a word is no number, or a line has another number of them.
    """
    text = uncommented(lines_of(piece, chosen))
    starts = word_starts(text)
    count = counts_by_line(text, starts)
    rows = np.flatnonzero(chosen)
    odd = np.zeros(len(count), dtype=bool) if widths is None else ~np.isin(count, widths)
    if odd.any():
        raise piece.wrong(int(rows[np.argmax(odd)]), example)
    start = np.concatenate([np.zeros(1, dtype=np.intp), np.cumsum(count)])
    value = reals(text, int(start[-1]))
    if value is None:
        value = _one_by_one(piece, text, start, rows, example)
    return value, start


def _one_by_one(piece: Piece, text: Bytes, start: Index, rows: Index, example: str) -> Reals:
    values = [real(decoded(word)) for word in text.tobytes().split()]
    for place, value in enumerate(values):
        if value is None:
            raise piece.wrong(int(rows[np.searchsorted(start, place, side="right") - 1]), example)
    return np.array(values, dtype=np.float64)
