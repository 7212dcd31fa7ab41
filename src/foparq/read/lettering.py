# SPDX-License-Identifier: MIT
"""What short letterings of a drawing may say, whatever the format: a name, or the scale of the sheet."""

import re

from foparq.model.drawing import StatedScale

LONGEST_NAME = 40  #: letters of a name
LONGEST_SCALE = 10 * LONGEST_NAME  #: letters of a lettering that may state a scale
MOST_NAMES = 200_000  #: names that are kept
_SCALE = re.compile(r"\b(?:esc|escala|scale)\b\.?\s*[:=]?\s*1\s*[:/]\s*(\d{1,5}(?:[.,]\d+)?)\b", re.IGNORECASE)


def scales_in(text: str) -> set[StatedScale]:
    """Scales that a lettering states."""
    return {
        StatedScale(witness="lettering", denominator=float(number.replace(",", ".")), said=text)
        for number in _SCALE.findall(text)
    }
