# SPDX-License-Identifier: MIT
"""OBJ: polygons, with texture coordinates and normals that are counted apart from the vertices.

``o`` and ``g`` name groups: the last of either before a face is its group. Rational weights, colours of vertices,
normals and smoothing groups are not read. Points, lines and free-form surfaces are not read, and told.
"""

from collections import Counter
from pathlib import Path

import numpy as np

from foparq.columns import Coordinates, Flags, Index
from foparq.errors import UnsafeError
from foparq.model.drawing import Repair, Skipped, SkippedReason
from foparq.model.mesh import MeshReading, RawMesh, Texture
from foparq.read.mesh.made import Delivered, joined, made, stacked, starts_of
from foparq.read.mesh.mtl import images_of
from foparq.read.mesh.numbers import table_of
from foparq.read.mesh.obj_faces import Corners, corners_of
from foparq.read.mesh.text import Piece, blank_out, keywords, pieces

_V, _VT, _VN, _F, _LINE, _QUIET, _CURVED, _O, _G, _MATERIAL, _LIBRARY, _FO = range(1, 13)
_WORDS = {
    "v": _V, "vt": _VT, "vn": _VN, "vp": _QUIET, "vc": _QUIET, "f": _F, "fo": _FO, "l": _LINE, "p": _LINE, "o": _O,
    "g": _G, "usemtl": _MATERIAL, "mtllib": _LIBRARY, "s": _QUIET, "mg": _QUIET, "usemap": _QUIET, "maplib": _QUIET,
    "bevel": _QUIET, "lod": _QUIET, "c_interp": _QUIET, "d_interp": _QUIET, "cstype": _QUIET, "deg": _QUIET,
    "step": _QUIET, "bmat": _QUIET, "parm": _QUIET, "trim": _QUIET, "hole": _QUIET, "scrv": _QUIET, "sp": _QUIET,
    "end": _QUIET, "con": _QUIET, "ctech": _QUIET, "stech": _QUIET, "curv": _CURVED, "curv2": _CURVED,
    "surf": _CURVED, "bzp": _CURVED, "bsp": _CURVED, "res": _QUIET, "cdc": _CURVED, "cdp": _CURVED, "call": _CURVED,
}  # fmt: skip
_STATEMENTS = (_O, _G, _MATERIAL, _LIBRARY)
_MOST_STATEMENTS = 5_000_000
_MOST_LIBRARIES = 100
_MOST_UNKNOWN = 1_000  #: lines that are none of an OBJ
_VERTEX_WIDTHS = (3, 4, 6, 7)  #: with a weight, a colour, or both
_VERTEX, _UV = "v 1.5 0 2", "vt 0.5 0.5"


def read_obj(delivered: Delivered) -> RawMesh:
    """Mesh of an OBJ file.

    Raises
    ------
    UnreadableError
        If a line of vertices or faces is none.
    UnsafeError
        If it holds more vertices or faces than the limits allow.

    Notes
    -----
    O(n). Vertices are the lines ``v``, never multiplied where texture coordinates differ.
    """
    begin = 3 if delivered.data.startswith(b"\xef\xbb\xbf") else 0
    work = _Work(delivered)
    for piece in pieces(delivered.data, begin, file=delivered.name, joined=True):
        work.take(piece)
    corners = joined(work.corners)
    starts = starts_of(joined(work.counts))
    texture, repairs, missing, images = work.texture()
    reading = MeshReading(version="OBJ", first=1, repairs=repairs, skipped=(*work.skipped(), *missing), images=images)
    return made(
        delivered, stacked(work.points), corners, starts, reading,
        group=joined(work.group), groups=tuple(work.groups) or ("",), texture=texture,
    )  # fmt: skip


