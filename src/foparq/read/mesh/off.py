# SPDX-License-Identifier: MIT
"""OFF in text, with colours, normals and texture coordinates: OFF, COFF, NOFF, STOFF and their compounds.

A vertex or a face is a line. Colours and normals are not read.
"""

import re

import numpy as np

from foparq.columns import Coordinates, Flags, Index
from foparq.errors import UnreadableError
from foparq.model.mesh import MeshReading, RawMesh, Texture
from foparq.read.mesh.made import Delivered, joined, made, stacked, starts_of
from foparq.read.mesh.numbers import table_of
from foparq.read.mesh.text import Piece, decoded, pieces

_COMMENT = rb"(?:[ \t\r\n]+|#[^\r\n]*(?=[\r\n]))"
_HEADER = re.compile(
    rb"^(?:\xef\xbb\xbf)?%b*+((?:ST)?C?N?4?n?OFF)(?=[ \t\r\n#])([ \t]+BINARY)?%b*+" % (_COMMENT, _COMMENT)
)
_COUNTS = re.compile(rb"([0-9]{1,18})[ \t]+([0-9]{1,18})(?:[ \t]+-?[0-9]{1,18})?[ \t]*(?=#|\r|\n|$)")
_COLOURS = (0, 1, 3, 4)  #: numbers by which a face may tell its colour
_GREATEST = 2.0**62


def read_off(delivered: Delivered) -> RawMesh:
    """Mesh of an OFF file.

    Raises
    ------
    UnreadableError
        If it is binary, of other than three dimensions, cut off, longer than it says, or a line does not fit.
    UnsafeError
        If it holds more vertices or faces than the limits allow.

    Notes
    -----
    O(n).
    """
    header = _HEADER.match(delivered.data)
    keyword = decoded(header[1]) if header else ""
    if header is None or header[2] or "4" in keyword or "n" in keyword:
        raise UnreadableError("mesh.off-kind", file=delivered.name, value=keyword or "?", example="OFF")
    counts = _COUNTS.match(delivered.data, header.end())
    if counts is None:
        line = 1 + delivered.data[: header.end()].count(b"\n")
        value = decoded(delivered.data[header.end() : header.end() + 40].split(b"\n")[0])
        raise UnreadableError("mesh.line", file=delivered.name, line=line, value=value.strip(), example="8 6 0")
    vertices, faces = int(counts[1]), int(counts[2])
    delivered.hold_bytes("OFF", vertices + faces, 6 * vertices + 2 * faces - 1, counts.end())
    delivered.hold_vertices(vertices)
    delivered.hold_faces(faces)
    work = _Work(keyword, vertices, faces)
    for piece in pieces(delivered.data, counts.end(), file=delivered.name):
        work.take(piece)
    work.finish(delivered.name)
    points = stacked(work.points)
    corners = joined(work.corners)
    return made(
        delivered, points, corners, starts_of(joined(work.counts)), MeshReading(version=keyword),
        texture=_texture(work, corners, vertices, faces),
    )  # fmt: skip


class _Work:
    """The rows that were read so far."""

    def __init__(self, keyword: str, vertices: int, faces: int) -> None:
        self.textured = keyword.startswith("ST")
        plain = 3 + 3 * ("N" in keyword) + 2 * self.textured
        # A colour has three numbers or four.
        self._widths = (plain + 3, plain + 4) if "C" in keyword else (plain,)
        self._vertices, self._faces = vertices, faces
        self._announced = {"vertex": vertices, "face": faces}
        self.points, self.uv = list[Coordinates](), list[Coordinates]()
        self.corners, self.counts = list[Index](), list[Index]()

    def take(self, piece: Piece) -> None:
        """Read the lines of a piece."""
        row = np.arange(len(piece.start))
        comment = piece.text[piece.start] == ord("#")
        row = row[~comment]
        ofvertex, rest = row[: self._vertices], row[self._vertices :]
        offace, rest = rest[: self._faces], rest[self._faces :]
        if len(rest):
            line = piece.line_of(int(piece.start[rest[0]]))
            raise UnreadableError("mesh.too-long", file=piece.file, line=line)
        if len(ofvertex):
            self._vertices -= len(ofvertex)
            self._take_vertices(piece, _marked(len(piece.start), ofvertex))
        if len(offace):
            self._faces -= len(offace)
            self._take_faces(piece, _marked(len(piece.start), offace), offace)

    def finish(self, file: str) -> None:
        """Refuse a file that ends before its last row."""
        for kind, left in (("vertex", self._vertices), ("face", self._faces)):
            if left:
                count = self._announced[kind]
                raise UnreadableError("mesh.rows-missing", file=file, key=kind, value=count, other=count - left)

    def _take_vertices(self, piece: Piece, chosen: Flags) -> None:
        example = "1.5 0 2" + " 0" * (self._widths[0] - 3)
        value, start = table_of(piece, chosen, self._widths, example)
        self.points.append(value[start[:-1, None] + np.arange(3)])
        if self.textured:
            self.uv.append(value[start[1:, None] - [2, 1]])

    def _take_faces(self, piece: Piece, chosen: Flags, row: Index) -> None:
        value, start = table_of(piece, chosen, None, "3 0 1 2")
        width = np.diff(start)
        whole = (np.abs(value) < _GREATEST) & (np.trunc(value) == value)
        given = np.where(whole[start[:-1]], value[start[:-1]], -1.0).astype(np.intp)
        count = np.where((given >= 0) & (given < width), given, 0)
        owner = np.repeat(np.arange(len(count)), count)
        at = np.arange(len(owner)) + (start[:-1] + 1 - (np.cumsum(count) - count))[owner]
        wrong = (count != given) | ~np.isin(width - 1 - count, _COLOURS)
        wrong[owner[~whole[at]]] = True
        if wrong.any():
            raise piece.wrong(int(row[np.argmax(wrong)]), "3 0 1 2")
        self.corners.append(value[at].astype(np.intp))
        self.counts.append(count)


def _marked(size: int, rows: Index) -> Flags:
    flags = np.zeros(size, dtype=bool)
    flags[rows] = True
    return flags


def _texture(work: _Work, corners: Index, vertices: int, faces: int) -> Texture | None:
    if not work.uv:
        return None
    return Texture(
        uv=stacked(work.uv, 2),
        corner=np.where((corners >= 0) & (corners < vertices), corners, -1),
        material=np.full(faces, -1, dtype=np.intp),
        materials=(),
    )
