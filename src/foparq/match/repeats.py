# SPDX-License-Identifier: MIT
"""Observations that repeat one another: they are one piece of evidence."""

import numpy as np

from foparq.columns import Index, Reals

_FEW = 300  #: places that are compared each with each


def repeats(places: Reals, *, apart: float) -> Index:
    """Groups of observations that lie no farther apart than one step from the next.

    Parameters
    ----------
    places : (n, d) float
        A row with a value that is not finite stands by itself.
    apart : float
        Greatest distance of two neighbours of one group, in the unit of the places.

    Returns
    -------
    (n,) int
        Number of the group, which is the row of its first member.

    Notes
    -----
    Single linkage; O(n log n + near pairs).

    Examples
    --------
    >>> repeats(np.array([[0.0], [5.0], [0.1]]), apart=0.2).tolist()
    [0, 1, 0]
    """
    n = len(places)
    known = np.flatnonzero(np.isfinite(places).all(axis=1))
    # Equal places first: a thousand copies would be half a million near pairs.
    distinct, same = np.unique(places[known], axis=0, return_inverse=True)
    label = _linked(distinct, apart)[same.reshape(-1)]
    group: Index = np.arange(n)
    _, first = np.unique(label, return_index=True)
    group[known] = known[first[label]]
    return group


def _linked(places: Reals, apart: float) -> Index:
    """(m,) number of the chain of neighbours, from 0."""
    m = len(places)
    if m <= _FEW:
        near = np.linalg.norm(places[:, None] - places[None], axis=2) <= apart
        label: Index = np.arange(m)
        for n in range(m):  # one member names its chain
            label[np.isin(label, label[near[n]])] = label[n]
        numbered: Index = np.unique(label, return_inverse=True)[1].reshape(-1)
        return numbered
    from scipy.sparse import coo_array  # noqa: PLC0415 - slow to load; most tables are short
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415
    from scipy.spatial import cKDTree  # noqa: PLC0415

    pairs = cKDTree(places).query_pairs(apart, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(m, m))
    chains: Index = connected_components(graph, directed=False)[1].astype(np.intp)
    return chains
