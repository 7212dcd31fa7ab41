# SPDX-License-Identifier: MIT
"""The rows of a PLY file as columns, binary or in text."""

from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from struct import Struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Index
from foparq.errors import UnreadableError
from foparq.read.mesh.made import Delivered
from foparq.read.mesh.ply_header import Element, Property


@dataclass(frozen=True, slots=True)
class Column:
    """One column of n rows."""

    value: NDArray[Any]  #: (n,), or the entries of all lists, one behind the other
    count: Index | None = None  #: (n,) entries of each list; ``None`` where the column holds one value a row


Table = dict[str, Column]
Step = tuple[int, Struct, int, Property]


def binary_rows(delivered: Delivered, element: Element, at: int) -> tuple[Table, int]:
    """Columns of an element of a binary file, and the byte behind it.

    Raises
    ------
    UnreadableError
        If the file ends before.

    Notes
    -----
    O(n). Where every row has lists of the same length, as in a mesh of triangles, they are one array. Else the place of
    a row is known only from the row before it: they are visited one after the other, some tenths of a microsecond each.
    """
    delivered.hold_bytes(element.name, element.rows, element.rows * element.least, at)
    if not element.rows:
        return {one.name: Column(np.empty(0, one.type), None if one.count is None else _none()) for one in
                element.properties}, at  # fmt: skip
    counts = _counts(delivered, element, at)
    kind = _kind(element, counts)
    if element.rows * kind.itemsize <= len(delivered.data) - at:
        rows = np.frombuffer(delivered.data, dtype=kind, count=element.rows, offset=at)
        if all((rows[f"#{place}"] == count).all() for place, count in enumerate(counts) if count >= 0):
            return _alike(element, rows, counts), at + element.rows * kind.itemsize
    return _walked(delivered, element, at)


def _none() -> Index:
    return np.empty(0, dtype=np.intp)


def _counts(delivered: Delivered, element: Element, at: int) -> list[int]:
    """Entries of each list in the first row; -1 where a column holds no list."""
    counts = []
    for one in element.properties:
        if one.count is None:
            counts.append(-1)
            at += one.type.itemsize
            continue
        delivered.hold_bytes(element.name, element.rows, one.count.itemsize, at)
        count = int(np.frombuffer(delivered.data, one.count, 1, at)[0])
        _hold_list(delivered, count, one, at)
        counts.append(count)
        at += one.count.itemsize + count * one.type.itemsize
    return counts


def _hold_list(delivered: Delivered, count: int, one: Property, at: int) -> None:
    left = len(delivered.data) - at - (one.count or one.type).itemsize
    if count < 0 or count * one.type.itemsize > left:
        raise UnreadableError(
            "mesh.list-count", file=delivered.name, byte=at, key=one.name, value=count, left=max(left, 0)
        )


def _kind(element: Element, counts: list[int]) -> np.dtype:
    fields: list[tuple[str, np.dtype] | tuple[str, np.dtype, tuple[int]]] = []
    for place, (one, count) in enumerate(zip(element.properties, counts, strict=True)):
        if one.count is None:
            fields.append((f"{place}", one.type))
        else:
            fields += [(f"#{place}", one.count), (f"{place}", one.type, (count,))]
    return np.dtype(fields)


def _alike(element: Element, rows: NDArray[Any], counts: list[int]) -> Table:
    table = {}
    for place, (one, count) in enumerate(zip(element.properties, counts, strict=True)):
        value = rows[f"{place}"]
        many = None if count < 0 else np.full(len(rows), count, dtype=np.intp)
        table[one.name] = Column(value.reshape(-1), many)
    return table


