# SPDX-License-Identifier: MIT
"""Text with a point in each line: XYZ, TXT, CSV, ASC."""

from pathlib import Path

import numpy as np

from foparq.columns import Coordinates, Flags, Index
from foparq.errors import UnreadableError
from foparq.profile.schema import LimitsSpec
from foparq.read.cloud.held import hold_points
from foparq.read.cloud.layout import EXAMPLE, Layout, layout_of
from foparq.read.mesh.numbers import real, reals
from foparq.read.mesh.text import BLANK, Bytes, Piece, decoded, lines_of, pieces, word_starts

_NEWLINE = 10
_AXES = 3
_MARKS = (b"\xff\xfe", b"\xfe\xff")  #: of UTF-16


def read_text_cloud(path: Path, limits: LimitsSpec) -> Coordinates:
    """Points (n, 3) of a text, as written.

    Raises
    ------
    UnreadableError
        If a line lacks one of three numbers, or a word in their place is no number; the error names the line.
    UnsafeError
        If it holds more points than the limits allow.

    Notes
    -----
    O(n), in pieces of some megabytes. Lines that begin with ``#`` or ``//`` are remarks.
    """
    data = path.read_bytes()
    if data.startswith(_MARKS):
        raise UnreadableError("mesh.control", file=path.name, byte=0, value=f"0x{data[0]:02x}")
    layout = layout_of(data, path.name)
    lines = max(data.count(b"\n"), data.count(b"\r")) + 1
    points = np.empty((min(lines, limits.points), _AXES))
    at = 0
    for piece in pieces(data, layout.begin, file=path.name):
        found = _points(piece, layout)
        hold_points(path.name, at + len(found), limits)
        points[at : at + len(found)] = found
        at += len(found)
    return points[:at]


def _points(piece: Piece, layout: Layout) -> Coordinates:
    rows = np.flatnonzero(~_remarks(piece))
    chosen = np.zeros(len(piece.start), dtype=bool)
    chosen[rows] = True
    text = lines_of(piece, chosen).copy()
    if not len(rows):
        return np.empty((0, _AXES))
    text[(text == ord('"')) | (text == ord("'"))] = BLANK
    line, cell, kept = _wanted(text, layout)
    odd = np.bincount(line, minlength=len(rows)) != _AXES
    if not odd.any():
        odd = (cell.reshape(-1, _AXES) != np.sort(layout.columns)).any(axis=1)
    if odd.any():
        raise piece.wrong(int(rows[np.argmax(odd)]), EXAMPLE)
    text = np.where(kept, text, np.uint8(BLANK))
    if layout.comma:
        # A point beside commas would part thousands.
        if (text == ord(".")).any():
            at = int(np.argmax(text == ord(".")))
            raise piece.wrong(int(rows[_line_at(kept, text, at, line)]), EXAMPLE)
        text[text == ord(",")] = ord(".")
    text = np.append(text, np.uint8(BLANK))
    values = reals(text, _AXES * len(rows))
    if values is None:
        values = _one_by_one(piece, text, rows)
    # As they stand in the line, and then as x, y and z.
    return values.reshape(-1, _AXES)[:, np.argsort(np.argsort(layout.columns))]


def _remarks(piece: Piece) -> Flags:
    """(k,) lines that begin with a mark of remarks."""
    last = len(piece.text) - 1
    first, second = piece.text[piece.start], piece.text[np.minimum(piece.start + 1, last)]
    remarks: Flags = (first == ord("#")) | ((first == ord("/")) & (second == ord("/")))
    return remarks


def _wanted(text: Bytes, layout: Layout) -> tuple[Index, Index, Flags]:
    """Line and cell of every word of x, y and z, and (b,) which bytes are of such words."""
    parted = text == ord(layout.separator) if layout.separator else None
    bare = text if parted is None else np.where(parted, np.uint8(BLANK), text)
    starts = word_starts(bare)
    begin = np.flatnonzero(starts)
    ends = np.flatnonzero(text == _NEWLINE)
    line = np.searchsorted(ends, begin)
    first = np.concatenate([[0], ends[:-1] + 1])
    if parted is None:
        before = np.searchsorted(begin, first)
        cell = np.arange(len(begin)) - before[line]
    else:
        passed = np.concatenate([[0], np.cumsum(parted)])
        cell = passed[begin] - passed[first[line]]
    wanted = np.isin(cell, layout.columns)
    word = np.cumsum(starts) - 1
    kept = (bare > BLANK) & (word >= 0)
    kept[kept] = wanted[word[kept]]
    return line[wanted], cell[wanted], kept


def _line_at(kept: Flags, text: Bytes, at: int, line: Index) -> int:
    """Line of the word in which a byte stands."""
    starts = word_starts(np.where(kept, text, np.uint8(BLANK)))
    return int(line[np.count_nonzero(starts[: at + 1]) - 1])


def _one_by_one(piece: Piece, text: Bytes, rows: Index) -> Coordinates:
    values = [real(decoded(word)) for word in text.tobytes().split()]
    for place, value in enumerate(values):
        if value is None:
            raise piece.wrong(int(rows[place // _AXES]), EXAMPLE)
    return np.array(values, dtype=np.float64)
