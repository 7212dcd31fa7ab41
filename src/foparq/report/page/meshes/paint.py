# SPDX-License-Identifier: MIT
"""What a fixed picture of a mesh is painted with: greys of the surface, and colours of findings over it."""

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index, Reals
from foparq.report.page.meshes.raster import NOTHING, Seen, seen

Pixels = NDArray[np.uint8]  #: (height, width) rows of the palette

_TONES = 32  #: of the outer side; as many of the inner one
_LIGHT = np.array([-0.35, 0.45, 0.82])  #: from above on the left, behind the viewer: right, up, towards the viewer
_AMBIENT = 0.25  #: light that comes from everywhere
_OUTER = np.array([(96, 92, 86), (242, 239, 233)])  #: darkest and lightest
_INNER = np.array([(52, 70, 96), (140, 160, 188)])
#: colours of findings as on the rest of the page, by rank; where the surface hides them they are lighter
_COLOURS = np.array([(0x5F, 0x07, 0x12), (0xC1, 0x12, 0x1F), (0xA9, 0x48, 0x0A), (0x1C, 0x56, 0x94)])
_LIGHTER = 0.6  #: share of white
PAPER = 0  #: row of the palette where nothing is
_FOUND = 1 + 2 * _TONES  #: row of the gravest
_STEP = 0.7  #: pixels between points along a line
_SAMPLES = 2_000_000  #: points along all lines of one picture


def palette() -> Pixels:
    """(n, 3) red, green, blue: paper, outer side, inner side, findings by rank, hidden findings by rank."""
    grades = np.linspace(0, 1, _TONES)[:, np.newaxis]
    sides = [dark + grades * (light - dark) for dark, light in (_OUTER, _INNER)]
    lighter = _COLOURS + _LIGHTER * (255 - _COLOURS)
    colours: Pixels = np.rint(np.concatenate([[(255, 255, 255)], *sides, _COLOURS, lighter])).astype(np.uint8)
    return colours


def shaded(corners: Reals, found: Seen) -> Pixels:
    """The surface, each triangle in one tone; the side that looks away from the outside in another colour.

    Parameters
    ----------
    corners : (t, 3, 3)
        As for :func:`seen`: pixels to the right and downward.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    # Pixels run downward: with the sign of that axis turned back, and the product turned with it, it looks outside.
    normal = np.cross(b - a, c - a) * (-1.0, 1.0, -1.0)
    length = np.linalg.norm(normal, axis=1)
    light = normal @ (_LIGHT / np.linalg.norm(_LIGHT)) / np.where(length > 0, length, 1.0)
    inner = normal[:, 2] < 0
    light = np.where(inner, -light, light)
    tone = np.rint((_AMBIENT + (1 - _AMBIENT) * np.clip(light, 0, 1)) * (_TONES - 1)).astype(np.uint8)
    tone += np.where(inner, 1 + _TONES, 1).astype(np.uint8)
    pixels: Pixels = np.where(found.triangle == NOTHING, PAPER, tone[found.triangle]).astype(np.uint8)
    return pixels


def deepest(depth: Reals) -> Reals:
    """Least depth among each pixel and its neighbours: what is above it is not hidden by a slope."""
    padded = np.pad(depth, 1, mode="edge")
    rows = np.minimum(np.minimum(padded[:-2], padded[1:-1]), padded[2:])
    least: Reals = np.minimum(np.minimum(rows[:, :-2], rows[:, 1:-1]), rows[:, 2:])
    return least


def is_open(floor: Reals, spots: Reals) -> tuple[Flags, Flags]:
    """Which spots (n, 3) lie on the picture, and which of them above the floor of depths."""
    height, width = floor.shape
    inside: Flags = np.all((spots[:, :2] >= 0) & (spots[:, :2] < (width, height)), axis=1)
    above: Flags = inside.copy()
    column, line = spots[inside, :2].astype(np.intp).T
    above[inside] = spots[inside, 2] >= floor[line, column]
    return inside, above


def fill(pixels: Pixels, floor: Reals, corners: Reals, rank: Index) -> None:
    """Paint triangles (c, 3, 3) of findings; lighter where they are below the floor of depths (height, width)."""
    height, width = pixels.shape
    for part in np.unique(rank)[::-1].tolist():  # the gravest last, on top
        found = seen(corners[rank == part], width, height)
        _put(pixels, found.triangle != NOTHING, found.depth >= floor, part)


def trace(pixels: Pixels, floor: Reals, lines: Reals, rank: Index) -> None:
    """Paint lines (b, 2, 3) of findings, two pixels wide, likewise."""
    long = np.abs(lines[:, 1, :2] - lines[:, 0, :2]).max(axis=1)
    far = float(max(pixels.shape)) * 4  # a line that leaves the picture needs no more points than fit on it
    number = np.ceil(np.minimum(long, far) / _STEP)
    number = np.ceil(number * min(1.0, _SAMPLES / max(float(number.sum()), 1.0))).astype(np.intp) + 1
    line = np.repeat(np.arange(len(lines)), number)
    nth = np.arange(len(line)) - np.repeat(np.cumsum(number) - number, number)
    share = (nth / np.maximum(number[line] - 1, 1))[:, np.newaxis]
    dot(pixels, floor, lines[line, 0] * (1 - share) + lines[line, 1] * share, rank[line], reach=1)


def dot(pixels: Pixels, floor: Reals, spots: Reals, rank: Index, reach: int) -> None:
    """Paint spots (a, 3) of findings as squares of ``reach + 1`` pixels, likewise."""
    inside, above = is_open(floor, spots)
    height, width = pixels.shape
    for part in np.unique(rank)[::-1].tolist():
        mine = inside & (rank == part)
        drawn, on_top = np.zeros(pixels.shape, dtype=bool), np.zeros(pixels.shape, dtype=bool)
        for across in range(reach + 1):
            for down in range(reach + 1):
                column = np.minimum(spots[mine, 0].astype(np.intp) + across, width - 1)
                line = np.minimum(spots[mine, 1].astype(np.intp) + down, height - 1)
                drawn[line, column] = True
                on_top[line[above[mine]], column[above[mine]]] = True
        _put(pixels, drawn, on_top, part)


def _put(pixels: Pixels, drawn: Flags, above: Flags, rank: int) -> None:
    """Paint what is drawn; what is hidden never covers a finding that is seen."""
    hidden = drawn & ~above & ~((pixels >= _FOUND) & (pixels < _FOUND + len(_COLOURS)))
    pixels[hidden] = _FOUND + len(_COLOURS) + rank
    pixels[drawn & above] = _FOUND + rank
