# SPDX-License-Identifier: MIT
"""Surfaces of triangles with faults planted in them: how many, of which rule, where and of what size is known."""

from collections import defaultdict
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import box, plate, sphere
from tests.mesh.parts import cut

from foparq.columns import Coordinates

#: of a face that stands on the surface, metres
HEIGHT = 0.02
#: where pieces lie that hang together with nothing, metres
FAR = 40.0


@dataclass
class Planted:
    """A surface under way, and what a person knows to be wrong with it."""

    points: list[list[float]]
    faces: list[list[int]]
    closed: bool
    #: by code of the rule: place, and size; a size of ``None`` is not asked for
    known: dict[str, list[tuple[Any, float | None]]] = field(default_factory=lambda: defaultdict(list))

    def add(self, *places: Any) -> list[int]:
        """Numbers of new vertices."""
        count = len(self.points)
        self.points += [np.asarray(place, dtype=float).tolist() for place in places]
        return list(range(count, count + len(places)))

    def at(self, vertices: list[int]) -> Coordinates:
        return np.array([self.points[vertex] for vertex in vertices])

    def tell(self, code: str, place: Any, size: float | None = None) -> None:
        self.known[code].append((place, size))

    def tell_piece(self, face: list[int]) -> None:
        """A face that hangs together with nothing: a small piece, and a loop if the surface should be closed."""
        self.tell("MSH015", area(self.at(face)), measure(self.at(face)))
        if self.closed:
            self.tell("MSH011", ring(self.at(face)), measure(self.at(face)))

    @property
    def mesh(self) -> Mesh:
        return mesh(np.array(self.points), self.faces)


def by(place: Coordinates, x: float, y: float, z: float) -> Coordinates:
    return place + np.array([x, y, z])


def ring(places: Coordinates) -> Any:
    return shapely.LineString([*places, places[0]])


def area(places: Coordinates) -> Any:
    return shapely.Polygon(places)


def measure(places: Coordinates) -> float:
    """Area of a triangle."""
    return float(np.linalg.norm(np.cross(places[1] - places[0], places[2] - places[0])) / 2)


def bases() -> dict[str, tuple[Mesh, bool]]:
    """Sound surfaces of triangles, and whether they are closed."""
    return {
        "sphere": (sphere(3), True),
        "box": (cut(box(8)), True),
        "facade": (cut(plate(24, 18, [(3, 3), (10, 6)])), False),
    }


def planted(name: str, *, each: int, seed: int) -> Planted:
    """So many faults of every kind on one of the :func:`bases`, far from each other and from borders.

    The two openings of the facade are holes that it has anyway.
    """
    base, closed = bases()[name]
    made = Planted(base.points.tolist(), base.lists(), closed)
    if name == "facade":
        for x, z in ((3, 3), (10, 6)):
            corners = [(x, z), (x + 1, z), (x + 1, z + 1), (x, z + 1)]
            made.tell("MSH011", ring(np.array([(i * 0.5, 0, j * 0.4) for i, j in corners])), 0.2)
    kinds = [_missing, _fin, _twice, _turned, _pinched, _through, _fallen, _slit]
    sites = _sites(base, each * len(kinds), np.random.default_rng(seed))
    gone: list[int] = []
    for n, row in enumerate(sites):
        if kinds[n % len(kinds)](made, row):
            gone.append(row)
    for n in range(each):
        _alone(made, n)
        _unused(made, n)
        _on_each_other(made, n)
        _inward(made, n)
        _unusable(made, n)
    made.faces = [face for row, face in enumerate(made.faces) if row not in set(gone)]
    return made


def _sites(base: Mesh, count: int, rng: np.random.Generator) -> list[int]:
    """Faces of which no two have a neighbour in common, none of them at a border."""
    faces = base.lists()
    uses: dict[frozenset[int], int] = defaultdict(int)
    around: dict[int, set[int]] = defaultdict(set)
    for face in faces:
        for side in pairwise([*face, face[0]]):
            uses[frozenset(side)] += 1
        for vertex in face:
            around[vertex] |= set(face)
    taken = {vertex for side, n in uses.items() if n == 1 for vertex in side}
    found: list[int] = []
    for row in rng.permutation(len(faces)).tolist():
        near = set().union(*(around[vertex] for vertex in faces[row]))
        if len(found) < count and not near & taken:
            found.append(row)
            taken |= near
    assert len(found) == count, "the surface is too small"
    return found


def _normal(places: Coordinates) -> Coordinates:
    normal = np.cross(places[1] - places[0], places[2] - places[0])
    return normal / np.linalg.norm(normal)


def _missing(made: Planted, row: int) -> bool:
    places = made.at(made.faces[row])
    made.tell("MSH011", ring(places), measure(places))
    return True


def _fin(made: Planted, row: int) -> bool:
    """A third face on an edge, upright: its other two sides are a chain that bounds no area."""
    a, b, _ = made.faces[row]
    places = made.at(made.faces[row])
    (apex,) = made.add((places[0] + places[1]) / 2 + HEIGHT * _normal(places))
    made.faces.append([b, a, apex])
    made.tell("MSH012", shapely.LineString(places[:2]), float(np.linalg.norm(places[1] - places[0])))
    # What would close the two sides is the face itself.
    places = made.at([a, apex, b])
    made.tell("MSH011", shapely.LineString(places), measure(places))
    return False


