# SPDX-License-Identifier: MIT
"""Quantities: a number, its unit, and whether it is meant at drawing scale.

``"10 mm"`` is a length on the object. ``"0.2 mm @ scale"`` is a length on the sheet: at 1:50 it is 10 mm on the
object. A bare number is never a quantity.
"""

import math
import re
import unicodedata
from dataclasses import dataclass
from fractions import Fraction
from typing import Annotated

from foparq.errors import QuantityError


@dataclass(frozen=True, slots=True)
class Unit:
    """Unit of a rule's tolerance, read from its annotation.

    Parameters
    ----------
    symbol : str
        The SI symbol in which the rule receives the number: ``"m"``, ``"m2"``, ``"1"``, ``"items"`` or ``"rad"``.
    """

    symbol: str


Metres = Annotated[float, Unit("m")]
SquareMetres = Annotated[float, Unit("m2")]
Ratio = Annotated[float, Unit("1")]
Count = Annotated[float, Unit("items")]
Radians = Annotated[float, Unit("rad")]

#: metres in one unit of length, exact where the definition is
LENGTHS: dict[str, float] = {
    "km": 1000.0,
    "m": 1.0,
    "dm": 0.1,
    "cm": 0.01,
    "mm": 0.001,
    "um": 1e-6,
    "in": 0.0254,
    "ft": 0.3048,
    "yd": 0.9144,
}
_SAME_UNIT = 0.02  #: relative difference of lettering to the unit it means
_FINEST_UNIT, _COARSEST_UNIT = 1e-9, 1e6  #: metres that a drawing unit can be
_AREAS = {f"{name}2": factor**2 for name, factor in LENGTHS.items()}
_SPELLED = {
    "μm": "um",
    "µm": "um",
    "m²": "m2",
    "mm²": "mm2",
    "cm²": "cm2",
    '"': "in",
    "'": "ft",
    "inch": "in",
    "metre": "m",
    "°": "deg",
}
#: words for units that are not taken, each with the symbol that is meant
_WORDS = {
    "m": ("metro", "meter", "metre", "mt", "mts"), "mm": ("milimetro", "millimeter", "millimetre"),
    "cm": ("centimetro", "centimeter", "centimetre"), "dm": ("decimetro", "decimeter", "decimetre"),
    "km": ("quilometro", "kilometer", "kilometre", "kilometro"), "in": ("polegada", "inche", "inch", "pulgada", "pol"),
    "ft": ("pe", "foot", "feet", "pie"), "yd": ("jarda", "yard", "yarda"),
}  # fmt: skip
_RATIOS = {"%": 0.01, "1": 1.0}
_COUNTS = {"items": 1.0}
_ANGLES = {"deg": math.pi / 180, "rad": 1.0}
_SYMBOLS = {"m": LENGTHS, "m2": _AREAS, "1": _RATIOS, "items": _COUNTS, "rad": _ANGLES}
_QUANTITY = re.compile(
    r"^\s*(?P<number>[+-]?[0-9]+(?:[.,][0-9]+)?(?:[eE][+-]?[0-9]+)?)\s*(?P<unit>[^\s@\d]+[²2]?)\s*(?P<scale>@\s*scale)?\s*$"
)
#: a separator of thousands as good as one of decimals
_GROUPED = re.compile(r"(?<![\d.,])[1-9]\d{0,2}(?:[.,]\d{3})+(?!\d)")
_SCALE = re.compile(r"^\s*1\s*[:/]\s*(?P<denominator>[0-9]+(?:[.,][0-9]+)?)\s*$")