def _walked(delivered: Delivered, element: Element, at: int) -> tuple[Table, int]:
    data, size = delivered.data, len(delivered.data)
    steps = _steps(element)
    if len(steps) == 1 and steps[0][1].format.endswith("B"):
        return _walked_bytes(delivered, element, steps[0], at)
    first = [_places(element) for _ in steps]
    count = [_places(element) for _ in steps]
    tail = _tail(element)
    for row in range(element.rows):
        for place, (lead, unpack, width, one) in enumerate(steps):
            at += lead
            if at + unpack.size > size:
                delivered.hold_bytes(element.name, element.rows, unpack.size, at)
            (entries,) = unpack.unpack_from(data, at)
            if entries < 0 or at + entries * width > size:
                _hold_list(delivered, entries, one, at)
            at += unpack.size
            first[place][row], count[place][row] = at, entries
            at += entries * width
        at += tail
        if at > size:
            delivered.hold_bytes(element.name, element.rows, at - size, size)
    return _gathered(data, element, _columns_of(first), _columns_of(count)), at


def _places(element: Element) -> "array[int]":
    return array("q", bytes(8 * element.rows))


def _columns_of(numbers: "Sequence[array[int]]") -> list[Index]:
    return [np.asarray(column, dtype=np.intp) for column in numbers]


def _walked_bytes(delivered: Delivered, element: Element, step: Step, at: int) -> tuple[Table, int]:
    """As above, of rows with one list whose length is a byte: some times faster."""
    data, (lead, _, width, _) = delivered.data, step
    at += lead
    bare = element.least
    first = _places(element)
    try:
        for row in range(element.rows):
            first[row] = at
            at += bare + width * data[at]
    except IndexError:
        delivered.hold_bytes(element.name, element.rows, 1, at)
    at -= lead
    delivered.hold_bytes(element.name, element.rows, max(at - len(data), 0), len(data))
    begin = np.asarray(first, dtype=np.intp)
    count = np.frombuffer(data, dtype=np.uint8)[begin].astype(np.intp)
    return _gathered(data, element, [begin + 1], [count]), at


def _steps(element: Element) -> list[Step]:
    """Of each list: bytes before it in its row, behind the list before; form of its count; bytes of an entry."""
    steps, lead = [], 0
    for one in element.properties:
        if one.count is None:
            lead += one.type.itemsize
        else:
            form = Struct({"<": "<", ">": ">"}.get(one.count.str[0], "=") + one.count.char)
            steps.append((lead, form, one.type.itemsize, one))
            lead = 0
    return steps


def _tail(element: Element) -> int:
    tail = 0
    for one in element.properties:
        tail = 0 if one.count is not None else tail + one.type.itemsize
    return tail


def _gathered(data: bytes, element: Element, first: Sequence[Index], count: Sequence[Index]) -> Table:
    text = np.frombuffer(data, dtype=np.uint8)
    table, place, behind = {}, -1, None
    for one in element.properties:
        width = one.type.itemsize
        if one.count is None:
            behind = _before(element, one, first) if behind is None else behind
            table[one.name] = Column(_at(text, behind, one.type))
            behind = behind + width
            continue
        place += 1
        begin, many = first[place], count[place]
        within = np.arange(int(many.sum())) - np.repeat(np.cumsum(many) - many, many)
        table[one.name] = Column(_at(text, np.repeat(begin, many) + within * width, one.type), many)
        behind = begin + many * width
    return table


def _before(element: Element, one: Property, first: Sequence[Index]) -> Index:
    """First byte of each row, which begins with a column that holds no list."""
    lead = 0
    for other in element.properties:
        if other.count is not None:
            return first[0] - other.count.itemsize - lead
        lead += other.type.itemsize
    raise ValueError(f"{element.name}.{one.name}: rows without lists are all alike")


def _at(text: NDArray[Any], begin: Index, kind: np.dtype) -> NDArray[Any]:
    """Values that begin at some bytes."""
    value = np.empty((len(begin), kind.itemsize), dtype=np.uint8)
    for byte in range(kind.itemsize):
        value[:, byte] = text[begin + byte]
    return value.view(kind)[:, 0]
