# SPDX-License-Identifier: MIT
"""``report.html``: one file for people, offline, printable, in both languages."""

import base64
import hashlib
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from foparq.findings.table import Severity
from foparq.model.items import Role
from foparq.model.plane import Plane
from foparq.report.contract import contract_facts
from foparq.report.page.bar import scale_bar
from foparq.report.page.breaks import breakable
from foparq.report.page.clouds import CloudView, cloud_views
from foparq.report.page.completeness import CompletenessView, FeatureNumber, completeness_view, feature_numbers
from foparq.report.page.coverage import LookedAt, coverage
from foparq.report.page.drawing import GROUPS, Picture, picture_of
from foparq.report.page.findings import FIRST, GroupView, Listing, group_view, listing_of, shown_rows
from foparq.report.page.marks import MarkView, mark_views
from foparq.report.page.meshes.figure import MeshFigure, MeshFigureView, mesh_figures, mesh_view
from foparq.report.page.plate_views import PlateView, on_paper, plate_view
from foparq.report.page.plates import Plates, plates_of
from foparq.report.page.residuals import ResidualsView, Vector, residual_views, vectors
from foparq.report.page.tables import ElementView, Headline, InputView, element_views, headline, input_views
from foparq.report.record import AuditRecord
from foparq.report.sentences import class_word
from foparq.report.templates import environment, shipped_text
from foparq.report.words import LANGUAGES, MINUS, Words, printable

_SPACE = ("vendor/three.min.js", "solid.js")  #: scripts of meshes; page.js, which follows marks, comes last
_ALONG = 1e-6  #: from one: a direction is that of an axis


@dataclass(frozen=True, slots=True, kw_only=True)
class FigureView:
    """One drawing in one language."""

    picture: Picture
    file: str
    about: str
    notes: tuple[str, ...]
    marks: tuple[MarkView, ...]
    on_paper: str  #: which plates bear the numbers of the marks, and how many have none; ``""`` without marks
    vectors: tuple[Vector, ...]  #: differences of the checkpoints, enlarged
    numbers: tuple[FeatureNumber, ...]  #: of features that a person has to count
    bar: tuple[float, str]  #: length of the scale bar as a share of the width, and its lettering


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """The whole page in one language."""

    words: Words
    language: str
    suffix: str  #: of anchors
    headline: Headline
    contract: tuple[tuple[str, str], ...]  #: what the manifest states of it, name and value
    elements: tuple[ElementView, ...]
    residuals: tuple[ResidualsView, ...]
    clouds: tuple[CloudView, ...]  #: references against meshes
    completeness: CompletenessView | None  #: none where nothing was compared
    figures: tuple[FigureView, ...]
    solids: tuple[MeshFigureView, ...]
    plates: tuple[PlateView, ...]
    faults: tuple[GroupView, ...]
    notes: tuple[GroupView, ...]
    coverage: LookedAt
    methods: bool  #: there are parameters to tell
    inputs: tuple[InputView, ...]


def write_page(record: AuditRecord, path: Path) -> None:
    """Write ``report.html``.

    Parameters
    ----------
    record : AuditRecord
        The page is complete in both languages; that of the record is shown first.

    Notes
    -----
    The same record gives the same bytes.
    """
    path.write_text(page(record), encoding="utf-8", newline="\n")


def page(record: AuditRecord) -> str:
    """The page as text."""
    # Hostile coordinates overflow; what comes of them is clipped or not drawn.
    with np.errstate(over="ignore", invalid="ignore"):
        listing = listing_of(record)
        shown = shown_rows(listing.groups)
        pictures = tuple(
            picture_of(drawing, number, record.findings, shown, record.quality)
            for number, drawing in enumerate(record.delivery.drawings, start=1)
        )
        plates = plates_of(listing, pictures)
        solids = mesh_figures(record.delivery.meshes, listing)
    placed = {solid.mesh.path: solid.number for solid in solids if solid.pictures}
    listing = replace(listing, on_plate=plates.of_row, solids=placed)
    languages = sorted(LANGUAGES, key=lambda language: language != record.language)
    views = [_view(record, listing, pictures, plates, solids, language, languages[0]) for language in languages]
    return (
        environment("page")
        .get_template("page.html.j2")
        .render(
            record=record,
            views=views,
            pictures=pictures,
            plates=plates.plates,
            plated={plate.picture.number for plate in plates.plates},
            first=FIRST,
            severities=[severity.value for severity in Severity],
            groups=GROUPS,
            solids=solids,
            scripts=(*(_SPACE if placed else ()), "page.js"),
            hash_of=_hash,
            printable=printable,
            breakable=breakable,
            class_word=class_word,
        )
    )


