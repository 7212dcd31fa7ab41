# SPDX-License-Identifier: MIT
"""Plates: what is printed of a drawing, so that every number of the list can be found on paper.

The first plate of a drawing is its overview. Where the numbers have no room on it, it shows the frames of further
plates, its details, and every number stands on one of those.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from foparq.columns import Flags, Index, Reals, Texts
from foparq.report.page.drawing import Picture
from foparq.report.page.findings import FIRST, Listing
from foparq.report.page.inking import NOTHING, Ink, covered, framed, inked, signs_of

WIDE, HIGH = (269.0, 155.0), (182.0, 225.0)  #: mm: the largest detail on an A4 sheet, lying and standing
_FIRST_WIDE, _FIRST_HIGH = (269.0, 115.0), (182.0, 195.0)  #: mm: the same of an overview, which a heading may precede
MOST = 60  #: details of all drawings
_FEW = 12  #: numbers that an overview may bear itself
_EACH = (24, 60)  #: numbers of a detail: as a rule, and where there are many
_SHARED = 40  #: details over which many numbers are shared out
_MARGIN = 0.08  #: of the extent of its marks, on each side of a detail
_ENLARGED = (2.0, 40.0)  #: how many times a detail is enlarged: at least, and at most
_GAP = 0.3  #: of the extent: marks this far apart are groups of their own
_CROWDED = 3.0  #: mm between marks that are hard to tell apart
_LOWEST = 18_000.0  #: square millimetres of a detail, at least: room for its numbers, and two fit on a lying sheet
_FLATTEST = 0.12  #: of an overview


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate:
    """One printed picture. A cell is a cell of the picture of its drawing."""

    number: int  #: from 1, over all drawings
    picture: Picture
    overview: int  #: number of the plate that it is a detail of; its own of an overview
    window: tuple[int, int, int, int]  #: left, top, width, height in cells
    unit: float  #: cells in a millimetre of paper
    magnified: float  #: how many times larger than the overview
    wide: bool  #: on a lying sheet
    outside: bool  #: beside the overview: what it shows lies far from the linework
    further: bool  #: printed with all rows of the list only
    first: Ink  #: of the rows that are printed always
    rest: Ink  #: of the others


@dataclass(frozen=True, slots=True, kw_only=True)
class Plates:
    """All plates, and where the findings stand on them."""

    plates: tuple[Plate, ...]
    of_row: dict[int, int]  #: row of the findings to the plate with its number
    unplaced: dict[str, int]  #: marks of a drawing that stand on no plate


@dataclass(frozen=True, slots=True)
class _Marks:
    """n marks of one drawing, in the order of their numbers."""

    rows: Index
    numbers: Index
    spots: Reals  #: (n, 2) cells
    severity: Texts
    first: Flags  #: in the rows that are printed always

    def take(self, wanted: Index) -> "_Marks":
        return _Marks(*(getattr(self, name)[wanted] for name in ("rows", "numbers", "spots", "severity", "first")))


@dataclass(frozen=True, slots=True)
class _Sheet:
    """A window on the drawing and the marks whose numbers it bears."""

    window: Reals  #: (4,) left, top, width, height in cells
    unit: float
    marks: Index


def plates_of(listing: Listing, pictures: Sequence[Picture]) -> Plates:
    """Plates of all drawings that have marks.

    Every listed finding with a place stands, with the number of its row, on one plate: the overview of its drawing, or
    one of its details. Details hold up to 24 numbers; up to 60 where more than 960 findings are listed. They are cut
    where the gaps between marks are widest, each at least twice as large as the overview. There are at most ``MOST``:
    first those of the rows that are printed always. The same findings give the same plates.
    """
    marks = [_marks(listing, picture) for picture in pictures]
    each = int(np.clip(np.ceil(sum(len(one.rows) for one in marks) / _SHARED), *_EACH))
    overviews = [_overview(picture, one) for picture, one in zip(pictures, marks, strict=True)]
    room = MOST
    early: list[list[_Sheet]] = []
    later: list[list[_Sheet]] = []
    for one, overview in zip(marks, overviews, strict=True):
        wanted = np.flatnonzero(one.first) if not len(overview.marks) else overview.marks[:0]
        early.append(_joined(one, _details(one, overview, wanted, each, room), each))
        room -= len(early[-1])
    for one, overview, known in zip(marks, overviews, early, strict=True):
        held = np.concatenate([overview.marks, *(sheet.marks for sheet in known)])
        later.append(_details(one, overview, np.setdiff1d(np.arange(len(one.rows)), held), each, room))
        room -= len(later[-1])
    plates: list[Plate] = []
    of_row: dict[int, int] = {}
    unplaced: dict[str, int] = {}
    for n, (picture, one) in enumerate(zip(pictures, marks, strict=True)):
        made = _bound(picture, one, overviews[n], early[n], later[n], len(plates) + 1) if len(one.rows) else []
        plates.extend(plate for plate, _ in made)
        borne = {row: plate.number for plate, sheet in made for row in one.rows[sheet.marks].tolist()}
        unplaced[picture.drawing.path] = len(one.rows) - len(borne)
        of_row |= borne
    return Plates(plates=tuple(plates), of_row=of_row, unplaced=unplaced)


def _marks(listing: Listing, picture: Picture) -> _Marks:
    numbered = [
        (group.first + n, row, n < FIRST) for group in listing.groups for n, row in enumerate(group.shown.tolist())
    ]
    numbers, rows, first = (np.array(column) for column in zip(*numbered, strict=True)) if numbered else ([], [], [])
    numbers, rows = np.asarray(numbers, dtype=np.intp), np.asarray(rows, dtype=np.intp)
    mine = listing.findings.source[rows] == picture.drawing.path
    mine &= np.isfinite(listing.sheet[rows]).all(axis=1)
    return _Marks(
        rows[mine],
        numbers[mine],
        picture.cells(listing.sheet[rows[mine]]),
        listing.findings.severity[rows[mine]],
        np.asarray(first, dtype=bool)[mine],
    )


def _overview(picture: Picture, marks: _Marks) -> _Sheet:
    """The visible linework with a margin, of a bounded shape; it bears all numbers if each stands beside its mark."""
    low, high = picture.extent
    box = np.array([[0.0, 0.0], [picture.width, picture.height]])
    if (high > low).any():
        box = np.sort(picture.cells(picture.extent), axis=0)
    size = (box[1] - box[0]) * 1.06
    size = np.maximum(size, max(float(size.max()) * _FLATTEST, 10.0))
    corner = box.mean(axis=0) - size / 2
    unit = float((size / (_FIRST_WIDE if size[0] >= size[1] else _FIRST_HIGH)).max())
    sheet = _Sheet(np.array([*corner, *size]), unit, np.empty(0, dtype=np.intp))
    whole = replace(sheet, marks=np.arange(len(marks.rows)))
    few = len(marks.rows) <= _FEW and _holds(sheet, marks.spots).all()
    return whole if few and _inked(marks, whole).near else sheet


def _is_wide(overview: _Sheet) -> bool:
    return bool(overview.window[2] >= overview.window[3])


def _meets(overview: _Sheet, sheet: _Sheet) -> bool:
    """Whether a detail shows a part of the overview."""
    ends = [np.array([one.window[:2], one.window[:2] + one.window[2:]]) for one in (overview, sheet)]
    return bool((np.maximum(ends[0][0], ends[1][0]) < np.minimum(ends[0][1], ends[1][1])).all())


def _holds(sheet: _Sheet, spots: Reals) -> Flags:
    corner, size = sheet.window[:2], sheet.window[2:]
    edge = 2 * sheet.unit
    inside: Flags = np.all((spots >= corner + edge) & (spots <= corner + size - edge), axis=1)
    return inside


def _details(marks: _Marks, overview: _Sheet, wanted: Index, each: int, room: int) -> list[_Sheet]:
    """At most ``room`` details for the wanted marks, from left to right."""
    if not len(wanted) or room <= 0:
        return []
    paper = np.array(WIDE if _is_wide(overview) else HIGH)
    twice = overview.unit / _ENLARGED[0]
    for largest, grouped in ((twice, True), (twice, False), (np.inf, False)):
        parts = list(cut(marks.spots, wanted, each, largest, paper, grouped=grouped))
        if len(parts) <= room:
            break
    sheets = [_window(marks.spots[part], part, overview, paper) for part in parts]
    kept = sorted(sheets, key=lambda sheet: int(sheet.marks.min()))[:room]
    return sorted(kept, key=lambda sheet: (*(sheet.window[:2] + sheet.window[2:] / 2).tolist(), int(sheet.marks.min())))


def _joined(marks: _Marks, sheets: Sequence[_Sheet], each: int) -> list[_Sheet]:
    """The same sheets with such marks of the rest as lie on them, while they have room."""
    free = ~marks.first
    made = []
    for sheet in sheets:
        more = np.flatnonzero(free & _holds(sheet, marks.spots))[: max(each - len(sheet.marks), 0)]
        free[more] = False
        made.append(replace(sheet, marks=np.concatenate([sheet.marks, more])))
    return made


def cut(spots: Reals, rows: Index, most: int, largest: float, paper: Reals, *, grouped: bool = True) -> Iterator[Index]:
    """Parts of marks, each of at most ``most`` and on a window of at most ``largest`` cells a millimetre.

    Parameters
    ----------
    spots : (n, 2) cells
    rows : (k,) int
        The marks to part.
    paper : (2,) mm
        Width and height of a sheet.
    grouped : bool
        Groups of marks far from each other get parts of their own where marks would crowd or a cut is due. Where not,
        a cut that is due for number alone makes no more parts than needed; the one through the widest gap is taken.
    """
    extent = np.ptp(spots[rows], axis=0) * (1 + 2 * _MARGIN) / paper
    too_large, too_many = bool(extent.max() > largest), len(rows) > most
    axis = int(np.argmax(extent))
    order = rows[np.argsort(spots[rows, axis], kind="stable")]
    along = spots[order, axis]
    gaps = np.diff(along)
    groups = grouped and bool(gaps.max(initial=0.0) > _GAP * (along[-1] - along[0]))
    if not (too_many or too_large or (groups and _crowded(spots[rows], extent.max()))):
        yield rows
        return
    after = np.arange(1, len(rows))  # how many marks are left of a cut
    if not groups:
        allowed = _few(after, len(rows), most)
        if too_large:
            low, high = along[0] + np.array([0.25, 0.75]) * (along[-1] - along[0])
            middle = (along[:-1] <= high) & (along[1:] >= low)
            allowed = middle & allowed if np.any(middle & allowed) else middle
        gaps = np.where(allowed, gaps, -1.0)
    widest = after[gaps == gaps.max()]
    at = int(widest[np.argmin(np.abs(widest - len(rows) / 2))])
    for part in (order[:at], order[at:]):
        yield from cut(spots, np.sort(part), most, largest, paper, grouped=grouped)


def _few(after: Index, number: int, most: int) -> Flags:
    """Cuts that make no more parts than the number of marks needs."""
    parts = -(-after // most) - (-(number - after) // most)
    least: Flags = parts <= -(-number // most)
    return least


def _crowded(spots: Reals, unit: float) -> bool:
    """Whether marks in different places would be hard to tell apart."""
    places = np.unique(spots, axis=0)
    away = np.hypot(*(places[:, np.newaxis] - places).T)
    np.fill_diagonal(away, np.inf)
    return bool(away.min(initial=np.inf) < _CROWDED * unit)


def _window(spots: Reals, part: Index, overview: _Sheet, paper: Reals) -> _Sheet:
    """Window around marks: as wide as the paper, as high as it must be, and where it can on the overview."""
    low, high = spots.min(axis=0), spots.max(axis=0)
    unit = max(float(((high - low) * (1 + 2 * _MARGIN) / paper).max()), overview.unit / _ENLARGED[1])
    unit = max(unit, 2.0 / paper[0])
    tall = float(np.clip((high - low)[1] * (1 + 2 * _MARGIN) / unit, _LOWEST / paper[0], paper[1]))
    size = np.array([paper[0], tall]) * unit
    corner = (low + high) / 2 - size / 2
    first, last = overview.window[:2], overview.window[:2] + overview.window[2:]
    shifted = np.clip(corner, np.minimum(first, last - size), np.maximum(first, last - size))
    corner = np.where((low >= first) & (high <= last), shifted, corner)
    return _Sheet(np.array([*corner, *size]), unit, part)


def _bound(
    picture: Picture, marks: _Marks, overview: _Sheet, early: list[_Sheet], later: list[_Sheet], number: int
) -> list[tuple[Plate, _Sheet]]:
    """Plates of one drawing, each with its sheet."""
    details = [*early, *later]
    made = []
    for n, sheet in enumerate([overview, *details]):
        if n or len(overview.marks):
            first = _inked(marks, sheet, first=True)
            rest = _inked(marks, sheet, first=False, taken=first.boxes)
        else:
            numbers = range(number + 1, number + 1 + len(details))
            first = _framed(marks, overview, early, numbers[: len(early)], first=True)
            rest = _framed(marks, overview, later, numbers[len(early) :], first=False, taken=first.boxes)
        plate = Plate(
            number=number + n, picture=picture, overview=number, unit=sheet.unit,
            magnified=overview.unit / sheet.unit, wide=_is_wide(overview),
            window=tuple(np.rint(sheet.window).astype(np.int64).tolist()), further=n > len(early), first=first,
            outside=not _meets(overview, sheet), rest=rest,
        )  # fmt: skip
        made.append((plate, sheet))
    return made


def _inked(marks: _Marks, sheet: _Sheet, *, first: bool = True, taken: Reals = NOTHING) -> Ink:
    rows = sheet.marks[marks.first[sheet.marks] == first]
    mine = marks.take(rows)
    return inked(sheet.window, sheet.unit, mine.spots, mine.severity, mine.numbers, taken)


def _framed(
    marks: _Marks, overview: _Sheet, details: list[_Sheet], numbers: Sequence[int], *, first: bool,
    taken: Reals = NOTHING,
) -> Ink:  # fmt: skip
    meeting = [n for n, sheet in enumerate(details) if _meets(overview, sheet)]
    windows, numbers = np.array([details[n].window for n in meeting]).reshape(-1, 4), [numbers[n] for n in meeting]
    shown = marks.take(np.flatnonzero((marks.first == first) & _holds(overview, marks.spots)))
    taken = np.concatenate([taken, covered(overview.window, overview.unit, shown.spots)])
    frames = framed(overview.window, overview.unit, windows, numbers, taken)
    return replace(frames, signs=signs_of(shown.spots, shown.severity, overview.unit))