class _Work:
    """What was read so far."""

    def __init__(self, delivered: Delivered) -> None:
        self._delivered = delivered
        self.points, self._uv = list[Coordinates](), list[Coordinates]()
        self.corners, self._texture, self.counts = list[Index](), list[Index | int](), list[Index]()
        self.group, self._material = list[Index](), list[Index]()
        self.groups, self._materials = dict[str, int](), dict[str, int]()
        self._libraries = dict[str, None]()
        self._vertices, self._uvs, self._faces, self._statements, self._unknown = 0, 0, 0, 0, 0
        self._now = {_G: -1, _MATERIAL: -1}  #: row of the group and of the material at the end of the last piece
        self._odd: Counter[tuple[SkippedReason, str]] = Counter()

    def take(self, piece: Piece) -> None:
        """Read the lines of a piece."""
        kinds = keywords(piece, _WORDS)
        kinds[piece.text[piece.start] == ord("#")] = _QUIET
        # An older word for the same.
        blank_out(piece, kinds == _FO, 2)
        kinds[kinds == _FO] = _F
        self._tell(piece, kinds)
        before = self._vertices, self._uvs
        if (of := kinds == _V).any():
            blank_out(piece, of, 1)
            value, start = table_of(piece, of, _VERTEX_WIDTHS, _VERTEX)
            self.points.append(value[start[:-1, None] + np.arange(3)])
            self._vertices += len(start) - 1
        if (of := kinds == _VT).any():
            self._take_uv(piece, of)
        if (of := kinds == _F).any():
            blank_out(piece, of, 1)
            self._take_faces(corners_of(piece, of), kinds, before)
        self._group_faces(piece, kinds)
        self._delivered.hold_vertices(self._vertices)
        self._delivered.hold_faces(self._faces)

    def _take_uv(self, piece: Piece, of: Flags) -> None:
        blank_out(piece, of, 2)
        value, start = table_of(piece, of, (1, 2, 3), _UV)
        second = np.where(np.diff(start) > 1, value[np.minimum(start[:-1] + 1, len(value) - 1)], 0.0)
        self._uv.append(np.column_stack([value[start[:-1]], second]))
        self._uvs += len(start) - 1

    def _take_faces(self, found: Corners, kinds: Index, before: tuple[int, int]) -> None:
        self.counts.append(found.count)
        self._faces += len(found.count)
        self.corners.append(_from_zero(found.vertex, found.count, kinds, _V, before[0]))
        if found.texture is None:
            self._texture.append(len(found.vertex))
        else:
            given = _from_zero(found.texture, found.count, kinds, _VT, before[1])
            # Told apart from corners that have none: what is outside is told.
            self._texture.append(np.where(found.texture == 0, -1, np.where(given < 0, np.iinfo(np.intp).max, given)))

    def _group_faces(self, piece: Piece, kinds: Index) -> None:
        faces = np.flatnonzero(kinds == _F)
        said: dict[int, tuple[list[int], list[int]]] = {_G: ([], []), _MATERIAL: ([], [])}
        rows = np.flatnonzero(np.isin(kinds, _STATEMENTS))
        self._statements += len(rows)
        if self._statements > _MOST_STATEMENTS:
            raise UnsafeError("mesh.too-many-groups", file=piece.file, limit=_MOST_STATEMENTS)
        for row in rows.tolist():
            name = piece.name_of(row)
            kind = int(kinds[row])
            if kind == _LIBRARY:
                self._libraries[name] = None
                continue
            names, kind = (self._materials, _MATERIAL) if kind == _MATERIAL else (self.groups, _G)
            said[kind][0].append(row)
            said[kind][1].append(names.setdefault(name, len(names)))
        self.group.append(self._in_force(faces, said[_G], _G))
        self._material.append(self._in_force(faces, said[_MATERIAL], _MATERIAL))

    def _in_force(self, faces: Index, said: tuple[list[int], list[int]], kind: int) -> Index:
        """Group or material of each face: the last that was said before it."""
        last = np.searchsorted(np.array(said[0], dtype=np.intp), faces)
        if kind == _G and self._now[kind] < 0 and len(faces) and (last == 0).any():
            self._now[kind] = self.groups.setdefault("", len(self.groups))
        rows = np.array([self._now[kind], *said[1]], dtype=np.intp)
        self._now[kind] = int(rows[-1])
        return rows[last]

    def _tell(self, piece: Piece, kinds: Index) -> None:
        """Count what is not read."""
        for row in np.flatnonzero(kinds == 0)[: _MOST_UNKNOWN + 1].tolist():
            word = piece.words_of(row, 80)[0]
            self._unknown += 1
            # A vertex that is not read would shift the numbers of all that follow.
            if word[0] in "vVfF" or self._unknown > _MOST_UNKNOWN:
                raise piece.wrong(row, _VERTEX)
            self._odd[SkippedReason.UNKNOWN_ELEMENT, word] += 1
        for kind, reason in ((_LINE, SkippedReason.LINES_AND_POINTS), (_CURVED, SkippedReason.UNKNOWN_ELEMENT)):
            rows = np.flatnonzero(kinds == kind)
            if len(rows):
                self._odd[reason, piece.words_of(int(rows[0]), 80)[0]] += len(rows)

    def skipped(self) -> tuple[Skipped, ...]:
        """What was not read."""
        return tuple(
            Skipped(reason=reason, kind=kind, layer="", count=count)
            for (reason, kind), count in sorted(self._odd.items())
        )

    def texture(self) -> tuple[Texture | None, tuple[Repair, ...], tuple[Skipped, ...], tuple[str, ...]]:
        """Texture, what was wrong with it, libraries that cannot be read, and images."""
        known, missing = _images(self._delivered.path.parent, list(self._libraries))
        materials = tuple((name, known.get(name, "")) for name in self._materials)
        images = tuple(dict.fromkeys(image for _, image in materials if image))
        if not materials and not self._uvs and all(isinstance(part, int) for part in self._texture):
            return None, (), missing, images
        row = joined([np.full(part, -1) if isinstance(part, int) else part for part in self._texture])
        outside = row >= self._uvs
        row[outside] = -1
        odd = int(np.count_nonzero(outside))
        repairs = (Repair(code="mesh-texture-corners", text=str(odd)),) if odd else ()
        uv = stacked(self._uv, 2)
        found = Texture(uv=uv, corner=row, material=joined(self._material), materials=materials)
        return found, repairs, missing, images


