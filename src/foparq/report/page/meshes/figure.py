# SPDX-License-Identifier: MIT
"""One mesh on the page: what the view in space holds of it, and what is told beside it."""

import base64
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from foparq.columns import Index, Reals
from foparq.findings.table import Findings, Severity
from foparq.model.mesh import Mesh
from foparq.report.page.bar import bar_of
from foparq.report.page.findings import Listing
from foparq.report.page.meshes.defects import Pieces, pieces_of, ranks
from foparq.report.page.meshes.pictures import LONGEST, Marks, SidePicture, pictures_of, unnumbered
from foparq.report.page.meshes.sides import up_of
from foparq.report.page.meshes.surface import STEPS, Shown, shown_of
from foparq.report.words import Words, printable

SHOWN = 12  #: meshes that are shown, in the order of the delivery
TRIANGLES = 100_000  #: of all meshes of a page
_FEWEST = 8_000  #: of each mesh, however many there are
_NARROW = 2**16  #: vertices up to which 16 bits name one


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshFigure:
    """One mesh, ready to be shown; the same in all languages."""

    mesh: Mesh
    number: int  #: from 1
    shown: Shown
    up: str  #: axis of the file that points up
    pieces: Pieces
    marks: Marks
    pictures: tuple[SidePicture, ...]
    data: dict[str, str]  #: what the script reads: numbers, and arrays as base64


@dataclass(frozen=True, slots=True, kw_only=True)
class SideView:
    """One fixed picture in one language."""

    picture: SidePicture
    title: str
    bar: float  #: length of the scale bar, pixels
    lettering: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshFigureView:
    """One mesh in one language."""

    figure: MeshFigure
    file: str
    about: str
    notes: tuple[str, ...]
    on_paper: str  #: marks without a number on any picture
    severities: dict[str, int]  #: marks of each
    sides: tuple[SideView, ...]