def _twice(made: Planted, row: int) -> bool:
    """A face twice: at each of its edges three faces meet."""
    a, b, c = made.faces[row]
    places = made.at([a, b, c])
    made.faces.append([b, c, a])
    made.tell("MSH021", area(places), measure(places))
    for side in pairwise([0, 1, 2, 0]):
        made.tell("MSH012", shapely.LineString(places[list(side)]))
    return False


def _turned(made: Planted, row: int) -> bool:
    made.faces[row] = made.faces[row][::-1]
    made.tell("MSH014", area(made.at(made.faces[row])), 1.0)
    return False


def _pinched(made: Planted, row: int) -> bool:
    """A small face that stands on a vertex."""
    vertex = made.faces[row][0]
    places = made.at(made.faces[row])
    up, aside = HEIGHT * _normal(places), HEIGHT / 4 * (places[1] - places[0]) / np.linalg.norm(places[1] - places[0])
    face = [vertex, *made.add(places[0] + up, places[0] + up + aside)]
    made.faces.append(face)
    made.tell("MSH013", shapely.Point(places[0]), 2.0)
    made.tell_piece(face)
    return False


def _through(made: Planted, row: int) -> bool:
    """A small face through the middle of another: half as high above as below, a line of half its width in common."""
    places = made.at(made.faces[row])
    up, middle = HEIGHT * _normal(places), places.mean(axis=0)
    aside = HEIGHT / 2 * (places[1] - places[0]) / np.linalg.norm(places[1] - places[0])
    face = made.add(middle - up - aside, middle - up + aside, middle + up)
    made.faces.append(face)
    made.tell("MSH022", shapely.LineString([middle - aside / 2, middle + aside / 2]), HEIGHT / 2)
    made.tell_piece(face)
    return False


def _fallen(made: Planted, row: int) -> bool:
    """A face fallen in to a line: no area, and it bounds at nothing, so that it is a piece of its own."""
    a, b, _ = made.faces[row]
    places = made.at([a, a, b])
    made.faces.append([a, a, b])
    made.tell("MSH003", ring(places), float(np.linalg.norm(places[2] - places[0])))
    made.tell("MSH015", area(places), 0.0)
    return False


def _slit(made: Planted, row: int) -> bool:
    """A corner with a vertex of its own, at the same place: no fault once it is welded."""
    vertex = made.faces[row][1]
    (again,) = made.add(made.points[vertex])
    made.faces[row][1] = again
    made.tell("MSH017", shapely.Point(made.points[vertex]), 2.0)
    return False


def _alone(made: Planted, n: int) -> None:
    place = np.array([FAR + 4 * n, 0.0, 0.0])
    face = made.add(place, by(place, 0.125, 0, 0), by(place, 0, 0.125, 0.0625))
    made.faces.append(face)
    made.tell_piece(face)


def _unused(made: Planted, n: int) -> None:
    place = [FAR + 4 * n, 0.0, 8.0]
    made.add(place)
    made.tell("MSH016", shapely.Point(place), 1.0)


def _on_each_other(made: Planted, n: int) -> None:
    """A small face on a larger one, both level: exactly in one plane wherever they are shifted to."""
    place = np.array([FAR + 4 * n, 8.0, 0.0])
    large = made.add(place, by(place, 0.25, 0, 0), by(place, 0, 0.25, 0))
    small = made.add(*(by(place, x, y, 0) for x, y in ((0.0625, 0.0625), (0.125, 0.0625), (0.0625, 0.125))))
    made.faces += [large, small]
    made.tell("MSH023", area(made.at(small)), measure(made.at(small)))
    made.tell_piece(large)
    made.tell_piece(small)


def _inward(made: Planted, n: int) -> None:
    """A small tetrahedron that looks inward: the place is one of its faces."""
    place = np.array([FAR + 4 * n, 0.0, 16.0])
    a, b, c, d = made.add(place, by(place, 0.125, 0, 0), by(place, 0, 0.125, 0), by(place, 0, 0, 0.125))
    made.faces += [[a, b, c], [a, d, b], [a, c, d], [b, d, c]]
    whole = 3 * 0.125**2 / 2 + np.sqrt(3) / 4 * 0.125**2 * 2
    corners = shapely.MultiPoint(made.at([a, b, c, d]))
    made.tell("MSH014", corners, 4.0)
    made.tell("MSH015", corners, float(whole))


def _unusable(made: Planted, n: int) -> None:
    """A corner without a vertex, and a vertex without a place: far from everything, so that no rule misses the face."""
    place = np.array([FAR + 4 * n, 16.0, 0.0])
    one, two, three, four = made.add(place, by(place, 1, 0, 0), by(place, 0, 1, 0), [place[0], np.nan, 0])
    made.faces += [[one, two, 10**6], [three, three, four]]
    made.tell("MSH001", shapely.Point(place), 1.0)
    made.tell("MSH002", shapely.Point(by(place, 0, 1, 0)), 1.0)
