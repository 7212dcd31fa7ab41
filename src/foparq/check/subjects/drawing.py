# SPDX-License-Identifier: MIT
"""A drawing as the rules see it."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import shapely

from foparq.check.drawn.columns import Columns
from foparq.check.drawn.facts import EXAMINED, FACTS
from foparq.check.drawn.stance import better_plane
from foparq.check.drawn.unit_evidence import against, extent_off_sheet
from foparq.check.subject import NO_DOUBT, Doubt, Patterns, Places, Subject, Taken, subject
from foparq.columns import Geometries, Index, Texts, union
from foparq.findings.because import Because
from foparq.findings.hits import Hits
from foparq.findings.outcome import Outcome, Status
from foparq.geom.places import place_on
from foparq.geom.sizes import smaller_than
from foparq.model.drawing import Drawing, UnitOrigin
from foparq.model.inputs import Areas, Features, Lines, Named
from foparq.model.items import Role
from foparq.model.layers import literal, matches
from foparq.model.part import Part
from foparq.profile.schema import Profile

_UNIT_RULE = "unit-contradiction"
_LINEWORK = frozenset({Features, Lines, Areas})
_WITNESSES = 2  #: independent ones that contradict a person
_ALONE = {"drawing", "tables"}  #: heard only where one of two statements of a person must be wrong
_ALL: Patterns = ("*",)


@subject(Drawing)
class DrawingSubject(Subject):
    """A drawing: linework in its plane, and what its file says.

    Parameters
    ----------
    profile : Profile
        Says whether hidden layers are looked at.
    """

    #: statements about the unit decide whether tolerances in metres mean anything
    leading = (_UNIT_RULE,)

    def __init__(self, part: Part, profile: Profile) -> None:
        assert isinstance(part, Drawing)  # noqa: S101 - the registry asks by type
        self.drawing = part
        self.columns = Columns(part, hidden=profile.reading.hidden == "check")
        self._taken: dict[tuple[type, Patterns], Taken] = {}
        self._small: dict[float, Index] = {}
        self._across: dict[float, float] = {}
        self._undeclared: tuple[str, ...] | None = None

    @property
    def part(self) -> Drawing:
        """The drawing."""
        return self.drawing

    @property
    def metres(self) -> float:
        """Metres in one drawing unit; 1 if it is unknown."""
        return self.columns.metres

    @classmethod
    def knows(cls, kind: type) -> bool:
        """Linework and statements of the file."""
        return kind in _LINEWORK or kind in FACTS

    def take(self, kind: type, layers: Patterns) -> Taken:
        """Input of one kind on some layers; statements are about the file, whatever the layers."""
        key = (kind, _ALL if kind in FACTS else layers)
        if key not in self._taken:
            self._taken[key] = self._take(kind, layers)
        return self._taken[key]

    def alone(self, kind: type, layers: Patterns) -> Sequence[Patterns]:
        """Layers with items of a kind, sound or not, each by itself."""
        return [(literal(name),) for name in self._holding(kind) if matches(name, layers)]

    def states(self, kind: type) -> bool:
        """All but linework."""
        return kind in FACTS

    def examined(self, kind: type) -> bool:
        """Statements that nobody made mean that there was nothing to say."""
        return kind in EXAMINED

    def doubt(self, outcomes: Sequence[Outcome], visible: float) -> Doubt:
        """Unit unknown or contradicted, a plane that is not the drawing's, or symbols that nobody told apart.

        The file's own unit is doubtful as soon as one statement contradicts it. A unit that a person states is so if
        two independent witnesses say otherwise, or what the person states of another drawing with the same coordinates
        or of a table, until it is confirmed. So it is if the drawing would fit on no sheet.
        """
        unit = self.drawing.unit
        if unit.metres is None:
            crs = (self.drawing.reading.crs,)
            if unit.name == "degree":
                return Doubt(Because.UNIT_ANGLE, crs)
            return Doubt(Because.CRS_UNFIT, crs) if unit.header == "degree" else Doubt(Because.UNIT_UNKNOWN)
        doubted = [outcome for outcome in outcomes if outcome.name == _UNIT_RULE and outcome.status is Status.FAULTY]
        if doubted and unit.origin is not UnitOrigin.STATED:
            return Doubt(Because.UNIT_DOUBTFUL)
        if doubted and "unit" not in self.drawing.confirmed:
            witnesses = against(self.drawing, max(dict(_agree(one)).get("agree", 0.0) for one in doubted))
            if len(witnesses) >= _WITNESSES or _ALONE & witnesses.keys():
                return Doubt(Because.UNIT_CONTRADICTED, (f"unit: {unit.name}", *witnesses.values()))
        claimed = unit.origin is UnitOrigin.STATED and "unit" not in self.drawing.confirmed
        if claimed and (across := self._off_sheet(visible)):
            return Doubt(Because.UNIT_CONTRADICTED, (f"unit: {unit.name}", f"extent: {across:.3g} m"))
        return self._plane_doubt if not self.drawing.symbols.broken else Doubt(Because(self.drawing.symbols.broken))

    def _off_sheet(self, visible: float) -> float:
        if visible not in self._across:
            self._across[visible] = extent_off_sheet(self.drawing, visible)
        return self._across[visible]

    @cached_property
    def _plane_doubt(self) -> Doubt:
        if "plane" in self.drawing.confirmed:
            return NO_DOUBT
        if self.columns.seen_edge_on():
            return Doubt(Because.PLANE_DOUBTFUL)
        if better := better_plane(self.columns):
            stated = self.drawing.plane.name != "assumed"
            return Doubt(Because.PLANE_CONTRADICTED if stated else Because.PLANE_DOUBTFUL, (better,) if stated else ())
        return NO_DOUBT

    def counted(self, rows: Index, faulty: Index) -> int:
        """Features judged. A point has no topology, nor has a symbol: they count only where they are at fault."""
        rows = rows[rows >= 0]
        if not len(rows):
            return 1  # a statement about the file: the file was checked
        drawn = rows[(self.drawing.items.role[rows] != Role.POINT) & ~np.isin(rows, self.drawing.symbols.rows)]
        return len(union(drawn, faulty[faulty >= 0]))

    def too_small(self, rows: Index, visible: float) -> Index:
        """Lines and areas that fit into a smaller circle; points have no size, and symbols are counted nowhere."""
        if visible not in self._small:
            drawn = np.flatnonzero((self.columns.role != Role.POINT) & ~self.columns.symbol)
            self._small[visible] = self.columns.rows[drawn[smaller_than(self.columns.geometry[drawn], visible)]]
        found: Index = np.intersect1d(rows, self._small[visible], assume_unique=True)
        return found

    def undeclared(self, kind: type, visible: float) -> tuple[str, ...]:
        """Layers whose closed lines look like a coverage; places nearer than a twentieth of what is visible are one."""
        if kind is not Areas:
            return ()
        if self._undeclared is None:
            lines = self.take(Lines, _ALL).rows
            found = lines.layer[lines.adjoining(visible / 20)] if isinstance(lines, Lines) else ()
            self._undeclared = tuple(literal(layer) for layer in sorted(set(found)))
        return self._undeclared

    def drawn_again(self, kind: type, layers: Patterns, rows: Index, within: float) -> Index:
        """Items of which a layer that does not bind with theirs draws every line as well; computed once."""
        lines = self.without(kind, layers, rows)
        if not isinstance(lines, Lines):
            return rows[:0]
        again = lines.drawn_again(within)
        found: Index = np.setdiff1d(lines.row[again], lines.row[~again])
        return found

    def named(self, rows: Index) -> tuple[Texts, Texts]:
        """Item ids and layers."""
        return self.drawing.items.item[rows], self.drawing.items.layer[rows]

    def places(self, found: Hits, rows: Named) -> Places:
        """Places in file and plane; a statement about the file has its place in the coordinates of the file."""
        geometry: Geometries | None = getattr(rows, "geometry", None)
        if geometry is None:
            return Places(found.where, self.columns.on_sheet(found.where), place_on(found.where))
        with np.errstate(invalid="ignore", over="ignore"):  # coordinates may be anything
            sheet = _with_depth(found, geometry)
            point = place_on(sheet)
            seen = np.isfinite(point[:, 0])
            point[seen] = self._lifted(point[seen])
            coordinates = shapely.get_coordinates(sheet, include_z=True)
            where = shapely.set_coordinates(shapely.force_3d(sheet.copy()), self._lifted(coordinates))
        return Places(where, sheet, point)

    def _lifted(self, coordinates: np.ndarray) -> np.ndarray:
        flat = coordinates.copy()
        flat[:, 2] = np.nan_to_num(flat[:, 2])
        return self.drawing.plane.lift(flat, self.metres)

    @cached_property
    def _on_layer(self) -> dict[str, Index]:
        # Rows of the columns by layer; they are in order of layers.
        names, start, count = np.unique(self.columns.layer.astype(str), return_index=True, return_counts=True)
        return {name: np.arange(a, a + n) for name, a, n in zip(names.tolist(), start, count, strict=True)}

    def _holding(self, kind: type) -> list[str]:
        of = self.columns.of_kind(kind, np.arange(len(self.columns.rows)))
        return sorted(set(self.columns.layer[of].tolist()))

    def _take(self, kind: type, layers: Patterns) -> Taken:
        if kind in FACTS:
            return Taken(FACTS[kind](self.drawing), np.empty(0, dtype=np.intp))
        named = [rows for name, rows in self._on_layer.items() if matches(name, layers)]
        on = np.concatenate([np.empty(0, dtype=np.intp), *named])
        rows = self.columns.build(kind, on)
        every = self.columns.rows[self.columns.of_kind(kind, on)]
        return Taken(rows, np.setdiff1d(union(every), union(rows.row), assume_unique=True))


def _agree(outcome: Outcome) -> list[tuple[str, float]]:
    return [(name, value) for name, value, _ in outcome.parameters]


def _with_depth(found: Hits, geometry: Geometries) -> Geometries:
    """Places with the depth of the item they lie on, where the drawing has depth and the kernel gave none."""
    on = geometry[found.row]
    flat = np.flatnonzero(shapely.has_z(on) & ~shapely.has_z(found.where) & ~shapely.is_empty(found.where))
    if not len(flat):
        return found.where
    places = found.where.copy()
    point, lines = shapely.points(place_on(places[flat])[:, :2]), _as_lines(on[flat])
    # GEOS divides by squares of lengths: a line that is too short for that has its first depth.
    along = np.zeros(len(lines))
    long = shapely.length(lines) ** 2 > 0
    along[long] = shapely.line_locate_point(lines[long], point[long])
    at = shapely.line_interpolate_point(lines, along)
    depth = np.nan_to_num(shapely.get_z(at))
    for n, z in zip(flat.tolist(), depth.tolist(), strict=True):
        places[n] = shapely.force_3d(places[n], z)
    return places


def _as_lines(geometry: Geometries) -> Geometries:
    """Lines, and the outer boundaries of areas."""
    lines = geometry.copy()
    area = shapely.get_type_id(lines) == shapely.GeometryType.POLYGON
    lines[area] = shapely.get_exterior_ring(lines[area])
    return lines
