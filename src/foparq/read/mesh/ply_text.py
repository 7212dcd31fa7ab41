# SPDX-License-Identifier: MIT
"""The rows of a PLY file in text: a line each, as the format says."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index, Reals
from foparq.errors import UnreadableError
from foparq.read.mesh.made import Delivered
from foparq.read.mesh.numbers import table_of
from foparq.read.mesh.ply_header import Element, Header, Property
from foparq.read.mesh.ply_rows import Column, Table
from foparq.read.mesh.text import Piece, pieces

_GREATEST = 2.0**62  #: of whole numbers that are read


def text_rows(delivered: Delivered, header: Header) -> dict[str, Table]:
    """Columns of all elements, by the name of the element.

    Raises
    ------
    UnreadableError
        If a row is missing or too many, holds more or less than the header says, or a word that is no number.
    """
    elements = [one for one in header.elements if one.rows and one.properties]
    parts: dict[str, list[Table]] = {one.name: [] for one in header.elements}
    waiting = [(one, one.rows) for one in reversed(elements)]
    for piece in pieces(delivered.data, header.end, file=delivered.name):
        value, start = table_of(piece, np.ones(len(piece.start), dtype=bool), None, "")
        line = 0
        while line < len(start) - 1:
            if not waiting:
                raise UnreadableError("mesh.too-long", file=delivered.name, line=piece.line_of(int(piece.start[line])))
            element, left = waiting.pop()
            take = min(left, len(start) - 1 - line)
            parts[element.name].append(_columns(piece, element, value, start, line, take))
            line += take
            if take < left:
                waiting.append((element, left - take))
    if waiting:
        element, left = waiting[-1]
        raise UnreadableError(
            "mesh.rows-missing", file=delivered.name, key=element.name, value=element.rows, other=element.rows - left
        )
    return {one.name: _joined(one, parts[one.name]) for one in header.elements}


def _columns(piece: Piece, element: Element, value: Reals, start: Index, line: int, rows: int) -> Table:
    at, end = start[line : line + rows].copy(), start[line + 1 : line + rows + 1]
    table = {}

    def hold(right: Flags) -> None:
        if not right.all():
            raise piece.wrong(line + int(np.argmin(right)), " ".join(_example(element)))

    for one in element.properties:
        hold(at < end)
        if one.count is None:
            column = value[at]
            hold(_fits(column, one.type))
            table[one.name] = Column(_typed(column, one.type))
            at += 1
            continue
        hold(_fits(value[at], one.count) & (value[at] >= 0))
        count = value[at].astype(np.intp)
        hold(count < end - at)
        owner = np.repeat(np.arange(rows), count)
        entries = value[np.arange(len(owner)) + (at + 1 - (np.cumsum(count) - count))[owner]]
        if not (fits := _fits(entries, one.type)).all():
            hold(np.bincount(owner[~fits], minlength=rows) == 0)
        table[one.name] = Column(_typed(entries, one.type), count)
        at += 1 + count
    hold(at == end)
    return table


def _fits(value: Reals, kind: np.dtype) -> Flags:
    """Whether a number can be of a type: whole, where the type is."""
    if kind.kind == "f":
        return np.ones(len(value), dtype=bool)
    whole: Flags = (np.abs(value) < _GREATEST) & (np.trunc(value) == value)
    return whole


def _typed(value: Reals, kind: np.dtype) -> NDArray[Any]:
    # Numbers with a fraction stay as they are written: the type says how a binary file would hold them.
    return value if kind.kind == "f" else value.astype(np.int64)


def _example(element: Element) -> Iterator[str]:
    for one in element.properties[:9]:
        yield one.name if one.count is None else f"n {one.name}..."


def _joined(element: Element, parts: list[Table]) -> Table:
    return {one.name: _column(one, [part[one.name] for part in parts]) for one in element.properties}


def _column(one: Property, parts: list[Column]) -> Column:
    value = np.concatenate([np.empty(0, _typed(np.empty(0), one.type).dtype), *(part.value for part in parts)])
    if one.count is None:
        return Column(value)
    counts = [part.count for part in parts if part.count is not None]
    return Column(value, np.concatenate([np.empty(0, dtype=np.intp), *counts]))
