# SPDX-License-Identifier: MIT
"""Which way faces look, and the volume they enclose."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.mesh.edges import Edges, faces_joined
from foparq.mesh.grouping import joined, numbered
from foparq.mesh.polygons import blocks, face_of, following
from foparq.mesh.vectors import cross, dot, lengths, overflowing

_EPSILON = float(np.finfo(np.float64).eps)


class Orientation(NamedTuple):
    """Faces that look to another side than most faces of their sheet.

    A sheet is what hangs together over edges where exactly two sides meet; at other edges no face says how another
    should look.
    """

    sheet: Index  #: (f,) sheet of every face, in order of their lowest faces
    flipped: Flags  #: (f,) True for the smaller part of a sheet; False throughout a sheet that is not orientable
    orientable: Flags  #: (k,) False for a sheet that has one side only, like a strip of Moebius


def orientation(starts: Index, edges: Edges) -> Orientation:
    """Orientation of faces among each other.

    Parameters
    ----------
    starts : (f + 1,) int
    edges : Edges

    Returns
    -------
    Orientation
        Of two parts with as many faces the one without the lowest face is ``flipped``.

    Notes
    -----
    Faces that agree are joined to patches. Every patch is taken twice, as it is and turned over; where a patch meets
    itself turned over, its sheet has one side only. O(m log m) at worst, linear on surfaces.
    """
    face = face_of(starts)
    count = len(starts) - 1
    patch, roots = numbered(faces_joined(edges, face, count, agreeing=True))
    patches = len(roots)
    at = edges.starts[edges.inconsistent]
    first, second = patch[face[edges.sides[at]]], patch[face[edges.sides[at + 1]]]
    whole = joined(patches, first, second)
    twice = joined(2 * patches, np.concatenate([first, second]), np.concatenate([second, first]) + patches)
    # The lowest patch of a sheet labels the side that it is on.
    other = twice[:patches] != whole
    single = twice[:patches] == twice[patches:]
    sheet, lowest = numbered(whole)
    of = sheet[patch]
    orientable = np.ones(len(lowest), dtype=bool)
    orientable[sheet[single]] = False
    turned = other[patch]
    faces, minor = np.bincount(of, minlength=len(lowest)), np.bincount(of[turned], minlength=len(lowest))
    flipped = np.where((2 * minor <= faces)[of], turned, ~turned) & orientable[of]
    return Orientation(of, flipped, orientable)


class Closed(NamedTuple):
    """Whether components enclose a volume."""

    closed: Flags  #: (k,) True where two sides meet at every edge
    consistent: Flags  #: (k,) True where they run opposite ways, as far as exactly two meet


def closed_components(starts: Index, edges: Edges, label: Index, *, count: int) -> Closed:
    """Closed components, and those whose faces all agree.

    Parameters
    ----------
    starts : (f + 1,) int
    edges : Edges
    label : (f,) int
        Component of every face.
    count : int
        Number of components.

    Returns
    -------
    Closed
    """
    owner = label[face_of(starts)]
    closed, consistent = np.zeros(count, dtype=bool), np.ones(count, dtype=bool)
    valence = edges.valence
    closed[owner[edges.sides]] = True
    open_edges = np.flatnonzero((valence > 0) & (valence != 2))  # noqa: PLR2004 - two sides meet
    closed[owner[edges.sides[edges.starts[open_edges]]]] = False
    consistent[owner[edges.sides[edges.starts[edges.inconsistent]]]] = False
    return Closed(closed, consistent)


class Volumes(NamedTuple):
    """Signed volumes of components."""

    volume: Reals  #: (k,) cubic metres; above zero where the faces of a closed component look outward
    doubt: Reals  #: (k,) cubic metres; a volume within this of zero has no sign


@overflowing
def signed_volumes(points: Coordinates, corners: Index, starts: Index, label: Index, *, count: int) -> Volumes:
    """Volume that each component encloses, by the direction of its faces.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
    starts : (f + 1,) int
    label : (f,) int
        Component of every face.
    count : int
        Number of components.

    Returns
    -------
    Volumes
        Of a component that is closed. That of an open one depends on the place of its first corner, from which the
        volume is computed.

    Notes
    -----
    Sum of the cones over all faces from the first corner of the component; polygons that are not plane are taken as
    fans from their first corners. O(m). A closed component inside of another may rightly look inward: that it lies
    inside is not tested here.
    """
    lowest = np.zeros(count, dtype=np.intp)
    lowest[label[::-1]] = np.arange(len(label) - 1, -1, -1)
    origin = points[corners[starts[lowest]]]
    volume, size = np.zeros(count), np.zeros(count)
    for first, stop in blocks(starts):
        at = starts[first : stop + 1] - starts[first]
        place = points.take(corners[starts[first] : starts[stop]], axis=0)
        owner = face_of(at)
        base = place[at[:-1]]
        spoke = place - base[owner]
        arm = base - origin[label[first:stop]]
        after = following(at)
        spread = cross(spoke, spoke[after])
        long = lengths(spoke)
        far = lengths(arm)
        cone = np.add.reduceat(dot(arm[owner], spread), at[:-1]) / 6
        bound = far * np.add.reduceat(long * long[after], at[:-1]) / 6
        volume += np.bincount(label[first:stop], cone, minlength=count)
        size += np.bincount(label[first:stop], bound, minlength=count)
    # Sixteen roundings a term at most, and one for each sum.
    number = np.bincount(label, np.diff(starts), minlength=count)
    return Volumes(volume, size * (16 + number) * _EPSILON)
