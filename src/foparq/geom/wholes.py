# SPDX-License-Identifier: MIT
"""Groups of lines that are drawn again, as wholes, a little aside."""

import numpy as np
import shapely

from foparq.columns import Index, Reals
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.hulls import hulls_of, leaders
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import ragged

LOOSE = -1  #: a line of no whole


def repeated_wholes(
    lines: Polylines, whole: Index, *, coincide: float, apart: Index | None = None
) -> tuple[Index, Index]:
    """Lines of wholes that are copies of others, and the line that each repeats.

    A whole is a copy of another if both stand in one place (:func:`foparq.geom.hulls.leaders`) and, once their boxes
    are laid centre on centre, every line of one lies on a line of its own of the other, within ``coincide``.

    Parameters
    ----------
    lines : Polylines, n lines
    whole : (n,) int
        Number of the whole to which a line belongs, from 0; ``LOOSE`` if to none.
    coincide : float, metres
        Distance up to which two places are one.
    apart : (n,) int, optional
        Lines with different numbers repeat nothing of each other: wholes are compared if they have as many of each.

    Returns
    -------
    copy, repeated : (k,) int
        Rows of lines.

    Notes
    -----
    Of the wholes in one place all but the largest are copies, of equal ones all but the first. O(n log n + near pairs).
    """
    rows = np.flatnonzero(whole != LOOSE)
    nothing = np.empty(0, dtype=np.intp)
    if not len(rows):
        return nothing, nothing
    apart = np.zeros(len(lines), dtype=np.intp) if apart is None else apart
    rows = rows[np.lexsort((apart[rows], whole[rows]))]
    _, of = np.unique(whole[rows], return_inverse=True)
    size = np.bincount(of)
    line, vertex = ragged(lines.heads[rows], np.diff(lines.offsets)[rows])
    hulls = hulls_of(shapely.points(lines.plane[vertex]), of[line])
    lead = leaders(hulls, _made_of(apart[rows], size))
    copy = np.flatnonzero(lead != np.arange(len(size)))
    if not len(copy):
        return nothing, nothing
    kept = np.isin(of, [copy, lead[copy]])
    rows, of = rows[kept], of[kept]
    box = shapely.bounds(hulls)
    centre = (box[:, :2] + box[:, 2:]) / 2
    moved = _moved(lines, rows, (centre[lead] - centre)[of])
    label = duplicate_groups(moved, coincide=coincide, apart=apart[rows])
    order = np.lexsort((rows, label, of))
    rows, of, label = rows[order], of[order], label[order]
    start = np.searchsorted(of, np.arange(len(size)))
    pair, place = ragged(start[copy], size[copy])
    partner = place + (start[lead[copy]] - start[copy])[pair]
    same = np.ones(len(copy), dtype=bool)
    same[pair[label[place] != label[partner]]] = False
    return rows[place[same[pair]]], rows[partner[same[pair]]]


def _made_of(apart: Index, size: Index) -> Index:
    """Number (k,) of each whole: equal where as many lines have each number of ``apart``, which is sorted in each."""
    numbers: dict[bytes, int] = {}
    parts = np.split(apart, np.cumsum(size)[:-1])
    return np.array([numbers.setdefault(part.tobytes(), len(numbers)) for part in parts], dtype=np.intp)


def _moved(lines: Polylines, rows: Index, shift: Reals) -> Polylines:
    """The chosen lines, each moved in the plane."""
    count = np.diff(lines.offsets)[rows]
    line, vertex = ragged(lines.heads[rows], count)
    coordinates = lines.coordinates[vertex].copy()
    coordinates[:, :2] += shift[line]
    return Polylines(coordinates, np.concatenate([[0], np.cumsum(count)]))
