# SPDX-License-Identifier: MIT
"""What a rule returns: faulty things or measured differences, as columns."""

from dataclasses import dataclass, field, replace

import numpy as np

from foparq.columns import Flags, Geometries, Index, Reals

NOBODY = -1  #: in ``Hits.other``: no second item is involved


@dataclass(frozen=True, slots=True, kw_only=True)
class Hits:
    """Things found at fault, as columns of equal length k, ordered by (row, other, place)."""

    row: Index  #: (k,) row in the rule's first input
    where: Geometries  #: (k,) place to look at, in the coordinates of that input; empty if the fault has none
    size: Reals  #: (k,) magnitude, in the unit the rule declares
    other: Index  #: (k,) row of the second item involved, in the second input if there is one, or ``NOBODY``
    #: (m,) further rows of the first input at fault, where one hit tells of many: they count in rates
    also: Index = field(default_factory=lambda: np.empty(0, dtype=np.intp))

    def __len__(self) -> int:
        return len(self.row)

    def take(self, rows: Index | Flags) -> "Hits":
        """The chosen hits, in that order; further rows at fault stay."""
        return replace(self, row=self.row[rows], where=self.where[rows], size=self.size[rows], other=self.other[rows])


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviations:
    """Differences measured at k places, in the order of rows. They are faults where their length exceeds the limit."""

    row: Index  #: (k,) row in the rule's first input
    where: Geometries  #: (k,) place, in the coordinates of that input
    delta: Reals  #: (k, d) delivered minus reference, an axis a column, in the unit the rule declares
    other: Index  #: (k,) row in the second input: the reference

    def __len__(self) -> int:
        return len(self.row)

    def take(self, rows: Index | Flags) -> "Deviations":
        """The chosen differences, in that order."""
        return Deviations(row=self.row[rows], where=self.where[rows], delta=self.delta[rows], other=self.other[rows])

    def beyond(self, limit: float) -> Hits:
        """Differences longer than ``limit``, as hits."""
        length = np.sqrt(np.sum(self.delta**2, axis=1))
        far = length > limit
        return hits(self.row[far], self.where[far], length[far], self.other[far])


def hits(row: Index, where: Geometries, size: Reals, other: Index | None = None, also: Index | None = None) -> Hits:
    """Hits in their defined order.

    Parameters
    ----------
    row : (k,) int
    where : (k,) shapely geometries
    size : (k,) float
    other : (k,) int, optional
        ``NOBODY`` everywhere if left out.
    also : (m,) int, optional
        Further rows at fault.

    Returns
    -------
    Hits
        Ordered by row, other, then the lower left corner of the place.
    """
    import shapely  # noqa: PLC0415 - the records load without a geometry engine

    row = np.asarray(row, dtype=np.intp)
    others = np.full(len(row), NOBODY, dtype=np.intp) if other is None else np.asarray(other, dtype=np.intp)
    places = np.asarray(where, dtype=object)
    with np.errstate(over="ignore"):  # coordinates may be anything
        corner = np.round(shapely.bounds(places), 6) if len(row) else np.zeros((0, 4))
    order = np.lexsort((corner[:, 1], corner[:, 0], others, row))
    return Hits(
        row=row[order], where=places[order], size=np.asarray(size, dtype=float)[order], other=others[order],
        also=np.empty(0, dtype=np.intp) if also is None else np.asarray(also, dtype=np.intp),
    )  # fmt: skip


def no_hits() -> Hits:
    """Hits of a rule that found nothing."""
    nothing = np.empty(0, dtype=np.intp)
    return Hits(row=nothing, where=np.empty(0, dtype=object), size=np.empty(0), other=nothing)
