# SPDX-License-Identifier: MIT
"""What a plate bears beside linework: signs, numbers, the lines between them, and frames of details."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from foparq.columns import Index, Reals, Texts
from foparq.report.page.labels import placed

LETTER = 2.9  #: mm: size of the letters
DIGIT = 0.6  #: width of a digit over the size of the letters: the page makes every digit as wide
_PAD = 0.8  #: mm around a number
_HEIGHT = 3.4  #: mm of the box of a number
_SIGN = 1.5  #: mm: half of a sign
_NEAR = 4.0  #: mm from a mark to the middle of its number, besides half the width: what needs no line to be found
_AVOIDED = 300  #: signs of an overview that the numbers of frames can keep clear of
#: corners of a sign, mm from its middle
_SIGNS = {
    "critical": ((0.0, -1.5), (1.5, 0.0), (0.0, 1.5), (-1.5, 0.0)),
    "major": ((0.0, -1.5), (1.4, 1.0), (-1.4, 1.0)),
    "minor": ((-0.6, -1.3), (0.6, -1.3), (1.3, -0.6), (1.3, 0.6), (0.6, 1.3), (-0.6, 1.3), (-1.3, 0.6), (-1.3, -0.6)),
    "note": ((-0.8, -0.8), (0.8, -0.8), (0.8, 0.8), (-0.8, 0.8)),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """A number on a plate, cells."""

    x: int  #: middle
    y: int  #: foot of the letters
    length: int
    text: str
    kind: str  #: severity of a mark, or ``frame``


@dataclass(frozen=True, slots=True, kw_only=True)
class Ink:
    """Path data and numbers in cells of a picture."""

    signs: tuple[tuple[str, str], ...] = ()  #: severity and path data
    frames: str = ""  #: path data of the frames of details
    backs: str = ""  #: path data of the white ground of the numbers
    leaders: str = ""  #: path data of lines between marks and their numbers
    labels: tuple[Label, ...] = ()
    letter: int = 0  #: size of the letters
    boxes: Reals  #: (k, 4) mm: middles, half widths and heights of what the next ink of the plate must not cover
    near: bool = True  #: every number stands beside its mark

    @property
    def empty(self) -> bool:
        """Nothing to draw."""
        return not (self.signs or self.frames)

    def with_signs(self, spots: Reals, severity: Texts, unit: float) -> "Ink":
        """The same with signs at other spots (n, 2), with or without number."""
        return replace(self, signs=signs_of(spots, severity, unit))


NOTHING = np.empty((0, 4))


def inked(window: Reals, unit: float, spots: Reals, severity: Texts, numbers: Index, taken: Reals = NOTHING) -> Ink:
    """Signs with their numbers.

    Parameters
    ----------
    window : (4,) cells
        Left, top, width and height.
    unit : float
        Cells in a millimetre of paper.
    spots : (n, 2) cells
        Marks, in the order in which their numbers are given a place.
    severity : (n,) str
    numbers : (n,) int
    taken : (k, 4) mm
        What the numbers must not cover.
    """
    corner, size = window[:2], window[2:] / unit
    mm = (spots - corner) / unit
    texts = [str(number) for number in numbers.tolist()]
    widths = np.array([len(text) * LETTER * DIGIT + _PAD for text in texts])
    middles = placed(mm, widths, _HEIGHT, size, _SIGN, taken)
    own = np.column_stack([middles, widths / 2, np.full(len(mm), _HEIGHT / 2)])
    signs = np.column_stack([mm, np.full((len(mm), 2), _SIGN)])
    lines, near = _leaders(mm, own, _SIGN)
    return Ink(
        signs=signs_of(spots, severity, unit),
        backs=_grounds(own, corner, unit),
        leaders=_lines(lines * unit + corner),
        labels=_labels(own, texts, severity.tolist(), corner, unit),
        letter=max(round(LETTER * unit), 1),
        boxes=np.concatenate([taken, signs, own]),
        near=near,
    )


def framed(window: Reals, unit: float, frames: Reals, numbers: Sequence[int], taken: Reals = NOTHING) -> Ink:
    """Frames of details with the numbers of their plates.

    Parameters
    ----------
    frames : (n, 4) cells
        Left, top, width and height.
    """
    corner, size = window[:2], window[2:] / unit
    mm = np.clip((frames[:, :2] - corner) / unit, 0.0, size)
    texts = [str(number) for number in numbers]
    widths = np.array([len(text) * LETTER * DIGIT + 2 * _PAD for text in texts])
    middles = placed(mm, widths, _HEIGHT, size, 0.0, taken)
    own = np.column_stack([middles, widths / 2, np.full(len(mm), _HEIGHT / 2)])
    lines, near = _leaders(mm, own, 0.0)
    drawn = "".join(f"M{x} {y}h{w}v{h}h{-w}z" for x, y, w, h in np.rint(frames).astype(np.int64).tolist())
    return Ink(
        frames=drawn,
        backs=_grounds(own, corner, unit),
        leaders=_lines(lines * unit + corner),
        labels=_labels(own, texts, ["frame"] * len(texts), corner, unit),
        letter=max(round(LETTER * unit), 1),
        boxes=np.concatenate([taken, own]),
        near=near,
    )


def covered(window: Reals, unit: float, spots: Reals) -> Reals:
    """What signs cover of an overview (k, 4) mm, on a grid of one sign; nothing where they are everywhere."""
    cells = np.unique(np.rint((spots - window[:2]) / unit / (2 * _SIGN)), axis=0) * 2 * _SIGN
    return np.column_stack([cells, np.full((len(cells), 2), _SIGN)]) if len(cells) <= _AVOIDED else NOTHING


def signs_of(spots: Reals, severity: Texts, unit: float) -> tuple[tuple[str, str], ...]:
    """Path data of signs, by severity; several in one place are drawn once."""
    made = []
    for kind, corners in reversed(_SIGNS.items()):  # the gravest last, on top
        places = np.unique(spots[severity == kind].astype(np.int64).reshape(-1, 2), axis=0)
        if not len(places):
            continue
        shape = np.rint(np.array(corners) * unit).astype(np.int64)
        steps = "".join(f"l{x} {y}" for x, y in np.diff(shape, axis=0).tolist()) + "z"
        made.append((kind, "".join(f"M{x} {y}{steps}" for x, y in (places + shape[0]).tolist())))
    return tuple(made)


def _leaders(mm: Reals, boxes: Reals, clear: float) -> tuple[Reals, bool]:
    """Ends (k, 2, 2) of the lines from marks to numbers that could be taken for others, and whether all stand near."""
    nearest = np.clip(mm[:, np.newaxis], boxes[:, :2] - boxes[:, 2:], boxes[:, :2] + boxes[:, 2:])  # (mark, box, 2)
    length = np.hypot(*(nearest - mm[:, np.newaxis]).T).T  # (mark, box)
    apart = np.any(mm[:, np.newaxis] != mm, axis=2)
    own = np.diagonal(length)
    doubtful = np.any(apart & (length < 1.5 * own), axis=0) | (own > clear + 1.2)
    ends = np.stack([mm, nearest[np.arange(len(mm)), np.arange(len(mm))]], axis=1)
    return ends[doubtful], not bool((own > _NEAR).any())


def _lines(ends: Reals) -> str:
    return "".join(f"M{a} {b}L{c} {d}" for (a, b), (c, d) in np.rint(ends).astype(np.int64).tolist())


def _grounds(boxes: Reals, corner: Reals, unit: float) -> str:
    half = boxes[:, 2:] - (_PAD / 4, 0.15)
    low = np.rint((boxes[:, :2] - half) * unit + corner).astype(np.int64)
    size = np.rint(2 * half * unit).astype(np.int64)
    return "".join(f"M{x} {y}h{w}v{h}h{-w}z" for (x, y), (w, h) in zip(low.tolist(), size.tolist(), strict=True))


def _labels(boxes: Reals, texts: Sequence[str], kinds: Sequence[str], corner: Reals, unit: float) -> tuple[Label, ...]:
    places = np.rint((boxes[:, :2] + (0.0, 0.36 * LETTER)) * unit + corner).astype(np.int64)
    return tuple(
        Label(x=x, y=y, length=max(round(len(text) * LETTER * DIGIT * unit), 1), text=text, kind=kind)
        for (x, y), text, kind in zip(places.tolist(), texts, kinds, strict=True)
    )
