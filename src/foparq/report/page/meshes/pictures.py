# SPDX-License-Identifier: MIT
"""Six fixed pictures of a mesh, one a side: shaded flat, in parallel projection, all at one scale."""

import base64
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals, Texts
from foparq.report.page.inking import Ink, inked
from foparq.report.page.meshes.defects import Pieces
from foparq.report.page.meshes.paint import Pixels, deepest, dot, fill, is_open, palette, shaded, trace
from foparq.report.page.meshes.raster import seen
from foparq.report.page.meshes.sides import SIDES, side_frame
from foparq.report.page.meshes.surface import Shown
from foparq.report.page.png import palette_png

LONGEST = 640  #: pixels of the longest side of the surface
CELLS = 10  #: cells of the lettering in a pixel
ACROSS = 84.0  #: mm of paper of the widest picture
NUMBERED = 40  #: marks of one picture that bear their number, the gravest first
_MARGIN = 20  #: pixels around the surface
_LEAST = 200  #: pixels of the narrowest picture: the scale bar needs room
_BELOW = 0.004  #: of the longest side: what lies no deeper under the surface is on it
UNIT = (LONGEST + 2 * _MARGIN) * CELLS / ACROSS  #: cells in a millimetre of paper


class Marks(NamedTuple):
    """Marks of one mesh, the gravest first."""

    place: Reals  #: (n, 3) in the frame of the surface
    severity: Texts  #: (n,)
    number: Index  #: (n,)


@dataclass(frozen=True, slots=True, kw_only=True)
class SidePicture:
    """One side as a picture."""

    side: str
    image: str  #: PNG, base64
    width: int  #: pixels
    height: int
    ink: Ink  #: marks that are seen, with their numbers, cells
    hidden: Ink  #: marks that the surface hides; those that no side shows bear their number on the first

    @property
    def across(self) -> float:
        """Width on paper, mm."""
        return self.width * CELLS / UNIT


class _Side(NamedTuple):
    """A picture before its marks."""

    side: str
    pixels: Pixels
    spots: Reals  #: (n, 3) marks, pixels and depth
    inside: Flags  #: (n,) on the picture
    open: Flags  #: (n,) and not hidden


def pictures_of(shown: Shown, up: str, pieces: Pieces, marks: Marks) -> tuple[SidePicture, ...]:
    """Pictures of all six sides; none of a surface without triangles.

    Notes
    -----
    Coordinates are those of the surface as it is shown, findings stand at their own.
    """
    if not len(shown.triangles):
        return ()
    sides = [_side(shown, side, side_frame(up, side), pieces, marks) for side in SIDES]
    nowhere = ~np.any([side.open for side in sides], axis=0)
    return tuple(_picture(side, marks, nowhere & (n == 0)) for n, side in enumerate(sides))


def unnumbered(pictures: tuple[SidePicture, ...], marks: Marks) -> int:
    """Marks whose number stands on no picture."""
    borne = {label.text for picture in pictures for ink in (picture.ink, picture.hidden) for label in ink.labels}
    return sum(str(number) not in borne for number in marks.number.tolist())


def _side(shown: Shown, side: str, frame: Reals, pieces: Pieces, marks: Marks) -> _Side:
    box = np.stack([np.zeros(3), shown.extent]) @ frame.T
    size = np.maximum(np.ceil(np.ptp(box, axis=0)[:2] * LONGEST) + 2 * _MARGIN, _LEAST).astype(int)
    middle = box.mean(axis=0) * (1.0, 1.0, 0.0)

    def project(points: Reals) -> Reals:
        """To pixels: to the right, downward, and towards the viewer."""
        placed: Reals = ((points @ frame.T) - middle) * (LONGEST, -LONGEST, LONGEST) + (*(size / 2), 0.0)
        return placed

    corners = project(shown.vertices)[shown.triangles]
    found = seen(corners, *size.tolist())
    pixels = shaded(corners, found)
    floor = deepest(found.depth) - LONGEST * max(1.75 * shown.cell, _BELOW)  # half the diagonal of a cell, and a doubt
    fill(pixels, floor, project(pieces.faces), pieces.face_rank)
    trace(pixels, floor, project(pieces.lines), pieces.line_rank)
    dot(pixels, floor, project(pieces.points), pieces.point_rank, reach=2)
    spots = project(marks.place)
    return _Side(side, pixels, spots, *is_open(floor, spots))


def _picture(side: _Side, marks: Marks, nowhere: Flags) -> SidePicture:
    height, width = side.pixels.shape
    seen_here = np.flatnonzero(side.open)
    hidden = np.flatnonzero(side.inside & ~side.open)
    first = nowhere[hidden]
    ink = _ink(side, marks, seen_here[:NUMBERED], seen_here[NUMBERED:])
    return SidePicture(
        side=side.side, image=base64.b64encode(palette_png(side.pixels, palette())).decode("ascii"),
        width=width, height=height, ink=ink,
        hidden=_ink(side, marks, hidden[first][:NUMBERED], np.concatenate([hidden[~first], hidden[first][NUMBERED:]]),
                    ink.boxes),
    )  # fmt: skip


def _ink(side: _Side, marks: Marks, numbered: Index, others: Index, taken: Reals | None = None) -> Ink:
    """Signs of some marks with their numbers, and of others without."""
    height, width = side.pixels.shape
    window = np.array([0.0, 0.0, width * CELLS, height * CELLS])
    spots = np.rint(side.spots[:, :2] * CELLS)
    none = np.empty((0, 4)) if taken is None else taken
    rows = np.concatenate([numbered, others])
    made = inked(window, UNIT, spots[numbered], marks.severity[numbered], marks.number[numbered], none)
    return made.with_signs(spots[rows], marks.severity[rows], UNIT)
