# SPDX-License-Identifier: MIT
"""Clusters of intersections, against drawn ones and against a search by hand."""

import numpy as np
import pytest
from tests.mesh.meshes import two_spheres

from foparq.mesh.intersections import intersections
from foparq.mesh.meetingclusters import clusters


def test_three_places_are_three_clusters_with_their_boxes() -> None:
    points, corners = two_spheres(3)
    shifts = np.array([[9.0, 0, 0], [0.0, 0, 0], [0, 500.0, 0]])
    many = np.concatenate([points + shift for shift in shifts])
    faces = np.concatenate([corners + k * len(points) for k in range(3)])
    found = intersections(many, faces, keep=10**6)
    told = clusters(found.first, found.second, found.segment, faces)
    assert told.label.tolist() == (found.first // len(corners)).tolist()
    assert told.pairs.tolist() == [found.total // 3] * 3
    involved = np.unique(np.concatenate([found.first, found.second]))
    assert told.triangles.tolist() == np.bincount(involved // len(corners)).tolist()
    for k in range(3):
        ends = found.segment[told.label == k].reshape(-1, 3)
        assert told.low[k].tolist() == ends.min(axis=0).tolist()
        assert told.high[k].tolist() == ends.max(axis=0).tolist()
        assert (told.high[k] - told.low[k]).max() == pytest.approx(
            2 * np.sqrt(1 - (0.5**2 + 0.013**2 + 0.027**2) / 4), abs=0.03
        )


def test_pairs_belong_together_as_a_search_by_hand_says() -> None:
    rng = np.random.default_rng(5)
    for n in (1, 2, 5, 12, 30, 60):
        corners = rng.integers(0, 80, size=(60, 3))
        pairs = np.sort(np.array([rng.choice(60, 2, replace=False) for _ in range(n)]), axis=1)
        segment = rng.normal(size=(n, 2, 3))
        told = clusters(pairs[:, 0], pairs[:, 1], segment, corners)
        groups: list[set[int]] = []
        for pair in pairs.tolist():
            members = {*pair, *(100 + int(point) for point in corners[pair].ravel())}
            for group in [group for group in groups if group & members]:
                members |= group
                groups.remove(group)
            groups.append(members)
        known = [next(k for k, group in enumerate(groups) if pair[0] in group) for pair in pairs.tolist()]
        assert len(set(told.label.tolist())) == len(groups) == len(told.pairs)
        assert all((told.label[i] == told.label[j]) == (known[i] == known[j]) for i in range(n) for j in range(n))
        # Numbered by their first pairs.
        assert told.label[np.sort(np.unique(told.label, return_index=True)[1])].tolist() == list(range(len(groups)))
        assert told.pairs.tolist() == np.bincount(told.label).tolist()
        rows = np.unique(pairs)
        for label, size in enumerate(told.triangles.tolist()):
            group = groups[known[told.label.tolist().index(label)]]
            assert size == sum(int(row) in group for row in rows)


def test_nothing_makes_no_cluster() -> None:
    none = np.empty(0, dtype=np.intp)
    told = clusters(none, none, np.empty((0, 2, 3)), np.empty((0, 3), dtype=np.intp))
    assert [len(column) for column in told] == [0] * 5
