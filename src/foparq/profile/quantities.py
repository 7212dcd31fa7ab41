# SPDX-License-Identifier: MIT
"""Values of profiles and manifests: quantities with units, and tables of which every key is known."""

from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from foparq.errors import QuantityError
from foparq.units import Quantity, parse_any_quantity, parse_quantity, parse_scale


def _quantity(symbol: str) -> BeforeValidator:
    return BeforeValidator(lambda text: text if isinstance(text, Quantity) else parse_quantity(text, symbol))


Length = Annotated[Quantity, _quantity("m")]


_EXAMPLE = "3 mm"  #: of a length that is none on the sheet


def _on_object(text: object) -> Quantity:
    try:
        length = text if isinstance(text, Quantity) else parse_quantity(text, "m")
    except QuantityError as wrong:
        raise QuantityError(wrong.message, **{**wrong.fields, "example": _EXAMPLE}) from None
    if length.at_scale:
        raise QuantityError("quantity.on-sheet", value=str(text), example=_EXAMPLE)
    if not length.si() > 0.0:
        raise QuantityError("quantity.not-positive", value=str(text), example=_EXAMPLE)
    return length


#: what is measured on the object itself, above zero: a length on the sheet says nothing of it
LengthOnObject = Annotated[Quantity, BeforeValidator(_on_object)]
Angle = Annotated[Quantity, _quantity("rad")]
Ratio = Annotated[Quantity, _quantity("1")]
Area = Annotated[Quantity, _quantity("m2")]
Share = Annotated[
    float, BeforeValidator(lambda text: text if isinstance(text, float) else parse_quantity(text, "1").si())
]
AnyQuantity = Annotated[
    Quantity, BeforeValidator(lambda text: text if isinstance(text, Quantity) else parse_any_quantity(text))
]


def _no_flag(number: object) -> object:
    if isinstance(number, bool):
        raise ValueError("a flag is no number")  # noqa: TRY004 - what pydantic tells as a wrong value
    return number


Times = Annotated[int, BeforeValidator(_no_flag), Field(ge=1)]


def _known_scale(text: object) -> str:
    parse_scale(text)
    return str(text)


ScaleText = Annotated[str, BeforeValidator(_known_scale)]


class Strict(BaseModel):
    """A table of which every key is known."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)


class LooserWhen(StrEnum):
    """Which change of a value lets more pass."""

    LARGER = "larger"
    SMALLER = "smaller"
    DIFFERENT = "different"  #: either way, depending on what is delivered
