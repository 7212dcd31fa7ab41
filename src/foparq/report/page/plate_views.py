# SPDX-License-Identifier: MIT
"""Plates in one language: their captions, and the scale bar of each."""

from dataclasses import dataclass

from foparq.report.page.bar import scale_bar
from foparq.report.page.drawing import Picture
from foparq.report.page.plates import Plate, Plates
from foparq.report.words import Words, printable

_BELOW = 9.0  #: mm under the picture for the scale bar
_TIMES = 10.0  #: how often larger a detail is: told with a decimal below


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateView:
    """One plate in one language; what the languages share is held once, under its number."""

    plate: Plate
    title: str
    file: str
    about: str
    box: tuple[int, int, int, int]  #: the window, and below it room for the scale bar, cells
    across: float  #: mm of paper
    bar: tuple[int, int, int, int]  #: left, top, height and length, cells
    lettering: str
    letter: int  #: size of the letters, cells


def plate_view(words: Words, plate: Plate) -> PlateView:
    """One plate for the page."""
    left, top, width, height = plate.window
    share, lettering = scale_bar(words, plate.picture, width)
    length, times = round(share * width), plate.magnified
    told = {"overview": plate.overview, "times": words.number(times, 1 if times < _TIMES else 0)}
    if plate.overview == plate.number:
        about = words("report.plates.overview" if plate.first.frames or plate.rest.frames else "report.plates.only")
    else:
        about = words("report.plates.outside" if plate.outside else "report.plates.detail", **told)
    return PlateView(
        plate=plate,
        title=words("report.plates.plate", number=plate.number),
        file=printable(plate.picture.drawing.path),
        about=about,
        box=(left, top, width, height + round(_BELOW * plate.unit)),
        across=round(width / plate.unit, 1),
        bar=(left + round(4 * plate.unit), top + height + round(7 * plate.unit), max(round(plate.unit), 1), length),
        lettering=lettering,
        letter=max(round(3 * plate.unit), 1),
    )


def on_paper(words: Words, plates: Plates, picture: Picture) -> str:
    """Which plates show a drawing, which of them only where all rows are printed, and how many marks stand on none."""
    mine = [plate for plate in plates.plates if plate.picture is picture]
    if not mine:
        return ""
    always = [plate.number for plate in mine if not plate.further]
    further = [plate.number for plate in mine if plate.further]
    told = [words("report.plates.where", plates=_span(always))]
    if further:
        told.append(words("report.plates.further", plates=_span(further)))
    if plates.unplaced[picture.drawing.path]:
        told.append(words("report.plates.unplaced", count=words.count(plates.unplaced[picture.drawing.path])))
    return " ".join(told)


def _span(numbers: list[int]) -> str:
    return f"{numbers[0]}" if len(numbers) == 1 else f"{numbers[0]}–{numbers[-1]}"