def _hash(name: str) -> str:
    digest = hashlib.sha256(str(shipped_text("page", name)).encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"


def _view(
    record: AuditRecord, listing: Listing, pictures: tuple[Picture, ...], plates: Plates,
    solids: tuple[MeshFigure, ...], language: str, first: str,
) -> View:  # fmt: skip
    words = Words(language)
    elements, looked_at = element_views(words, record), coverage(words, record, pictures)
    suffix = "" if language == first else f"--{language[:2]}"
    view = partial(group_view, words, listing, suffix=suffix)
    return View(
        words=words,
        language=language,
        suffix=suffix,
        contract=contract_facts(words, record),
        headline=headline(words, record, listing.groups, suffix),
        elements=elements,
        residuals=residual_views(words, record, pictures),
        clouds=cloud_views(words, record.quality),
        completeness=completeness_view(words, record.quality),
        figures=tuple(_figure(words, record, listing, picture, plates, suffix) for picture in pictures),
        solids=tuple(mesh_view(words, solid) for solid in solids),
        plates=tuple(plate_view(words, plate) for plate in plates.plates),
        faults=tuple(view(group) for group in listing.groups if group.severity != Severity.NOTE),
        notes=tuple(view(group) for group in listing.groups if group.severity == Severity.NOTE),
        coverage=looked_at,
        methods=bool(elements or looked_at.tolerances),
        inputs=input_views(words, record.delivery.sources),
    )


def _figure(
    words: Words, record: AuditRecord, listing: Listing, picture: Picture, plates: Plates, suffix: str
) -> FigureView:
    drawing = picture.drawing
    about: dict[str, Any] = {
        "items": words.count(len(drawing.items)),
        "layers": words.count(len(picture.layers)),
        "plane": "xy" if drawing.plane.name == "assumed" else drawing.plane.name,
        "unit": drawing.unit.name or words("report.drawing.unit-unknown"),
        "facade": drawing.facade,
    }
    marks = mark_views(words, listing, picture, suffix)
    arrows, factor = vectors(words, record, picture)
    notes = _notes(words, listing, picture, len(marks))
    bar = scale_bar(words, picture, picture.width)
    if arrows:
        true = bar[0] * picture.width * picture.quantum / factor
        told = words("report.residuals.vectors", factor=words.count(factor), length=bar[1], true=(true, "m"))
        notes = (*notes, told)
    notes = (*notes, facing(words, drawing.plane))
    numbers = feature_numbers(drawing.path, record.quality, picture.cells)
    if numbers:
        notes = (*notes, words("report.drawing.numbers"))
    return FigureView(
        picture=picture,
        file=printable(drawing.path),
        marks=marks,
        on_paper=on_paper(words, plates, picture),
        vectors=arrows,
        numbers=numbers,
        bar=bar,
        about=words("report.drawing.about-facade" if drawing.facade else "report.drawing.about", **about),
        notes=notes,
    )


def _notes(words: Words, listing: Listing, picture: Picture, marked: int) -> tuple[str, ...]:
    listed = [
        row for group in listing.groups for row in group.shown if listing.findings.source[row] == picture.drawing.path
    ]
    notes = [words(f"report.drawing.{picture.form}"), *_drawn_otherwise(words, picture)]
    if picture.culprits:
        notes.append(words("report.drawing.culprits"))
    if picture.bands or picture.areas:
        notes.append(words("report.drawing.spans"))
    left_out = picture.form == "toned"
    counted = {
        "hidden-left-out" if left_out else "hidden": picture.hidden,
        "paper": picture.paper,
        "outside": picture.outside,
        "unmarked": len(listed) - marked,
    }
    notes.extend(
        words(f"report.drawing.{name}", count=words.count(number)) for name, number in counted.items() if number
    )
    if any(group.found > len(group.shown) for group in listing.groups):
        notes.append(words("report.drawing.unlisted"))
    return tuple(notes)


def _drawn_otherwise(words: Words, picture: Picture) -> list[str]:
    """What rules look at, and what of model space stands as a point only, without its lettering."""
    items = picture.drawing.items
    shown = ~items.paper
    checked = int(np.count_nonzero(shown & np.isin(items.role, [Role.LINE, Role.AREA])))
    lettering = int(np.count_nonzero(shown & (items.role == Role.ANNOTATION)))
    others = int(np.count_nonzero(shown)) - checked - lettering
    told = [
        words("report.drawing.kinds", checked=words.count(checked), lettering=words.count(lettering), others=others)
    ]
    if lettering:
        told.append(words("report.drawing.lettering"))
    return told


def facing(words: Words, plane: Plane) -> str:
    """Which axes of the file go right and up, and which way one looks: ``"x to the right, z up; towards y"``."""
    right, up, back = plane.frame.tolist()
    told = {"right": _axis(words, right), "up": _axis(words, up), "away": _axis(words, [-part for part in back])}
    return words("report.drawing.facing", **told)


def _axis(words: Words, along: list[float]) -> str:
    """Direction by the axis it runs along, else its parts."""
    for name, part in zip("xyz", along, strict=True):
        if abs(abs(part) - 1.0) < _ALONG:
            return f"{'+' if part > 0 else MINUS}{name}"
    return "({})".format("; ".join(words.number(part, 2) for part in along))
