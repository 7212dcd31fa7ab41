# SPDX-License-Identifier: MIT
"""Distances of references whose right values follow from how they were made."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.check.test_surface_ground import box, mesh
from tests.mesh.made import GEOREFERENCED, sphere

from foparq.check.surfaces.clouds import compare_clouds
from foparq.columns import Coordinates, Reals
from foparq.findings.clouds import CloudDistances, Signs
from foparq.model.cloud import Cloud
from foparq.model.delivery import Delivery
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.mesh import Mesh

SIZE = np.array([2.0, 3.0, 4.0])  #: of the box
SEARCH, LIMIT = 0.05, 0.015


def cloud(points: Coordinates, *, unit: float | None = 1.0, **said: Any) -> Cloud:
    stated = DrawingUnit(metres=unit, name="", origin=UnitOrigin.STATED)
    return Cloud(**{"path": "nuvem.xyz", "points": points, "empty": 0, "unit": stated, "survey_sd": None, **said})


def compare(meshes: list[Mesh], *clouds: Cloud) -> tuple[CloudDistances, ...]:
    delivery = Delivery(title="", sources=(), parts=tuple(meshes), references=clouds)
    return compare_clouds(delivery, search=SEARCH, beyond=LIMIT)


def one(meshes: list[Mesh], points: Coordinates, **said: Any) -> CloudDistances:
    (found,) = compare(meshes, cloud(points, **said))
    return found


def on_sides(n: int, offset: float, seed: int = 1) -> Coordinates:
    """Places over the sides of the box, so far outside of them along the normal, away from its edges."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(0.2, 0.8, (n, 3)) * SIZE
    axis, high = rng.integers(0, 3, n), rng.integers(0, 2, n)
    points[np.arange(n), axis] = np.where(high, SIZE[axis] + offset, -offset)
    return points


def ball(subdivisions: int = 3, radius: float = 1.0, middle: Coordinates | float = 0.0, **said: Any) -> Mesh:
    made = sphere(subdivisions)
    faces = [tuple(face) for face in made.lists()]
    return mesh(made.points * radius + middle, faces, **said)


def directions(n: int, seed: int = 2) -> Coordinates:
    drawn = np.random.default_rng(seed).normal(size=(n, 3))
    made: Coordinates = drawn / np.linalg.norm(drawn, axis=1, keepdims=True)
    return made


@pytest.mark.parametrize("offset", [0.004, 0.02, -0.004, -0.02])
def test_an_offset_is_the_root_mean_square_with_its_sign(offset: float) -> None:
    found = one([box()], on_sides(3000, offset))
    assert (found.n, found.signs, found.elsewhere, found.repeats) == (3000, Signs.CLOSED, False, False)
    assert [found.rms, found.quantile, found.largest] == pytest.approx([abs(offset)] * 3, abs=1e-12)
    assert [found.mean, found.median, found.sd] == pytest.approx([offset, offset, 0], abs=1e-12)
    assert found.beyond == (3000 if abs(offset) > LIMIT else 0)
    assert found.uncovered.n == 0
    assert found.counts.sum() == 3000


def test_statistics_of_known_distances() -> None:
    offsets = np.repeat([0.001, -0.003, 0.01, 0.02, -0.06], [50, 20, 20, 9, 1])
    points = np.concatenate([on_sides(1, d, seed) for seed, d in enumerate(offsets.tolist())])
    found = one([box()], points, survey_sd=0.002)
    assert found.rms == pytest.approx(np.sqrt((offsets**2).sum() / 100))
    assert [found.mean, found.median] == pytest.approx([offsets.sum() / 100, 0.001])
    assert found.sd == pytest.approx(np.sqrt(((offsets - offsets.mean()) ** 2).sum() / 99))
    assert found.quantile == pytest.approx(0.02)  # the 91st to the 99th in order of size
    assert [found.beyond, found.uncovered.n, found.largest] == pytest.approx([10, 1, 0.06])
    assert found.worst[0].distance == pytest.approx(-0.06)
    assert found.worst[0].place == tuple(points[-1].tolist())
    assert found.uncovered.place == tuple(points[-1].tolist())


@pytest.mark.parametrize("shift", [np.zeros(3), np.array(GEOREFERENCED)])
def test_distances_from_a_sphere_lie_between_those_from_the_inner_and_the_outer_one(shift: Coordinates) -> None:
    surface = ball(5, middle=shift)
    corners = surface.points[surface.corners.reshape(-1, 3)] - shift
    sagitta = 1 - np.linalg.norm(corners.mean(axis=1), axis=1).min()
    found = one([surface], directions(5000) * 1.002 + shift)
    assert 0.002 - 1e-8 <= found.median <= 0.002 + 1.1 * sagitta
    assert found.signs is Signs.CLOSED
    assert one([surface], directions(5000) * 0.99 + shift).largest <= 0.01 + 1e-8
    assert one([surface], directions(5000) * 0.99 + shift).mean < 0