def _images(folder: Path, libraries: list[str]) -> tuple[dict[str, str], tuple[Skipped, ...]]:
    """Image of each material, and libraries that cannot be read."""
    known, missing = dict[str, str](), list[Skipped]()
    for named in libraries[:_MOST_LIBRARIES]:
        found = images_of(folder, named)
        # One name may hold blanks, and a line may name several.
        several = [images_of(folder, word) for word in named.split(" ")] if found is None and " " in named else []
        for library in (found, *several):
            known |= {name: image for name, image in (library or {}).items() if name not in known}
        if found is None and (not several or None in several):
            missing.append(Skipped(reason=SkippedReason.MATERIALS, kind="mtllib", layer="", count=1, name=named))
    if len(libraries) > _MOST_LIBRARIES:
        count = len(libraries) - _MOST_LIBRARIES
        missing.append(Skipped(reason=SkippedReason.MATERIALS, kind="mtllib", layer="", count=count))
    return known, tuple(missing)


def _from_zero(number: Index, count: Index, kinds: Index, of: int, before: int) -> Index:
    """Rows counted from 0, of numbers counted from 1 or backwards from the vertices so far; 0 becomes -1.

    Parameters
    ----------
    count : (f,) int
        Corners of each face of the piece.
    kinds : (k,) int
        Kind of each line of the piece.
    of : int
        Kind of line that is counted.
    before : int
        Such lines before the piece.
    """
    rows = np.maximum(number, np.iinfo(np.intp).min + 1) - 1
    backwards = number < 0
    if backwards.any():
        so_far = before + np.cumsum(kinds == of)[kinds == _F]
        rows[backwards] += 1 + np.repeat(so_far, count)[backwards]
    return rows