def length_name(metres: float) -> str:
    """Name of a unit of length, or its length in metres where it has none.

    Examples
    --------
    >>> length_name(0.001), length_name(0.5)
    ('mm', '0.5 m')
    """
    named = (name for name, length in LENGTHS.items() if math.isclose(length, metres, rel_tol=_SAME_UNIT))
    return next(named, f"{metres:.3g} m")


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with its unit, as a person wrote it.

    Parameters
    ----------
    number : float
        The number, in ``unit``.
    unit : str
        Unit as understood: ``"mm"``, ``"m2"``, ``"%"``.
    at_scale : bool
        True if the length is meant on the sheet.
    """

    number: float
    unit: str
    at_scale: bool = False

    @property
    def symbol(self) -> str:
        """SI symbol of what is measured: ``"m"``, ``"m2"``, ``"1"``, ``"items"`` or ``"rad"``."""
        return next(symbol for symbol, known in _SYMBOLS.items() if self.unit in known)

    def si(self, scale: float | None = None) -> float:
        """Number in SI units on the object.

        Parameters
        ----------
        scale : float, optional
            Denominator k of the drawing scale 1:k.

        Returns
        -------
        float
            Metres, square metres, ratio, count or radians.

        Raises
        ------
        QuantityError
            If the quantity is meant at scale and no scale is given.
        """
        factor = _SYMBOLS[self.symbol][self.unit]
        if not self.at_scale:
            return _product(self.number, factor)
        if scale is None:
            raise QuantityError("quantity.no-scale", value=str(self), example="1:50")
        return _product(self.number, factor, scale if self.symbol == "m" else scale**2)

    def __str__(self) -> str:
        return f"{self.number:g} {self.unit}" + (" @ scale" if self.at_scale else "")


def parse_quantity(text: object, symbol: str) -> Quantity:
    """Quantity from what a person wrote.

    Parameters
    ----------
    text : object
        A string such as ``"0.2 mm @ scale"``, ``"5 cm"``, ``"10 %"``. A decimal comma is understood.
    symbol : str
        What must be measured: ``"m"``, ``"m2"``, ``"1"``, ``"items"`` or ``"rad"``.

    Raises
    ------
    QuantityError
        If it is not a string, has no unit, or has a unit of something else.

    Examples
    --------
    >>> parse_quantity("0.2 mm @ scale", "m").si(50)
    0.01
    """
    example = {"m": "0.2 mm @ scale", "m2": "1 m2", "1": "10 %", "items": "5 items", "rad": "15 deg"}[symbol]
    if not isinstance(text, str):
        raise QuantityError("quantity.bare-number", value=text, example=example)
    _refuse_thousands(text, example)
    found = _QUANTITY.match(text)
    if found is None:
        raise QuantityError("quantity.not-understood", value=text, example=example)
    unit = _SPELLED.get(found["unit"], found["unit"])
    if unit not in _SYMBOLS[symbol]:
        raise QuantityError(
            "quantity.wrong-unit", value=text, unit=unit, known=", ".join(_SYMBOLS[symbol]), example=example
        )
    number = float(found["number"].replace(",", "."))
    if not math.isfinite(number):
        raise QuantityError("quantity.not-understood", value=text, example=example)
    return Quantity(number, unit, found["scale"] is not None)


def parse_any_quantity(text: object) -> Quantity:
    """Quantity of whatever kind its unit tells; see :func:`parse_quantity`."""
    kind = "m"
    if isinstance(text, str) and (found := _QUANTITY.match(text)):
        unit = _SPELLED.get(found["unit"], found["unit"])
        kind = next((symbol for symbol, known in _SYMBOLS.items() if unit in known), "m")
    return parse_quantity(text, kind)


def parse_scale(text: object) -> float:
    """Denominator of a drawing scale written ``"1:50"``.

    Raises
    ------
    QuantityError
        If it is not one to a positive number.

    Examples
    --------
    >>> parse_scale("1:50")
    50.0
    """
    if isinstance(text, str):
        _refuse_thousands(text, "1:50")
    found = _SCALE.match(text) if isinstance(text, str) else None
    denominator = float(found["denominator"].replace(",", ".")) if found else 0.0
    if not 0 < denominator < math.inf:
        raise QuantityError("quantity.not-a-scale", value=text, example="1:50")
    return denominator


def _refuse_thousands(text: str, example: str) -> None:
    """A number of 1.000 is one or a thousand: nobody is asked to guess."""
    if _GROUPED.search(text):
        raise QuantityError("quantity.thousands", value=text, example=example)


def parse_length_unit(text: str) -> float:
    """Metres in one drawing unit: ``"mm"``, ``"in"``, or a stated length such as ``"0.641 m"``.

    Raises
    ------
    QuantityError
        If the unit is not known.

    Examples
    --------
    >>> parse_length_unit("in")
    0.0254
    """
    name = _SPELLED.get(text.strip(), text.strip())
    if name in LENGTHS:
        return LENGTHS[name]
    try:
        length = parse_quantity(text, "m")
    except QuantityError:
        raise _unknown_unit(text) from None
    if length.at_scale or not _FINEST_UNIT <= length.si() <= _COARSEST_UNIT:
        raise _unknown_unit(text)
    return length.si()


def unit_named(word: str) -> str:
    """Symbol of the unit of length that a word means, whatever its case, accents and plural; ``""`` if it is none.

    Examples
    --------
    >>> unit_named("Milímetros"), unit_named("MM"), unit_named("desenho")
    ('mm', 'mm', '')
    """
    letters = unicodedata.normalize("NFD", word.strip().strip(".").casefold())
    plain = "".join(letter for letter in letters if not unicodedata.combining(letter))
    forms = {plain, plain.removesuffix("s")}
    return next((unit for unit, words in _WORDS.items() if unit in forms or not forms.isdisjoint(words)), "")


def _unknown_unit(text: str) -> QuantityError:
    """Error that shows the symbol which a word means first."""
    meant = unit_named(text)
    known = [*filter(None, [meant]), *(unit for unit in LENGTHS if unit != meant)]
    return QuantityError("quantity.unknown-unit", value=text, known=", ".join(known), example=meant or "m")


def _product(*factors: float) -> float:
    # Decimal numbers are multiplied as written: 0.3 mm at 1:50 is 0.015 m, not 0.0149999...
    result = Fraction(1)
    for factor in factors:
        result *= Fraction(repr(float(factor)))
    return float(result)