def brute(surface: Mesh, points: Coordinates) -> Reals:
    """Distance from the nearest of all triangles: of the foot on each, where that lies within, and of every edge."""
    a, b, c = (surface.points[surface.corners.reshape(-1, 3)[:, k]] for k in range(3))
    best = np.full(len(points), np.inf)
    for p, q, r in zip(a, b, c, strict=True):
        u, v = q - p, r - p
        system = np.array([[u @ u, u @ v], [u @ v, v @ v]])
        s, t = np.linalg.solve(system, np.stack([(points - p) @ u, (points - p) @ v]))
        inside = (s >= 0) & (t >= 0) & (s + t <= 1)
        foot = p + s[:, None] * u + t[:, None] * v
        best = np.where(inside, np.minimum(best, np.linalg.norm(points - foot, axis=1)), best)
        for e, f in ((p, q), (q, r), (r, p)):
            share = np.clip((points - e) @ (f - e) / ((f - e) @ (f - e)), 0, 1)
            best = np.minimum(best, np.linalg.norm(points - e - share[:, None] * (f - e), axis=1))
    return best


def test_all_numbers_are_those_of_brute_force() -> None:
    surface = ball(1)
    points = np.random.default_rng(5).uniform(-1.3, 1.3, (400, 3))
    size = brute(surface, points)
    corners = surface.points[surface.corners.reshape(-1, 3)]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # A convex body: a place is within where it is behind every face.
    side = np.einsum("ijk,jk->ij", points[:, None] - corners[None, :, 0], normal)
    signed = np.where((side < 0).all(axis=1), -size, size)
    found = one([surface], points)
    assert [found.rms, found.mean, found.median, found.sd, found.quantile, found.largest] == pytest.approx([
        np.sqrt((size**2).mean()), signed.mean(), np.median(signed), signed.std(ddof=1), np.quantile(size, 0.95),
        size.max(),
    ])  # fmt: skip
    assert (found.beyond, found.uncovered.n) == ((size > LIMIT).sum(), (size > SEARCH).sum())
    by_hand = np.histogram(np.clip(signed, found.edges[0], found.edges[-1]), bins=found.edges)[0]
    assert found.counts.tolist() == by_hand.tolist()


def test_units_of_mesh_and_reference_are_their_own() -> None:
    points = on_sides(500, 0.004)
    told = [one([box()], points), one([box(0.001)], points), one([box()], points / 0.001, unit=0.001)]
    assert [found.rms for found in told] == pytest.approx([0.004] * 3)
    assert one([box()], points * 1000).elsewhere
    assert compare([box()], cloud(points, unit=None)) == ()
    assert (
        compare([replace(box(), unit=DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN))], cloud(points))
        == ()
    )


def test_the_order_of_the_points_makes_no_difference() -> None:
    points = directions(3000) * np.random.default_rng(3).normal(1.0, 0.03, (3000, 1))
    ties = np.array([[2.0, 0, 0], [-2.0, 0, 0], [0, 2.0, 0]])
    points = np.concatenate([points, ties, ties])
    surface, forth, mixed = ball(2), points, points[np.random.default_rng(4).permutation(len(points))]
    first, second = one([surface], forth), one([surface], mixed)
    for name in CloudDistances.__dataclass_fields__:
        assert np.array_equal(getattr(first, name), getattr(second, name)), name


def test_a_reference_in_parts_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    points = directions(1000) * 1.01
    whole = one([ball(2)], points)
    monkeypatch.setattr("foparq.check.surfaces.clouds._PART", 7)
    parts = one([ball(2)], points)
    assert (whole.rms, whole.worst, whole.mean) == (parts.rms, parts.worst, parts.mean)


def test_the_half_that_is_missing_is_not_covered() -> None:
    whole = ball(4)
    middles = whole.points[whole.corners.reshape(-1, 3)].mean(axis=1)
    half = ball(4)
    rows = np.flatnonzero(middles[:, 0] > 0)
    half = replace(
        half, corners=half.corners.reshape(-1, 3)[rows].ravel(), starts=np.arange(0, 3 * len(rows) + 1, 3),
        group=half.group[rows],
    )  # fmt: skip
    points = directions(20000)
    found = one([half], points)
    # Nearest of what is missing is the rim, near x = 0.
    rim = points * [0, 1, 1]
    rim /= np.linalg.norm(rim, axis=1, keepdims=True)
    missing = (points[:, 0] < 0) & (np.linalg.norm(points - rim, axis=1) > SEARCH)
    assert found.uncovered.n / found.n == pytest.approx(missing.mean(), abs=0.02)
    assert found.uncovered.largest == found.uncovered.n
    assert found.uncovered.place is not None
    assert found.uncovered.place[0] < -0.95
    assert not found.elsewhere
    assert one([whole], points).uncovered.n == 0


