# SPDX-License-Identifier: MIT
"""The surface of a mesh as places of tables are held against it."""

from functools import cached_property

import numpy as np

from foparq.check.surfaces.skin import Skin
from foparq.check.tables.ground import Ground, Nearness
from foparq.columns import Coordinates, Flags, Index, Reals, Texts
from foparq.findings.ties import Lies
from foparq.match.causes import UNIT_FACTORS, Cause, by_axes_or_unit
from foparq.match.linework import NOTHING, Footing
from foparq.match.surface_causes import by_fit, spread
from foparq.model.mesh import Mesh

_SPECK = 0.05  #: of the diagonal of the surface: places that reach less far show no unit
_SMALL = 50  #: a piece that is a mark is not larger than so many times what can be seen: 10 mm on the sheet


class SurfaceGround(Ground):
    """One mesh; it stands in space, and nothing in it bears a name.

    Parameters
    ----------
    skin : Skin
        With one triangle at least.
    """

    on = Lies.SURFACE
    taken = Lies.TAKEN_SURFACE

    def __init__(self, skin: Skin) -> None:
        self.skin = skin

    @property
    def path(self) -> str:
        """Of the mesh."""
        return self.skin.mesh.path

    @property
    def facade(self) -> str:
        """That the mesh shows."""
        return self.skin.mesh.facade

    def footing(self, places: Coordinates, within: Reals, printed: Reals | None = None) -> Footing:
        """Faces on which places lie.

        What the printed digits may hide is added as :meth:`foparq.check.surfaces.skin.Foot.hidden` tells it.
        """
        foot = self.skin.foot(places)
        distance = np.where(np.isnan(foot.distance), np.inf, foot.distance)
        reach = within if printed is None else within + foot.hidden(places, printed)
        on = distance <= reach
        vertex = np.where(on, foot.vertex, np.inf)
        return Footing(np.where(on, foot.face, NOTHING), distance, vertex, vertex <= reach)

    def called(self, rows: Index) -> tuple[Texts, Texts]:
        """Numbers of faces, and their groups."""
        mesh = self.skin.mesh
        item, layer = np.empty(len(rows), dtype=object), np.empty(len(rows), dtype=object)
        item[:] = [f"f{row}" for row in rows.tolist()]
        layer[:] = [mesh.groups[group] for group in mesh.group[rows].tolist()]
        return item, layer

    def near(self, surveyed: Coordinates, radius: float) -> Coordinates:
        """The nearest places of the surface, where they are within the radius.

        Of the difference only the part across the surface is seen so: it may be larger, never smaller.
        """
        if not len(surveyed):
            return surveyed.copy()
        foot = self.skin.foot(surveyed)
        taken: Coordinates = np.where((foot.distance <= radius)[:, np.newaxis], foot.place, np.nan)
        return taken

    def beyond(self, places: Coordinates, distance: Reals) -> Reals:  # noqa: ARG002 - a surface stands in space
        """The distances themselves."""
        return distance

    def longest(self) -> float:
        """Diagonal of the box of its largest piece."""
        return float(self._extent[self.skin.pieces.largest])

    def made(self, places: Coordinates, within: Reals, near: Nearness) -> Flags:  # noqa: ARG002 - linework needs it
        """(n,) places on a piece apart that is no larger than a mark."""
        made = np.zeros(len(places), dtype=bool)
        known = np.flatnonzero(np.isfinite(places).all(axis=1))
        if len(known):
            piece = self.skin.piece_of(self.skin.foot(places[known]).face)
            made[known] = (piece != self.skin.pieces.largest) & (self._extent[piece] <= _SMALL * near.visible)
        return made

    def cause(self, places: Coordinates, bearing: Coordinates, within: float, *, corners: bool) -> Cause | None:  # noqa: ARG002 - nothing bears a name
        """One cause that puts all places on the surface; none is looked for where these already lie on it."""
        if corners:
            return None

        def holds(moved: Coordinates, factor: float) -> Flags:
            # A table that a factor shrinks to a speck lies on anything; what was rounded is enlarged with all else.
            if np.linalg.norm(np.ptp(moved, axis=0)) < _SPECK * self.longest():
                return np.zeros(len(moved), dtype=bool)
            some, lies = spread(len(moved)), np.zeros(len(moved), dtype=bool)
            lies[some] = self.skin.foot(moved[some]).distance <= within * max(1.0, factor)
            if len(some) < len(moved) and lies[some].all():
                lies = self.skin.foot(moved).distance <= within * max(1.0, factor)
            return lies

        return by_axes_or_unit(places, UNIT_FACTORS, holds, turned=True) or by_fit(
            places, lambda moved: self.skin.foot(moved)[2:4], middle=self._middle, within=within
        )

    @cached_property
    def _extent(self) -> Reals:
        extent: Reals = np.linalg.norm(self.skin.pieces.high - self.skin.pieces.low, axis=1)
        return extent

    @cached_property
    def _middle(self) -> Reals:
        row = self.skin.pieces.largest
        middle: Reals = self.skin.pieces.low[row] / 2 + self.skin.pieces.high[row] / 2
        return middle


def surface_ground_of(mesh: Mesh) -> SurfaceGround | None:
    """What places are held against; ``None`` if nobody knows the unit of the mesh, or it has no surface."""
    if mesh.unit.metres is None:
        return None
    skin = Skin(mesh)
    return SurfaceGround(skin) if len(skin) else None
