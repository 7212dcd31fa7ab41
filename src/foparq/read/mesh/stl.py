# SPDX-License-Identifier: MIT
"""STL: triangles without common vertices, binary or in text.

Every corner is a vertex of its own, as delivered. Stated normals and attributes are not read: a normal follows from the
corners. In text, each ``solid`` is a group.
"""

import numpy as np

from foparq.columns import Coordinates, Flags, Index
from foparq.errors import UnreadableError
from foparq.model.drawing import Repair
from foparq.model.mesh import MeshReading, RawMesh
from foparq.read.mesh.made import Delivered, every, joined, made, stacked
from foparq.read.mesh.numbers import table_of
from foparq.read.mesh.text import Piece, blank_out, keywords, pieces

_HEADER = 84  #: bytes: a free text, and the number of facets
_FACET = np.dtype([("normal", "<f4", (3,)), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEAD = 4096  #: bytes in which a binary file holds a zero

#: what begins a line, by letters that tell it apart, and what may follow each
_SOLID, _FACET_LINE, _OUTER, _VERTEX, _END_LOOP, _END_FACET, _END_SOLID = range(1, 8)
_WORDS = {
    "solid": _SOLID, "facet": _FACET_LINE, "outer": _OUTER, "vertex": _VERTEX, "endloop": _END_LOOP,
    "endfacet": _END_FACET, "endsolid": _END_SOLID,
}  # fmt: skip
_NEXT = {
    0: (_SOLID,), _SOLID: (_FACET_LINE, _END_SOLID), _FACET_LINE: (_OUTER,), _OUTER: (_VERTEX, _END_LOOP),
    _VERTEX: (_VERTEX, _END_LOOP), _END_LOOP: (_END_FACET,), _END_FACET: (_FACET_LINE, _END_SOLID),
    _END_SOLID: (_SOLID,),
}  # fmt: skip
_EXAMPLES = (
    "", "solid name", "facet normal 0 0 1", "outer loop", "vertex 1.5 0 2", "endloop", "endfacet", "endsolid name",
)  # fmt: skip
_ALLOWED = np.zeros((8, 8), dtype=bool)
for _before, _after in _NEXT.items():
    _ALLOWED[_before, list(_after)] = True


def read_stl(delivered: Delivered) -> RawMesh:
    """Mesh of an STL file.

    Raises
    ------
    UnreadableError
        If it holds another number of facets than it says, or is cut off, or a line is none of an STL.
    UnsafeError
        If it holds more faces than the limits allow.

    Notes
    -----
    O(n). A file that begins with ``solid`` is binary if its size fits its number of facets, or if there is a zero among
    its first bytes.
    """
    data = delivered.data
    facets = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
    fits = len(data) == _HEADER + _FACET.itemsize * facets
    words = data[:_HEAD].removeprefix(b"\xef\xbb\xbf").lstrip()
    if len(data) >= _HEADER and (fits or b"\0" in data[:_HEAD] or words[:5].lower() != b"solid"):
        return _binary(delivered, facets)
    return _text(delivered)


def _binary(delivered: Delivered, facets: int) -> RawMesh:
    size = len(delivered.data) - _HEADER
    there, rest = divmod(size, _FACET.itemsize)
    # What is no whole facet behind the last one can be no facet. Anything else: which number is right, nobody knows.
    if there != facets:
        raise UnreadableError("mesh.stl-count", file=delivered.name, value=facets, other=there)
    delivered.hold_faces(facets)
    rows = np.frombuffer(delivered.data, dtype=_FACET, count=facets, offset=_HEADER)
    points = rows["corners"].reshape(-1, 3).astype(np.float64)
    repairs = (Repair(code="mesh-trailing-bytes", text=str(rest)),) if rest else ()
    return made(
        delivered, points, np.arange(3 * facets, dtype=np.intp), every(3, facets),
        MeshReading(version="STL binary", repairs=repairs),
    )  # fmt: skip


def _text(delivered: Delivered) -> RawMesh:
    points, loops, group, groups = list[Coordinates](), list[Index](), list[Index](), list[str]()
    before, corners, faces = 0, 0, 0
    begin = 3 if delivered.data.startswith(b"\xef\xbb\xbf") else 0
    for piece in pieces(delivered.data, begin, file=delivered.name):
        kinds = keywords(piece, _WORDS)
        _hold_order(piece, kinds, before)
        of_vertex = kinds == _VERTEX
        places = _places(piece, of_vertex)
        points.append(places)
        # A loop ends behind its last vertex.
        ends = corners + np.cumsum(of_vertex)[kinds == _END_LOOP]
        loops.append(ends)
        opened = np.flatnonzero(kinds == _SOLID)
        at = len(groups) + np.searchsorted(opened, np.flatnonzero(kinds == _END_LOOP)) - 1
        group.append(at.astype(np.intp))
        groups += [piece.name_of(row) for row in opened.tolist()]
        corners, faces = corners + len(places), faces + len(ends)
        delivered.hold_faces(faces)
        before = int(kinds[-1]) if len(kinds) else before
    if before != _END_SOLID:
        raise UnreadableError("mesh.stl-end", file=delivered.name, example="endsolid")
    starts = joined([np.zeros(1, dtype=np.intp), *loops])
    place = stacked(points)
    return made(
        delivered, place, np.arange(corners, dtype=np.intp), starts, MeshReading(version="STL ascii"),
        group=joined(group), groups=tuple(groups),
    )  # fmt: skip


def _hold_order(piece: Piece, kinds: Index, before: int) -> None:
    """Refuse a line that may not follow the one before it."""
    if not len(kinds):
        return
    wrong = ~_ALLOWED[np.concatenate([[before], kinds[:-1]]), kinds]
    if wrong.any():
        row = int(np.argmax(wrong))
        expected = _NEXT[int(kinds[row - 1]) if row else before][0]
        raise piece.wrong(row, _EXAMPLES[expected])


def _places(piece: Piece, of_vertex: Flags) -> Coordinates:
    blank_out(piece, of_vertex, len("vertex"))
    value, _ = table_of(piece, of_vertex, (3,), _EXAMPLES[_VERTEX])
    return value.reshape(-1, 3)
