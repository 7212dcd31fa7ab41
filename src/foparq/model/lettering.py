# SPDX-License-Identifier: MIT
"""Lengths as draughtsmen letter them: ``3'-1"``, ``12'-6 1/2"``, ``2,50 m``, ``350``."""

import re

from foparq.units import LENGTHS

_FOOT, _INCH = LENGTHS["ft"], LENGTHS["in"]
_LONGEST = 40  #: characters; a longer text is a remark
_LONGEST_RAW = 400  #: the same with decoration
_QUOTES = str.maketrans(
    {"’": "'", "′": "'", "‘": "'", "`": "'", "”": '"', "″": '"', "“": '"', "–": "-", "−": "-", "\u00a0": " "}
)
_DECORATION = re.compile(r"^(?:[~≈±=\s]|ca\.?|c\.)+|(?:\s|\(.*\)|typ\.?|\.)+$", re.IGNORECASE)
_FRACTION = r"(?:[\s-]*(?P<top>[0-9]+)\s*/\s*(?P<bottom>[0-9]+))?"
_FEET = re.compile(
    r"^(?:(?P<feet>[0-9]+(?:[.,][0-9]+)?)\s*(?:'|ft\.?|feet|foot))?[\s-]*"
    r"(?:(?P<inches>[0-9]+(?:[.,][0-9]+)?(?![0-9]*\s*/))?" + _FRACTION + r"\s*(?P<mark>\"|''|in\.?|inch|inches)?)?$",
    re.IGNORECASE,
)
_METRIC = re.compile(r"^(?P<number>[0-9][0-9.,\s]*)\s*(?P<unit>km|dm|cm|mm|m|yd)\.?$", re.IGNORECASE)
_PLAIN = re.compile(r"^[0-9][0-9.,\s]*$")
_GROUPED = re.compile(r"^[0-9]{1,3}(?:(?P<mark>[.,\s])[0-9]{3})(?:(?P=mark)[0-9]{3})*$")


def lettered_length(text: str) -> tuple[float | None, float | None]:
    r"""Length that a lettering states.

    Parameters
    ----------
    text : str
        As written, without formatting codes.

    Returns
    -------
    metres : float or None
        If the lettering names its unit: feet and inches, or a number with a unit.
    number : float or None
        If it is a number alone, which says nothing of its unit.

    Notes
    -----
    A comma or point before one, two or four and more digits is decimal; before exactly three digits it is decimal too
    (``2,500`` is two and a half) unless it occurs twice (``1.234.567``). ``(None, None)`` for anything else.

    Examples
    --------
    >>> lettered_length("3'-1\"")
    (0.9398, None)
    >>> lettered_length("2,50 m"), lettered_length("350")
    ((2.5, None), (None, 350.0))
    """
    if len(text) > _LONGEST_RAW:  # the cost of the pattern grows with the square
        return None, None
    cleaned = _DECORATION.sub("", text.translate(_QUOTES).strip())
    if not cleaned or len(cleaned) > _LONGEST:
        return None, None
    metric = _METRIC.match(cleaned)
    if metric is not None:
        value = _number(metric["number"])
        return (None, None) if value is None else (value * LENGTHS[metric["unit"].lower()], None)
    if _PLAIN.match(cleaned):
        return None, _number(cleaned)
    return _feet_and_inches(cleaned), None


def _feet_and_inches(text: str) -> float | None:
    found = _FEET.match(text)
    if found is None or not (found["feet"] or found["mark"]):
        return None
    inches = _number(found["inches"] or "0") or 0.0
    if found["top"]:
        if int(found["top"]) >= int(found["bottom"]):
            return None
        inches += int(found["top"]) / int(found["bottom"])
    feet = _number(found["feet"] or "0") or 0.0
    # Whole sixty-fourths are exact, so that 3'-1" is 37 times an inch to the last digit.
    return round((feet * 12 + inches) * _INCH, 9)


def _number(text: str) -> float | None:
    digits = text.strip()
    marks = [mark for mark in digits if mark in ".,"]
    if len(marks) > 1 and len(set(marks)) == 1:
        if not _GROUPED.match(digits):
            return None
        digits = digits.replace(marks[0], "")
    elif len(marks) > 1:  # 1.234,50: the last mark is decimal
        last = marks[-1]
        if digits.count(last) > 1:
            return None
        digits = digits.replace("," if last == "." else ".", "")
    digits = digits.replace(",", ".")
    try:
        return float("".join(digits.split()))
    except ValueError:
        return None
