# SPDX-License-Identifier: MIT
"""A mesh as the rules see it."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely

from foparq.check.subject import NO_DOUBT, Doubt, Patterns, Places, Subject, Taken, subject
from foparq.columns import Flags, Geometries, Index, Reals, Texts, union
from foparq.findings.because import Because
from foparq.findings.hits import Hits
from foparq.findings.outcome import Outcome
from foparq.model.inputs import Named, Numbered
from foparq.model.layers import literal, matching
from foparq.model.mesh import Mesh
from foparq.model.part import Part
from foparq.model.surface import Faces, Surface, Vertices
from foparq.profile.schema import Profile

_KINDS = frozenset({Faces, Surface, Vertices})
_ENDS = 2  #: vertices of a line that has a middle
_ON_SHEET = (50.0, 100_000.0)  #: times what can be seen, that an object is across on its sheet
_MIDDLE = (0.1, 0.9)  #: what lies far outside takes no sense from the bulk


@subject(Mesh)
class MeshSubject(Subject):
    """A mesh: its faces, and behind them, in the numbering of rows, its vertices.

    Parameters
    ----------
    profile : Profile
        Says whether vertices with the same coordinates are taken for one.
    """

    named_by_place = True

    def __init__(self, part: Part, profile: Profile) -> None:
        assert isinstance(part, Mesh)  # noqa: S101 - the registry asks by type
        self.mesh = part
        self.weld = profile.mesh.weld == "identical"
        self._taken: dict[tuple[type, Patterns], Taken] = {}
        self._seconds: dict[Patterns, Surface] = {}

    @classmethod
    def prepare(cls) -> None:
        """Kernels are compiled the first time on a machine, which may take longer than a rule may."""
        from foparq.mesh.warm import warm  # noqa: PLC0415 - a drawing never loads the kernels of meshes

        warm()

    @property
    def part(self) -> Mesh:
        """The mesh."""
        return self.mesh

    @property
    def metres(self) -> float:
        """Metres in one unit of the file; 1 if it is unknown."""
        return self.mesh.unit.metres or 1.0

    @property
    def measured(self) -> bool:
        """Whether the unit of the file is known."""
        return self.mesh.unit.metres is not None

    @classmethod
    def knows(cls, kind: type) -> bool:
        """Faces and vertices."""
        return kind in _KINDS

    def take(self, kind: type, layers: Patterns) -> Taken:
        """Faces of some groups; vertices belong to all."""
        key = (kind, layers)
        if key not in self._taken:
            make = {Faces: self._faces, Surface: self._surface, Vertices: self._vertices}[kind]
            self._taken[key] = make(layers)
        return self._taken[key]

    def otherwise(self, kind: type, layers: Patterns) -> tuple[str, Named] | None:
        """The surface with its vertices as the profile does not take them; ``None`` if that is the same."""
        if kind is not Surface or self._same is None:
            return None
        surface = self.take(Surface, layers).rows
        assert isinstance(surface, Surface)  # noqa: S101 - by its kind
        name = "as-delivered" if self.weld else "welded"
        return name, self._second(layers, surface)

    def _second(self, layers: Patterns, surface: Surface) -> Surface:
        """Made once: rules share what kernels compute."""
        if layers not in self._seconds:
            self._seconds[layers] = replace(surface, corners=self._corners_of(surface.row, welded=not self.weld))
        return self._seconds[layers]

    def alone(self, kind: type, layers: Patterns) -> Sequence[Patterns]:  # noqa: ARG002 - vertices have no group
        """Groups of faces, each by itself."""
        used = np.unique(self.mesh.group)
        names = [self.mesh.groups[n] for n in used.tolist()]
        keep = matching(np.array(names, dtype=object), layers)
        return [(literal(name),) for name, kept in zip(names, keep, strict=True) if kept]

    def states(self, kind: type) -> bool:  # noqa: ARG002 - all is about faces and vertices
        """No input holds statements."""
        return False

    def examined(self, kind: type) -> bool:  # noqa: ARG002 - no input holds statements
        """A mesh without faces was not looked at."""
        return False

    def doubt(self, outcomes: Sequence[Outcome], visible: float) -> Doubt:  # noqa: ARG002 - the engine's call
        """Unit unknown, or stated against what the format or its size says until somebody answers for it."""
        unit = self.mesh.unit
        if unit.metres is None:
            return Doubt(Because.UNIT_UNKNOWN)
        if unit.header_metres not in {None, unit.metres} and "unit" not in self.mesh.confirmed:
            return Doubt(Because.UNIT_CONTRADICTED, (f"unit: {unit.name}", f"format: {unit.header}"))
        if visible > 0.0 and "unit" not in self.mesh.confirmed and (across := self._off_scale(visible)):
            return Doubt(Because.UNIT_CONTRADICTED, (f"unit: {unit.name}", f"extent: {across:.3g} m"))
        return NO_DOUBT

    def _off_scale(self, visible: float) -> float:
        """Metres across a mesh that would be less than 1 cm, or more than 20 m, on paper; 0 if it would not."""
        low, high = (metres * self.metres for metres in self._across)
        return low if 0.0 < low < _ON_SHEET[0] * visible else high if high > _ON_SHEET[1] * visible else 0.0

    @cached_property
    def _across(self) -> tuple[float, float]:
        """Longest side of the box of its vertices, and of that of their middle four fifths; units of the file."""
        mesh = self.mesh
        used = np.zeros(len(mesh.points), dtype=bool)
        used[mesh.corners[mesh.there]] = True
        points = mesh.points[used & mesh.finite]
        if not len(points):
            return 0.0, 0.0
        with np.errstate(over="ignore"):  # coordinates may be any number
            low, high = np.quantile(points, _MIDDLE, axis=0)
            return float(np.ptp(points, axis=0).max()), float((high - low).max())

    def counted(self, rows: Index, faulty: Index) -> int:
        """Faces or vertices judged."""
        return len(union(rows, faulty[faulty >= 0]))

    def named(self, rows: Index) -> tuple[Texts, Texts]:
        """Numbers of faces and vertices, and the groups of faces."""
        faces = self.mesh.features
        item = np.array([f"f{n}" if n < faces else f"v{n - faces}" for n in rows.tolist()], dtype=object)
        layer = np.full(len(rows), "", dtype=object)
        face = rows < faces
        layer[face] = self._groups[self.mesh.group[rows[face]]]
        return item, layer

    def places(self, found: Hits, rows: Named) -> Places:  # noqa: ARG002 - places are in the coordinates of the file
        """Places in the file; the same in metres; and one point on each."""
        coordinates = shapely.get_coordinates(found.where, include_z=True)
        sheet = shapely.set_coordinates(found.where.copy(), coordinates * self.metres)
        return Places(found.where, sheet, points_on(found.where))

    @cached_property
    def _groups(self) -> Texts:
        groups: Texts = np.empty(len(self.mesh.groups), dtype=object)
        groups[:] = self.mesh.groups
        return groups

    @cached_property
    def _same(self) -> Index | None:
        """(v,) first vertex with the same coordinates; ``None`` if each has its own."""
        from foparq.mesh.weld import welded  # noqa: PLC0415 - a drawing never loads the kernels of meshes

        same = welded(self.mesh.points)
        return None if np.array_equal(same, np.arange(len(same))) else same

    def _corners_of(self, faces: Index, *, welded: bool) -> Index:
        from foparq.mesh.polygons import chosen  # noqa: PLC0415 - as above

        mesh = self.mesh
        corners = mesh.corners if len(faces) == mesh.features else chosen(mesh.corners, mesh.starts, faces)[0]
        return self._same[corners] if welded and self._same is not None else corners

    def _surface(self, layers: Patterns) -> Taken:
        mesh = self.mesh
        chosen = self._of_groups(layers)
        rows, unfit = np.flatnonzero(chosen & mesh.usable), np.flatnonzero(chosen & ~mesh.usable)
        counts = np.diff(mesh.starts)[rows]
        surface = Surface(
            points=mesh.points, corners=self._corners_of(rows, welded=self.weld),
            starts=np.concatenate([[0], np.cumsum(counts)]), closed=mesh.closed, rims=mesh.rims, metres=self.metres,
            **self._named_faces(rows),
        )  # fmt: skip
        return Taken(surface, unfit)

    def _faces(self, layers: Patterns) -> Taken:
        mesh = self.mesh
        rows = np.flatnonzero(self._of_groups(layers))
        counts = np.diff(mesh.starts)
        none = np.empty(0, dtype=np.intp)
        if mesh.usable.all():
            zero = np.zeros(len(rows), dtype=np.intp)
            faces = Faces(
                short=zero.astype(bool), absent=zero, endless=zero,
                place=np.broadcast_to(np.nan, (len(rows), 3)), **self._named_faces(rows),
            )  # fmt: skip
            return Taken(faces, none)
        face = np.repeat(np.arange(mesh.features), counts)
        endless = mesh.there.copy()
        endless[mesh.there] = ~mesh.finite[mesh.corners[mesh.there]]
        place = np.full((mesh.features, 3), np.nan)
        # Of the corners of a face that have a place the first by x, then y, then z; it is written last.
        wanted = ~mesh.usable[face] & mesh.there & ~endless
        good = np.flatnonzero(wanted)
        there = mesh.points[mesh.corners[good]]
        order = np.lexsort((there[:, 2], there[:, 1], there[:, 0]))[::-1]
        place[face[good[order]]] = there[order]
        faces = Faces(
            short=(counts < 3)[rows],  # noqa: PLR2004 - a face has three corners and more
            absent=np.bincount(face[~mesh.there], minlength=mesh.features)[rows],
            endless=np.bincount(face[endless], minlength=mesh.features)[rows],
            place=place[rows], **self._named_faces(rows),
        )  # fmt: skip
        return Taken(faces, none)

    def _vertices(self, layers: Patterns) -> Taken:  # noqa: ARG002 - vertices belong to all groups
        mesh = self.mesh
        n = len(mesh.points)
        used = np.zeros(n, dtype=bool)
        used[mesh.corners[mesh.there]] = True
        blank: Any = np.broadcast_to(np.array("", dtype=object), n)
        number = Numbered("v", np.arange(n))
        same = np.arange(n) if self._same is None else self._same
        vertices = Vertices(
            points=mesh.points, used=used, same=same, layer=blank, item=number, handle=number, inserts=blank,
            row=np.arange(n) + mesh.features,
        )  # fmt: skip
        return Taken(vertices, np.empty(0, dtype=np.intp))

    def _of_groups(self, layers: Patterns) -> Flags:
        if "*" in layers:
            return np.ones(self.mesh.features, dtype=bool)
        return matching(self._groups, layers)[self.mesh.group]

    def _named_faces(self, rows: Index) -> dict[str, Any]:
        number = Numbered("f", rows)
        return {
            "layer": self._groups[self.mesh.group[rows]], "item": number, "handle": number,
            "inserts": np.broadcast_to(np.array("", dtype=object), len(rows)), "row": rows,
        }  # fmt: skip


def points_on(where: Geometries) -> Reals:
    """One point on each geometry in space, whatever way it faces.

    Parameters
    ----------
    where : (k,) shapely geometries

    Returns
    -------
    (k, 3) float
        Of an area of one ring the mean of its vertices, which lies on a triangle; of a segment its middle; of anything
        else its first vertex by x, then y, then z, so that the order of vertices decides nothing. NaN if it is empty.
    """
    coordinates, of = shapely.get_coordinates(where, include_z=True, return_index=True)
    points = np.full((len(where), 3), np.nan)
    order = np.lexsort((coordinates[:, 2], coordinates[:, 1], coordinates[:, 0], of))[::-1]
    points[of[order]] = coordinates[order]  # the first of each is written last
    count = np.bincount(of, minlength=len(where))
    area = shapely.get_type_id(where) == shapely.GeometryType.POLYGON
    inner = area | ((shapely.get_type_id(where) == shapely.GeometryType.LINESTRING) & (count == _ENDS))
    last = np.append(of[1:] != of[:-1], True)
    take = inner[of] & ~(area[of] & last)
    # The mean about a vertex: large coordinates lose nothing.
    total = np.zeros((len(where), 3))
    np.add.at(total, of[take], coordinates[take] - points[of[take]])
    used = np.bincount(of[take], minlength=len(where))
    middle = used > 0
    points[middle] += total[middle] / used[middle, np.newaxis]
    return points
