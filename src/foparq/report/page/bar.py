# SPDX-License-Identifier: MIT
"""Scale bars of pictures and plates."""

import numpy as np

from foparq.report.page.drawing import Picture
from foparq.report.words import Words


def scale_bar(words: Words, picture: Picture, width: float) -> tuple[float, str]:
    """Length of a scale bar as a share of a width, and its lettering.

    It is the largest of 1, 2, 5 times a power of ten that takes at most a fifth of the width.

    Parameters
    ----------
    width : float, cells
        Of what is shown of the picture.
    """
    length, lettering = bar_of(words, width * picture.quantum, known=picture.drawing.unit.metres is not None)
    return length / (width * picture.quantum), lettering


def bar_of(words: Words, across: float, *, known: bool) -> tuple[float, str]:
    """Length of a scale bar, and its lettering.

    Parameters
    ----------
    across : float
        Of what is shown, metres; units of the file where nobody knows these.
    known : bool
        Somebody knows them.
    """
    decade = 10.0 ** np.floor(np.log10(across / 5))
    length = float(max(step * decade for step in (1, 2, 5) if step * decade <= across / 5))
    return length, bar_text(words, length) if known else f"{length:g} {words('report.drawing.unit-bar')}"


def bar_text(words: Words, metres: float) -> str:
    """Round length without needless decimals: ``"5 m"``, ``"20 cm"``, ``"2 mm"``."""
    for name, length in (("km", 1000.0), ("m", 1.0), ("cm", 0.01), ("mm", 0.001)):
        if metres >= length * 0.999:
            return f"{words.count(round(metres / length))} {name}"
    return words.quantity(metres, "m")