def mesh_figures(meshes: tuple[Mesh, ...], listing: Listing) -> tuple[MeshFigure, ...]:
    """Figures of the meshes that are shown.

    Notes
    -----
    They share ``TRIANGLES``: a page of many meshes is no larger than one of few.
    """
    most = max(TRIANGLES // max(len(meshes[:SHOWN]), 1), _FEWEST)
    return tuple(_figure(mesh, number, listing, most) for number, mesh in enumerate(meshes[:SHOWN], start=1))


def _figure(mesh: Mesh, number: int, listing: Listing, most: int) -> MeshFigure:
    shown = shown_of(mesh, most)
    pieces = pieces_of(listing.findings, mesh.path, shown)
    marks, reach = _marks(listing, mesh, shown)
    up = up_of(mesh)
    return MeshFigure(
        mesh=mesh, number=number, shown=shown, up=up, pieces=pieces, marks=marks,
        pictures=pictures_of(shown, up, pieces, marks), data=_data(mesh, shown, up, pieces, marks, reach),
    )  # fmt: skip


def _marks(listing: Listing, mesh: Mesh, shown: Shown) -> tuple[Marks, Reals]:
    """Listed findings of one mesh that have a place, the gravest first, and how far each reaches from there."""
    findings = listing.findings
    numbered = [(row, group.first + n) for group in listing.groups for n, row in enumerate(group.shown.tolist())]
    rows, numbers = np.array(numbered, dtype=np.intp).reshape(-1, 2).T
    place = shown.placed(listing.spots[rows])
    kept = (findings.source[rows] == mesh.path) & np.isfinite(place.astype(np.float32)).all(axis=1)
    kept = np.flatnonzero(kept)
    kept = kept[np.lexsort((numbers[kept], ranks(findings.severity[rows[kept]])))]
    marks = Marks(place[kept], findings.severity[rows[kept]], numbers[kept])
    return marks, _reach(findings, rows[kept], marks.place, shown)


def _reach(findings: Findings, rows: Index, place: Reals, shown: Shown) -> Reals:
    """How far (k,) findings extend from their mark along an axis."""
    points, of = shapely.get_coordinates(findings.where[rows], include_z=True, return_index=True)
    away = np.nan_to_num(np.abs(shown.placed(points) - place[of]).max(axis=1), posinf=0.0)
    reach = np.zeros(len(rows))
    np.maximum.at(reach, of, away)
    return reach


def _data(mesh: Mesh, shown: Shown, up: str, pieces: Pieces, marks: Marks, reach: Reals) -> dict[str, str]:
    wide = len(shown.steps) > _NARROW
    columns = (marks.number, ranks(marks.severity), marks.place, reach)
    return {
        "up": up,
        "cell": repr(float(shown.cell)),
        "metres": repr(float(shown.size * (mesh.unit.metres or 0.0))),  # of the longest side; 0 where nobody knows
        "wide": "yes" if wide else "",
        "steps": _packed(shown.steps, "<u2"),
        "triangles": _packed(shown.triangles, "<u4" if wide else "<u2"),
        "marks": _packed(np.column_stack(columns), "<f4"),
        **{
            name: value
            for kind, rank in (("points", pieces.point_rank), ("lines", pieces.line_rank), ("faces", pieces.face_rank))
            for name, value in _ranked(kind, getattr(pieces, kind), rank)
        },
    }


def _ranked(kind: str, places: Reals, rank: Index) -> list[tuple[str, str]]:
    """Places by rank, and how many there are of each."""
    counts = np.bincount(rank, minlength=len(Severity)).tolist()
    return [
        (kind, _packed(places[np.argsort(rank, kind="stable")], "<f4")),
        (f"{kind}-count", " ".join(map(str, counts))),
    ]


def _packed(values: NDArray[Any], kind: str) -> str:
    return base64.b64encode(values.astype(kind).tobytes()).decode("ascii")


def mesh_view(words: Words, figure: MeshFigure) -> MeshFigureView:
    """One mesh for the page."""
    mesh = figure.mesh
    about = words(
        "report.solid.about", faces=words.count(mesh.features), vertices=words.count(len(mesh.points)),
        unit=mesh.unit.name or words("report.drawing.unit-unknown"),
    )  # fmt: skip
    left = unnumbered(figure.pictures, figure.marks)
    marked = figure.marks.severity.tolist()
    return MeshFigureView(
        figure=figure, file=printable(mesh.path), about=about, notes=tuple(_notes(words, figure)),
        on_paper=words("report.solid.unnumbered", count=words.count(left)) if left and figure.pictures else "",
        severities={severity.value: marked.count(severity.value) for severity in Severity},
        sides=tuple(_side(words, figure, picture) for picture in figure.pictures),
    )  # fmt: skip


def _side(words: Words, figure: MeshFigure, picture: SidePicture) -> SideView:
    metres = figure.mesh.unit.metres
    pixel = figure.shown.size / LONGEST * (metres or 1.0)
    length, lettering = bar_of(words, picture.width * pixel, known=metres is not None)
    return SideView(
        picture=picture, title=words(f"report.solid.side-{picture.side}"), bar=round(length / pixel, 1),
        lettering=lettering,
    )  # fmt: skip


def _notes(words: Words, figure: MeshFigure) -> list[str]:
    shown, mesh, pieces = figure.shown, figure.mesh, figure.pieces
    if not len(shown.triangles):
        return [words("report.solid.empty")]
    metres, unit = mesh.unit.metres or 1.0, "u" if mesh.unit.metres is None else "m"
    step = (shown.size / STEPS / 2 * metres, unit)
    told = {"triangles": words.count(len(shown.triangles)), "faces": words.count(shown.faces), "step": step}
    form = "thinned" if shown.thinned else "simplified" if shown.cell else "exact"
    notes = [words(f"report.solid.{form}", **told, cell=(shown.cell * shown.size * metres, unit))]
    notes.append(words("report.solid.inner"))
    origin = "stated" if mesh.up else "format" if mesh.reading.up == figure.up else "assumed"
    notes.append(words(f"report.solid.up-{origin}", axis=figure.up))
    if pieces.drawn < pieces.found:
        notes.append(
            words("report.solid.first", drawn=words.count(pieces.drawn), found=words.count(pieces.found))
        )  # fmt: skip
    if len(figure.marks.number) < pieces.found:
        notes.append(words("report.drawing.unlisted"))
    counted = {"cut": pieces.cut, "strays": shown.strays, "unusable": mesh.features - shown.faces}
    notes.extend(words(f"report.solid.{name}", count=words.count(number)) for name, number in counted.items() if number)
    return notes
