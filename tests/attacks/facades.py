# SPDX-License-Identifier: MIT
"""Attacks with several drawings: evidence of one facade, and another one beside it that nobody measured."""

import shutil
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
from tests.attacks.evidence import redrawn
from tests.attacks.kinds import TOLD, attack
from tests.tools.facades import Part, facade
from tests.tools.office_files import write
from tests.tools.offices import METRES, STYLES, Office, office

#: tables that can be joined line by line
PLAIN = {
    **TOLD, "format": "dxf", "version": "R2013", "table_unit": "m", "digits": 4, "style": STYLES[0], "english": True,
    "ends_by": "checkpoints", "lettering": "", "plane": "xz",
}  # fmt: skip
_TABLES = ("pontos.csv", "distancias.csv", "feicoes.csv")


def beside(made: Office, other: Office, *, points: int | None = None, name: str = "S") -> Office:
    """A delivery with the drawing of another one beside its own, as another facade.

    Parameters
    ----------
    points : int, optional
        So many of the other's checkpoints are in the table; all of them, with its distances, if left out.
    """
    known = other.change(ids=[f"S{one}" for one in other.ids], ends=[(f"S{a}", f"S{b}") for a, b in other.ends])

    def joined(_: Office, folder: Path) -> None:
        with tempfile.TemporaryDirectory() as aside:
            there = write(known, Path(aside) / "other")
            shutil.copy(there / "fachada.dxf", folder / "sul.dxf")
            for table in _TABLES:
                rows = (there / table).read_text().splitlines()[1:]
                if table == "pontos.csv":
                    rows = rows[:points]
                elif table == "distancias.csv":
                    rows = [f"S{row}" for row in rows] if points is None else []
                else:
                    rows = [f"S{row}".replace(";N;", f";{name};") for row in rows]
                with (folder / table).open("a") as file:
                    file.write("".join(f"{row}\r\n" for row in rows))

    classes = {layer: kind for kind, layer in other.layers.items() if kind != "wall"}
    second = {"path": "sul.dxf", "unit": other.unit, "plane": other.plane, "facade": name, "classes": classes}
    return made.change(tamper=(*made.tamper, joined)).state("drawings", second=second)


def _like(made: Office, seed: int, **changes: object) -> Office:
    """Another sound delivery of the same office."""
    habits = {name: getattr(made, name) for name in ("plane", "unit", "scale", "blocks", "layers")}
    return office(seed, **{**PLAIN, **habits, "n": 9, **changes}).change(
        survey_sd=made.survey_sd, distance_sd=made.distance_sd
    )


def _moved(made: Office, step: float) -> Office:
    """The same facade elsewhere, with its points."""
    by = np.array([step, 0.0, 0.0])
    return made.change(
        origin=made.origin + by, surveyed=made.surveyed + by, drawn=made.drawn + by,
        by_id=[replace(mark, place=mark.place + by) for mark in made.by_id],
    )  # fmt: skip


@attack("two facades, each with its points", verdict="accepted", office=PLAIN)
def _two(made: Office, rng: np.random.Generator) -> Office:
    return beside(made, _resurveyed(_like(made, int(rng.integers(5000, 6000))), rng))


def _resurveyed(made: Office, rng: np.random.Generator) -> Office:
    """Other errors without a mean: those of the first drawing once more would be a trend."""
    errors = np.column_stack([rng.permutation(np.resize([-1.0, 1.0, 0.5, -0.5], len(made.ids))) for _ in range(3)])
    surveyed = made.drawn + made.survey_sd * (errors - errors.mean(axis=0))
    return made.change(
        surveyed=surveyed, measured=made.lengths + made.distance_sd * np.resize([1.0, -1.0], len(made.lengths))
    )


@attack("a second facade of another building without a point", "evidence.facade", office=PLAIN)
def _unmeasured(made: Office, rng: np.random.Generator) -> Office:
    return beside(made, _like(made, int(rng.integers(5000, 6000))), points=0)


@attack("a second facade with one point or two", "evidence.facade", office=PLAIN)
def _hardly(made: Office, rng: np.random.Generator) -> Office:
    return beside(made, _like(made, int(rng.integers(5000, 6000))), points=int(rng.integers(1, 3)))


@attack("the drawing a second time under another facade", "verdict.alike", office=PLAIN)
def _twice(made: Office, _: np.random.Generator) -> Office:
    return beside(made, made, points=0)


@attack("the drawing moved aside under another facade, without points", "evidence.facade", office=PLAIN)
def _aside(made: Office, rng: np.random.Generator) -> Office:
    return beside(made, _moved(made, rng.uniform(30, 90)), points=0)


