# SPDX-License-Identifier: MIT
"""Corners of the faces of an OBJ: ``f 1 2 3``, ``f 1/1 2/2 3/3``, ``f 1//1 2//2 3//3``, ``f 1/1/1 2/2/2 3/3/3``."""

from dataclasses import dataclass

import numpy as np

from foparq.columns import Flags, Index
from foparq.read.mesh.numbers import wholes
from foparq.read.mesh.text import BLANK, Bytes, Piece, counts_by_line, lines_of, uncommented, word_starts

_SLASH = 47
_EXAMPLE = "f 1 2 3"
_SLOTS = 3  #: vertex, texture coordinates, normal


@dataclass(frozen=True, slots=True)
class Corners:
    """Corners of the faces of a piece, as written: counted from 1, or backwards from the last by negative numbers."""

    vertex: Index  #: (m,)
    texture: Index | None  #: (m,) 0 where the corner has none; ``None`` if none has
    count: Index  #: (f,) corners of each face


def corners_of(piece: Piece, chosen: Flags) -> Corners:
    """Corners of some lines of a piece, whose first letter is blank.

    Raises
    ------
    UnreadableError
        If a corner is none.
    """
    text = uncommented(lines_of(piece, chosen))
    words = word_starts(text)
    count = counts_by_line(text, words)
    total = int(count.sum())
    slash = text == _SLASH
    if not slash.any():
        value = wholes(text, total)
        if value is None:
            raise _wrong(piece, chosen)
        return Corners(value, None, count)
    begin = np.flatnonzero(_part_starts(text, slash))
    value = wholes(np.where(slash, np.uint8(BLANK), text), len(begin))
    if value is None:
        raise _wrong(piece, chosen)
    parts = len(begin) // max(total, 1)
    if _alike(words, begin, parts, total, int(np.count_nonzero(slash))):
        rows = value.reshape(-1, parts)
        return Corners(rows[:, 0].copy(), rows[:, 1].copy(), count)
    owner, slot = _places(words, slash, begin)
    if (slot >= _SLOTS).any():
        raise _wrong(piece, chosen)
    vertex = value[slot == 0]
    if len(vertex) != total:
        raise _wrong(piece, chosen)
    textured = slot == 1
    if not textured.any():
        return Corners(vertex, None, count)
    texture = np.zeros(total, dtype=np.intp)
    texture[owner[textured]] = value[textured]
    return Corners(vertex, texture, count)


def _part_starts(text: Bytes, slash: Flags) -> Flags:
    """(b,) true where a number begins."""
    inside = (text > BLANK) & ~slash
    starts = inside.copy()
    starts[1:] &= ~inside[:-1]
    return starts


def _alike(words: Flags, begin: Index, parts: int, total: int, slashes: int) -> bool:
    """Whether every corner has the same parts, two or three, and none is left out."""
    # Each has one slash less than numbers at least; if they have no more in all, none has more.
    if parts not in (2, _SLOTS) or len(begin) != parts * total or slashes != (parts - 1) * total:
        return False
    first = words[begin].reshape(-1, parts)
    return bool(first[:, 0].all() and not first[:, 1:].any())


def _places(words: Flags, slash: Flags, begin: Index) -> tuple[Index, Index]:
    """Corner that each number belongs to, and the slashes before it there."""
    owner: Index = np.cumsum(words, dtype=np.int32)[begin].astype(np.intp) - 1
    slashes = np.cumsum(slash, dtype=np.int32)
    first = np.flatnonzero(words)
    before = slashes[first] - slash[first]
    slot: Index = (slashes[begin] - before[owner]).astype(np.intp)
    return owner, slot


def _wrong(piece: Piece, chosen: Flags) -> Exception:
    """Error of the first line that holds what is no corner."""
    for row in np.flatnonzero(chosen).tolist():
        for word in piece.words_of(row)[1:]:
            if word.startswith("#"):
                break
            parts = word.split("/")
            if len(parts) > _SLOTS or not _whole(parts[0]) or not all(_whole(part) or not part for part in parts):
                return piece.wrong(row, _EXAMPLE)
    raise ValueError("a face that cannot be read is one that can")


def _whole(word: str) -> bool:
    digits = word[1:] if word[:1] in ("-", "+") else word
    return digits.isascii() and digits.isdigit()