def test_of_several_clusters_the_one_with_most_points_is_told() -> None:
    rng = np.random.default_rng(0)
    small, large = (
        rng.uniform(0, 0.1, (20, 3)) + np.array([4, 0, 0]),
        rng.uniform(0, 0.1, (60, 3)) + np.array([0, 0, 5]),
    )
    found = one([box()], np.concatenate([on_sides(500, 0.001), small, large]))
    assert (found.uncovered.n, found.uncovered.largest) == (80, 60)
    assert found.uncovered.place is not None
    assert found.uncovered.place[2] > 5


def test_worst_places_stand_for_their_neighbourhoods() -> None:
    near = np.array([[2.3, 1, 1], [2.3, 1.01, 1], [2.29, 1, 1]])
    found = one([box()], np.concatenate([on_sides(50, 0.001), near, [[1, 1, 4.2]]]))
    assert [far.place for far in found.worst[:2]] == [(2.3, 1.0, 1.0), (1.0, 1.0, 4.2)]
    assert [far.face for far in found.worst[:2]] == [1, 5]  # of the six sides, in the order of the file
    assert len(found.worst) <= 10


def test_another_object_is_told_as_something_else() -> None:
    assert one([box()], on_sides(200, 0.001) + np.array([100, 0, 0])).elsewhere
    assert one([box()], on_sides(200, 0.001) * 10).elsewhere
    assert not one([box()], on_sides(200, 0.001) + np.array([0.2, 0, 0])).elsewhere


def test_vertices_of_the_mesh_show_nothing() -> None:
    surface = ball(3)
    assert one([surface], surface.points).repeats
    assert one([surface], surface.points.astype(np.float32).astype(float)).repeats
    assert not one([surface], directions(500)).repeats


def test_a_sheet_has_no_sides_and_a_small_opening_takes_none_away() -> None:
    sheet = mesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), [(0, 1, 2, 3)])
    rng = np.random.default_rng(0)
    over = np.column_stack([rng.uniform(0.1, 0.9, (300, 2)), rng.normal(0, 0.01, 300)])
    found = one([sheet], over)
    assert found.signs is Signs.OPEN
    assert found.mean == pytest.approx(np.abs(over[:, 2]).mean())
    whole = ball(4)
    holed = replace(whole, corners=whole.corners[3:], starts=whole.starts[:-1], group=whole.group[1:])
    assert one([holed], directions(2000) * 0.99).signs is Signs.NEARLY
    assert one([holed], directions(2000) * 0.99).mean == pytest.approx(
        one([whole], directions(2000) * 0.99).mean, abs=1e-4
    )
    far = one([sheet], over + np.array([0, 0, 5]))
    assert far.signs is Signs.OPEN  # nothing near it shows on which side places are


def test_a_surface_that_looks_inward_has_the_same_inside() -> None:
    surface = box()
    turned = replace(surface, corners=surface.corners.reshape(-1, 4)[:, ::-1].ravel())
    assert one([turned], on_sides(100, -0.01)).mean == pytest.approx(-0.01)


def test_seams_of_texture_open_nothing() -> None:
    surface = ball(3)
    split = replace(surface, points=surface.points[surface.corners], corners=np.arange(len(surface.corners)))
    assert one([split], directions(300) * 0.99).signs is Signs.CLOSED


def test_a_reference_shows_every_mesh_together_or_the_one_that_it_names() -> None:
    left, right = box(), replace(box(shift=np.array([5.0, 0, 0])), path="outro.ply")
    points = np.concatenate([on_sides(100, 0.004), on_sides(100, 0.004) + np.array([5, 0, 0])])
    together = one([left, right], points)
    assert (together.rms, together.meshes, together.near) == (
        pytest.approx(0.004), ("busto.ply", "outro.ply"), ("busto.ply", "outro.ply")
    )  # fmt: skip
    alone = one([left, right], points, mesh="outro.ply")
    assert (alone.meshes, alone.uncovered.n) == (("outro.ply",), 100)
    assert one([left, right], points[:100]).near == ("busto.ply",)
    assert one([left, right], points[:102]).near == ("busto.ply",)
    assert one([left, right], points[:103]).near == ("busto.ply", "outro.ply")
