# SPDX-License-Identifier: MIT
"""Features of a list on a flat field of squares, where every distance and area is known."""

from dataclasses import replace

import numpy as np
import pytest
from tests.check.test_surface_ground import mesh, texts

from foparq.check.surfaces.listed import count_on_surfaces
from foparq.columns import Coordinates
from foparq.findings.counts import FeatureCounts, Listed
from foparq.model.mesh import Mesh
from foparq.model.tables import FeatureList

N = 20  #: squares of 0.1 m along a side
STEP = 0.1
RAISED = np.array([0.0, 0.0, 0.5])
SHIFT = np.array([712345.678, 7456789.123, 812.5])


def field(height: float = 0.0, raised: tuple[slice, slice] | None = None, **said: object) -> Mesh:
    """A field of two metres; some of its vertices are raised."""
    z = np.zeros((N + 1, N + 1))
    if raised is not None:
        z[raised] = height
    x, y = np.meshgrid(np.arange(N + 1) * STEP, np.arange(N + 1) * STEP, indexing="ij")
    corner = np.arange((N + 1) ** 2).reshape(N + 1, N + 1)
    ring = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1).reshape(-1, 4)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    return mesh(points, [tuple(row) for row in ring.tolist()], **said)


def middles() -> Coordinates:
    at = (np.arange(N) + 0.5) * STEP
    x, y = np.meshgrid(at, at, indexing="ij")
    return np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)


def listed(place: Coordinates, **changes: object) -> FeatureList:
    n = len(place)
    made = FeatureList(
        id=texts([f"F{k}" for k in range(n)]), feature_class=texts(["curl"] * n), facade=texts([""] * n),
        count=np.ones(n, dtype=np.intp), use=texts(["required"] * n), accepted=texts([""] * n),
        evidence=texts([""] * n), place=place, tol=np.full(n, 0.01),
    )  # fmt: skip
    return replace(made, **changes)  # type: ignore[arg-type]


def counted(meshes: list[Mesh], features: FeatureList) -> FeatureCounts:
    found = count_on_surfaces(meshes, features=features, near=0.05)
    assert found is not None
    return found


def absent(found: FeatureCounts) -> list[int]:
    assert found.placements is not None
    rows: list[int] = np.flatnonzero(found.placements.lies == Listed.ABSENT).tolist()
    return rows


def test_all_places_of_a_field_are_there() -> None:
    found = counted([field()], listed(middles()))
    assert absent(found) == []
    assert (found.feature_class.tolist(), found.count.tolist(), found.on_meshes) == (["curl"], [N * N], True)


@pytest.mark.parametrize(("off", "missing"), [(0.0099, []), (0.0101, [7])])
def test_the_tolerance_of_the_list_may_be_met(off: float, missing: list[int]) -> None:
    place = middles()
    place[7, 2] = off
    assert absent(counted([field()], listed(place))) == missing


@pytest.mark.parametrize(("off", "missing"), [(0.049, []), (0.051, [7])])
def test_without_one_that_of_the_profile_holds(off: float, missing: list[int]) -> None:
    place = middles()
    place[7, 2] = off
    assert absent(counted([field()], listed(place, tol=np.full(N * N, np.nan)))) == missing


def test_georeferenced_places_are_the_same() -> None:
    place = middles()
    place[[3, 9], 2] = 0.02
    moved = field()
    moved = replace(moved, points=moved.points + SHIFT)
    assert absent(counted([moved], listed(place + SHIFT))) == [3, 9]


def test_a_feature_is_looked_for_on_meshes_of_its_facade() -> None:
    near, far = field(facade="N"), field(facade="S")
    far = replace(far, points=far.points + 2 * RAISED)
    place = np.vstack([middles()[:3], middles()[:3] + 2 * RAISED])
    sides = texts(["N", "s", "", "N", "S", ""])
    assert absent(counted([near, far], listed(place, facade=sides))) == [1, 3]


def test_classes_of_which_one_has_no_place_are_left_out() -> None:
    place = middles()[:6]
    place[4] = np.nan
    names = texts(["curl", "curl", "button", "button", "medal", "medal"])
    found = counted([field()], listed(place, feature_class=names))
    assert found.feature_class.tolist() == ["button", "curl"]
    several = listed(middles()[:6], feature_class=names, count=np.array([1, 1, 2, 1, 1, 1]))
    assert counted([field()], several).feature_class.tolist() == ["curl", "medal"]


def test_prohibited_features_are_not_looked_for() -> None:
    use = texts(["required", "prohibited", "optional"])
    found = counted([field()], listed(middles()[:3] + RAISED, use=use))
    assert absent(found) == [0, 2]


def test_meshes_of_unknown_unit_and_no_list_tell_nothing() -> None:
    unknown = field(unit=None)
    assert count_on_surfaces([unknown], features=listed(middles()), near=0.05) is None
    assert count_on_surfaces([field()], features=None, near=0.05) is None


def test_surface_beyond_the_spacing_is_told_by_area_and_place() -> None:
    """Four squares of the field bear no place: only what is farther than 60 mm from the next one is counted."""
    place = middles()
    kept = ~((place[:, 0] > 0.5) & (place[:, 0] < 0.9) & (place[:, 1] > 0.5) & (place[:, 1] < 0.9))
    found = counted([field()], listed(place[kept], spacing=0.08))
    (told,) = found.unlisted
    assert told.pieces == 1
    assert told.whole == pytest.approx(4.0)
    # The bare square of 0.4 m less what lies within 80 mm of the places around it, which are 50 mm outside.
    assert 0.34**2 - 0.01 < told.area < 0.4**2
    assert told.where is not None
    assert np.allclose(told.where, [0.7, 0.7, 0.0], atol=0.05)


def test_a_list_that_covers_the_surface_leaves_nothing() -> None:
    (told,) = counted([field()], listed(middles(), spacing=0.08)).unlisted
    assert (told.pieces, told.area, told.looked) == (0, 0.0, True)


def test_large_faces_are_looked_at_between_their_corners() -> None:
    corners = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], dtype=float)
    one = mesh(corners, [(0, 1, 2, 3)])
    (told,) = counted([one], listed(corners, spacing=0.1)).unlisted
    # Four quarters of a circle are explained.
    assert told.area == pytest.approx(4.0 - np.pi * 0.01, abs=0.02)


def test_what_lies_in_place_of_a_missing_feature_is_no_other_one() -> None:
    place = middles()
    missing = (place[:, 0] > 0.5) & (place[:, 0] < 0.9) & (place[:, 1] > 0.5) & (place[:, 1] < 0.9)
    place[missing, 2] = 0.15
    found = counted([field()], listed(place, spacing=0.08))
    assert absent(found) == np.flatnonzero(missing).tolist()
    assert [one.pieces for one in found.unlisted] == [0]


def test_a_bump_that_nobody_asked_for_is_told() -> None:
    (told,) = counted([field(0.3, (slice(8, 12), slice(8, 12)))], listed(middles(), spacing=0.08)).unlisted
    assert told.pieces == 1
    assert told.where is not None
    assert told.where[2] > 0.2


def test_a_list_of_something_else_is_asked_no_more() -> None:
    found = counted([field()], listed(middles() + RAISED, spacing=0.08))
    assert found.placements is not None
    assert found.placements.elsewhere
    assert found.unlisted == ()


def test_a_spacing_too_fine_for_the_surface_is_said() -> None:
    (told,) = counted([field()], listed(middles(), spacing=1e-5)).unlisted
    assert (told.pieces, told.looked) == (0, False)