@attack("the drawing moved aside under another facade, with its points", "verdict.alike", office=PLAIN)
def _aside_with_points(made: Office, rng: np.random.Generator) -> Office:
    return beside(made, _resurveyed(_moved(made, rng.uniform(30, 90)), rng))


@attack("the drawing moved aside, and a tenth of it changed", "verdict.alike", office=PLAIN)
def _nearly(made: Office, rng: np.random.Generator) -> Office:
    other = _moved(made, rng.uniform(30, 90))
    parts: list[Part] = []
    for number, part in enumerate(other.facade.parts):
        step = np.array([0.0, 0.013 if number % 20 == 7 else 0.0, 0.0])
        ring = tuple(map(tuple, (np.array(part.ring) + step).tolist()))
        inner = tuple(tuple(map(tuple, (np.array(line) + step).tolist())) for line in part.inner)
        parts.append(replace(part, ring=ring, inner=inner))  # type: ignore[arg-type]
    return beside(made, other.change(facade=replace(other.facade, parts=parts)), points=0)


@attack("the drawing mirrored under another facade", "verdict.alike-mirrored", office=PLAIN)
def _mirrored(made: Office, _: np.random.Generator) -> Office:
    width = made.facade.width
    return beside(made, redrawn(made, lambda spots: np.array([width + 40, 0, 0]) + spots * [-1, 1, 1]), points=0)


Helper = Callable[[ezdxf.document.Drawing, Office], None]


def helper(made: Office, draw: Helper, **said: str) -> Office:
    """A further drawing in the plane of the first."""

    def drawn(one: Office, folder: Path) -> None:
        document = ezdxf.new(one.version)
        document.header["$INSUNITS"] = {"m": 6, "mm": 4, "cm": 5}[one.unit]
        draw(document, one)
        document.saveas(folder / "apoio.dxf")

    second = {"path": "apoio.dxf", "unit": made.unit, "plane": made.plane, **said}
    return made.change(tamper=(*made.tamper, drawn)).state("drawings", second=second)


def _through(document: ezdxf.document.Drawing, made: Office) -> None:
    """A line through all checkpoints."""
    document.modelspace().add_polyline3d([tuple(spot) for spot in made.drawn / METRES[made.unit]])


@attack("another building beside a nameless drawing through the points", "evidence.facade", office=PLAIN)
def _nameless(made: Office, rng: np.random.Generator) -> Office:
    return helper(made.change(facade=facade(rng, relief=not made.flat)), _through)


def _strokes(document: ezdxf.document.Drawing, made: Office) -> None:
    for k in range(40):
        spots = made.place([(k + 0.2, -9.0, 0.0), (k + 0.7, -9.0, 0.0)]) / METRES[made.unit]
        document.modelspace().add_line(*map(tuple, spots))


@attack("a nameless drawing of something else beside it", "evidence.unnamed", verdict="accepted", office=PLAIN)
def _plan(made: Office, _: np.random.Generator) -> Office:
    return helper(made, _strokes)


def _twofold(n: int) -> Callable[[Office, Path], None]:
    """n pairs of lines drawn twice, beside n * 2.5 sound ones."""

    def drawn(made: Office, folder: Path) -> None:
        document = ezdxf.readfile(folder / "fachada.dxf")
        for k in range(n):
            spots = made.place([(k * 0.3, -6.0, 0.0), (k * 0.3, -7.0, 0.0)]) / METRES[made.unit]
            for _ in range(2):
                document.modelspace().add_line(*map(tuple, spots), dxfattribs={"layer": "MURO"})
        document.saveas(folder / "fachada.dxf")

    return drawn


def _thousand(document: ezdxf.document.Drawing, made: Office) -> None:
    for k in range(4000):
        x, y = k % 100, k // 100
        spots = made.place([(x + 0.2, -20.0 - y, 0.0), (x + 0.7, -20.0 - y, 0.0)]) / METRES[made.unit]
        document.modelspace().add_line(*map(tuple, spots))


@attack("faults of one drawing beside thousands of sound strokes in another", "faulty.one-drawing", office=PLAIN)
def _diluted(made: Office, _: np.random.Generator) -> Office:
    faulty = made.change(tamper=(_twofold(120),))
    return helper(faulty, _thousand)


@attack("the same faults alone", "faulty.fail", verdict="rejected", office=PLAIN)
def _alone(made: Office, _: np.random.Generator) -> Office:
    return made.change(tamper=(_twofold(120),))


@attack("an empty drawing of another facade", "unseen.nothing", office=PLAIN)
def _empty(made: Office, _: np.random.Generator) -> Office:
    return helper(made, lambda *_: None, facade="S")
