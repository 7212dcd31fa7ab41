# SPDX-License-Identifier: MIT
"""Deliveries of one mesh with its tables: an open head whose right answers are known by how it was made."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from tests.attacks.meshes import write_ply
from tests.mesh.files import Mesh, mesh
from tests.tools.sound import unguarded

from foparq.audit import audit
from foparq.columns import Coordinates, Index
from foparq.evaluate.quality import Element
from foparq.report.record import AuditRecord
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words

Change = Callable[[Coordinates], Coordinates]


def same(points: Coordinates) -> Coordinates:
    return points


def head(rings: int = 26, around: int = 40, *, other: bool = False) -> Mesh:
    """A closed cap over an open neck, half a metre high, with a nose and ripples: its mirror images are others."""
    fall, turn = np.linspace(0.06, 0.8 * np.pi, rings), np.linspace(0, 2 * np.pi, around, endpoint=False)
    f, t = np.meshgrid(fall, turn, indexing="ij")
    ripple = 0.02 * np.sin(5 * t) * np.sin(4 * f) if not other else 0.05 * np.cos(3 * t) * np.sin(2 * f)
    nose = 0.15 * np.exp(-((t - 1.0) ** 2 + (f - 1.4) ** 2) / 0.05)
    r = 0.25 * (1 + ripple + 0.1 * np.cos(t) + nose)
    points = np.stack([1.1 * r * np.sin(f) * np.cos(t), 0.9 * r * np.sin(f) * np.sin(t), 1.3 * r * np.cos(f)], axis=-1)
    number = np.arange(rings * around).reshape(rings, around)
    a, b = number[:-1], np.roll(number, -1, axis=1)[:-1]
    c, d = number[1:], np.roll(number, -1, axis=1)[1:]
    faces = np.concatenate([np.stack([a, c, b], axis=-1), np.stack([b, c, d], axis=-1)]).reshape(-1, 3).tolist()
    top = rings * around
    faces += [[top, k, (k + 1) % around] for k in range(around)]
    flat = points.reshape(-1, 3)
    return mesh(np.vstack([flat, flat[:around].mean(axis=0)]), faces)


def triangles(of: Mesh) -> Coordinates:
    corners: Coordinates = of.points[of.corners.reshape(-1, 3)]
    return corners


@dataclass(frozen=True, kw_only=True)
class Delivery:
    """What is delivered; all that is left out is sound."""

    surface: Callable[[], Mesh] = head
    surveyed: Callable[[], Mesh] = head  #: that the tables were made from
    points: Change = same  #: of the mesh as delivered
    told: Change = same  #: of delivered coordinates
    names: bool = True  #: delivered coordinates are given at all
    places: Change = same  #: of the feature list
    ends: Change = same  #: of distances
    profile: str = "et-doc-foparq-a"
    unit: str = "m"
    spacing: str = "30 mm"
    more: str = ""  #: of the manifest
    tables: Sequence[str] = ("checkpoints", "distances", "features")
    decimals: int = 5
    n: int = 12
    bare: int = 0  #: places of the list that are off the surface
    tol: str = "0.003"  #: of every place
    times: int = 1  #: how often what is there is listed
    rows: tuple[str, ...] = ()  #: further rows of the list
    listed: int = 5  #: decimals of the places of the list
    file: str = "busto.ply"
    save: Callable[[Mesh, Path], object] = write_ply


def write(made: Delivery, folder: Path) -> Path:
    """Files of a delivery; surveyed values differ by a millimetre at random, distances by half of that."""
    folder.mkdir(parents=True)
    truth, rng = triangles(made.surveyed()), np.random.default_rng(3)
    pick = rng.choice(len(truth), made.n, replace=False)
    at = np.einsum("ij,ijk->ik", rng.dirichlet([1.0, 1.0, 1.0], made.n), truth[pick])
    surveyed, told = at + rng.normal(0, 0.001, at.shape), made.told(at)
    made.save(replace_points(made.surface(), made.points), folder / made.file)
    manifest = [
        f'[delivery]\ntitle = "Busto"\nprofile = "{made.profile}"\nscale = "1:10"\n',
        f'[[mesh]]\npath = "{made.file}"\nunit = "{made.unit}"\nclosed = false\n',
    ]
    if "checkpoints" in made.tables:
        rows = [[f"P{k}", *numbers(surveyed[k], 4), *(numbers(told[k], made.decimals))] for k in range(made.n)]
        head_line = ["id", "x", "y", "z", "xd", "yd", "zd"]
        if not made.names:
            rows, head_line = [row[:4] for row in rows], head_line[:4]
        table(folder / "pontos.csv", head_line, rows)
        manifest.append('[checkpoints]\npath = "pontos.csv"\nsurvey_sd = "0.5 mm"\n')
    if "distances" in made.tables:
        table(
            folder / "distancias.csv",
            ["id", "x1", "y1", "z1", "x2", "y2", "z2", "measured", "delivered"],
            distances(made, at, rng),
        )
        manifest.append('[distances]\npath = "distancias.csv"\nsurvey_sd = "0.5 mm"\n')
    if "features" in made.tables:
        places = truth.mean(axis=1)
        out = places[: made.bare] - places.mean(axis=0)
        places[: made.bare] += 0.02 * out / np.linalg.norm(out, axis=1, keepdims=True)
        places = made.places(places)
        every = [*enumerate(places), *(list(enumerate(places))[made.bare :] * (made.times - 1))]
        told = [numbers(place, made.listed) for _, place in every]
        rows = [[f"F{k}", "relief", *place, made.tol, "required"] for k, place in enumerate(told)]
        rows += [row.split(",") for row in made.rows]
        table(folder / "feicoes.csv", ["id", "class", "x", "y", "z", "tol", "use"], rows)
        spacing = f'spacing = "{made.spacing}"\n' if made.spacing else ""
        manifest.append(f'[features]\npath = "feicoes.csv"\n{spacing}')
    (folder / "delivery.toml").write_text("".join([*manifest, made.more]), encoding="utf-8")
    return folder


def replace_points(of: Mesh, change: Change) -> Mesh:
    return of._replace(points=change(of.points))


def distances(made: Delivery, at: Coordinates, rng: np.random.Generator) -> list[list[str]]:
    """Ends, measured and delivered lengths of twelve pairs of points that are not near each other."""
    pairs = [(i, j) for i in range(made.n) for j in range(i) if np.linalg.norm(at[i] - at[j]) > 0.2][:12]
    rows = []
    for k, (i, j) in enumerate(pairs):
        length = float(np.linalg.norm(at[i] - at[j]))
        ends = made.ends(at[[i, j]])
        measured = length + rng.normal(0, 0.0008)
        rows.append([f"D{k}", *numbers(ends.ravel(), made.decimals), f"{measured:.4f}", f"{length:.4f}"])
    return rows


def numbers(values: Sequence[float] | Coordinates, decimals: int) -> list[str]:
    return [f"{value:.{decimals}f}" for value in values]


def table(path: Path, head_line: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    path.write_text("\n".join(",".join(row) for row in [head_line, *rows]) + "\n", encoding="utf-8")


@dataclass(frozen=True)
class Answer:
    """What was said."""

    record: AuditRecord

    @property
    def verdict(self) -> str:
        return str(self.record.quality.verdict)

    @property
    def why(self) -> str:
        """All sentences of the verdict."""
        quality, words = self.record.quality, Words("en")
        return "\n".join(reason_sentence(words, reason) for reason in (*quality.why, *quality.remarks))

    def element(self, of: str) -> Element:
        return next(one for one in self.record.quality.elements if one.id == of)

    def open(self) -> set[str]:
        """Ids of required elements that do not pass."""
        return {one.id for one in self.record.quality.elements if one.required and one.status not in _SETTLED}


_SETTLED = {"pass", "not-applicable"}


def answer(made: Delivery, folder: Path) -> Answer:
    with unguarded():
        return Answer(audit(write(made, folder)).record)


def without(of: Mesh, faces: Index) -> Mesh:
    kept = np.delete(np.arange(of.faces), faces)
    return mesh(of.points, of.corners.reshape(-1, 3)[kept].tolist())


def added(of: Mesh, points: Coordinates, faces: Sequence[Sequence[int]]) -> Mesh:
    more = [[corner + len(of.points) for corner in face] for face in faces]
    return mesh(np.vstack([of.points, points]), [*of.lists(), *more])


__all__ = ["Answer", "Delivery", "added", "answer", "head", "replace", "without"]
