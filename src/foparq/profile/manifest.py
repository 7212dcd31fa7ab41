# SPDX-License-Identifier: MIT
"""The delivery manifest ``delivery.toml``, typed. Every section is optional; what is absent is not assessed."""

import datetime as dt
import re
from collections.abc import Mapping
from typing import Annotated, Any, Literal, get_args

from pydantic import BeforeValidator, Field, ValidationInfo, field_validator

from foparq.profile.quantities import LengthOnObject, ScaleText, Strict
from foparq.units import parse_length_unit


def _known_unit(text: object) -> str:
    parse_length_unit(str(text))
    return str(text)


def _groups(value: object) -> object:
    """Groups of patterns; patterns alone are one group."""
    if isinstance(value, list | tuple) and value and all(isinstance(part, str) for part in value):
        return [value]
    return value


def spoken(tag: object) -> object:
    """Language of a tag, by its first part and in any case; what is none that is spoken stays as it is.

    Examples
    --------
    >>> spoken("pt"), spoken("PT-br"), spoken("de")
    ('pt-BR', 'pt-BR', 'de')
    """
    first = re.split("[-_]", tag.strip().casefold())[0] if isinstance(tag, str) else tag
    return next((name for name in get_args(Language) if name.partition("-")[0] == first), tag)


#: no building is larger than its planet
Ordinate = Annotated[float, Field(ge=-1e8, le=1e8, allow_inf_nan=False)]
Language = Literal["pt-BR", "en"]
Triple = tuple[Ordinate, Ordinate, Ordinate]
_LONGEST = 200  #: letters of an entry on the first page
_ISO_DAY = re.compile(r"\d{4}-\d{2}-\d{2}")
_FIRST_YEAR, _LAST_YEAR = 1950, 2200  #: of a delivery: others are slips of the pen
UnitName = Annotated[str, BeforeValidator(_known_unit)]


class DeliverySection(Strict):
    """``[delivery]``: what was delivered and against what it is audited."""

    title: str = ""
    profile: str = "et-doc-foparq-a"  #: a shipped name, or a file in the folder
    scale: ScaleText | None = None
    crs: str = "local"
    language: Annotated[Language | None, BeforeValidator(spoken)] = None


class DrawingSection(Strict):
    """``[[drawing]]``: one vector drawing."""

    path: str
    unit: UnitName | None = None
    plane: Literal["xy", "xz", "yz", "fit"] | tuple[Triple, Triple, Triple] | None = None  #: xy where a drawing is flat
    facade: str = ""
    classes: Mapping[str, str] = Field(default_factory=dict)  #: layer pattern to feature class
    areas: tuple[str, ...] = ()  #: layers whose closed lines bound areas that cover without gap or overlap
    bind: Annotated[
        tuple[tuple[str, ...], ...], BeforeValidator(_groups)
    ] = ()  #: groups of layers that are drawn as one
    ignore_layers: tuple[str, ...] = ()  #: layers that are not checked
    layers: tuple[str, ...] = ()  #: tables of a GeoPackage to read; all if left out


class MeshSection(Strict):
    """``[[mesh]]``: one mesh."""

    path: str
    unit: UnitName | None = None  #: of its coordinates
    closed: bool | None = None  #: false: the surface has a rim, as the open base of a bust
    rims: Annotated[int, Field(ge=1, le=10**6, strict=True)] | None = (
        None  #: how many; left out: one, if it is not closed
    )
    facade: str = ""  #: kept, not assessed yet
    up: Literal["x", "y", "z"] | None = None  #: axis that points up in pictures

    @field_validator("rims")
    @classmethod
    def _open(cls, value: int | None, info: ValidationInfo) -> int | None:
        if value is not None and info.data.get("closed"):
            raise ValueError("a closed surface has no rim")
        return value


class ReferenceSection(Strict):
    """``[[reference]]``: a cloud of points that shows what a mesh should be."""

    path: str
    unit: UnitName | None = None  #: of its coordinates
    survey_sd: LengthOnObject | None = None  #: how well its points are known
    mesh: str = ""  #: path of the mesh that it shows; left out: every mesh of the delivery together


class TableSection(Strict):
    """One table."""

    path: str
    sheet: str | None = None  #: of a workbook; the first if left out


class FeaturesSection(TableSection):
    """``[features]``: the list of specified features."""

    spacing: LengthOnObject | None = None  #: on a mesh nothing is farther from every place of the list


class SurveySection(TableSection):
    """``[checkpoints]`` and ``[distances]``: a table and how well it was surveyed."""

    survey_sd: LengthOnObject | None = None
    unit: UnitName | None = None  #: of its numbers; else that of its header, else metres


def _said(text: object) -> str:
    if not isinstance(text, str) or not text.strip():
        raise ValueError("a name or a sentence")
    return text.strip()


Said = Annotated[str, BeforeValidator(_said)]


def _day(given: object) -> str:
    """Calendar day of a decision as text, ``""`` if none is stated."""
    return "" if given == "" else _date(given).isoformat()


Day = Annotated[str, BeforeValidator(_day)]


def _entry(text: object) -> str:
    """One line of a form; a number is taken as written."""
    if isinstance(text, int) and not isinstance(text, bool):
        text = str(text)
    if not isinstance(text, str) or not text.strip() or not text.isprintable() or len(text) > _LONGEST:
        raise ValueError("one line of text")
    return text.strip()


def _date(value: object) -> dt.date:
    """Calendar day: a date of TOML, or its text; 3/12/2026 would be two days."""
    if isinstance(value, str):
        value = dt.date.fromisoformat(value) if _ISO_DAY.fullmatch(value) else None
    if not isinstance(value, dt.date) or isinstance(value, dt.datetime) or not _FIRST_YEAR <= value.year <= _LAST_YEAR:
        raise ValueError("a day")
    return value


Entry = Annotated[str, BeforeValidator(_entry)]


class ContractSection(Strict):
    """``[contract]``: under which contract the delivery was made."""

    process: Entry = ""  #: number of the administrative process
    contract: Entry = ""
    contractor: Entry = ""
    responsible: Entry = ""  #: person, with registration
    revision: Entry = ""
    date: Annotated[dt.date, BeforeValidator(_date)] | None = None  #: of delivery


class ConfirmedSection(Strict):
    """``[[confirmed]]``: a statement that witnesses contradict, confirmed by a person."""

    what: Literal["unit", "plane", "scale", "checkpoints", "distances", "facade", "commission"]
    value: Said
    by: Said  #: who answers for it
    reason: Said
    path: str = ""  #: file it speaks of; left out: every file that states the value
    date: Day = ""


class DecisionSection(Strict):
    """``[[decision]]``: how many features are drawn, decided by a person where linework cannot tell."""

    element: Said  #: ``"Q5"``: for which it was asked; the number holds for all elements
    feature_class: Said = Field(alias="class")
    facade: str = ""
    counted: int = Field(ge=0, le=10**9, strict=True)
    by: Said  #: who answers for it
    reason: Said
    date: Day = ""  #: of the decision


class Manifest(Strict):
    """A delivery manifest."""

    delivery: DeliverySection = DeliverySection()
    drawing: tuple[DrawingSection, ...] = ()
    mesh: tuple[MeshSection, ...] = ()
    reference: tuple[ReferenceSection, ...] = ()
    features: FeaturesSection | None = None
    checkpoints: SurveySection | None = None
    distances: SurveySection | None = None
    confirmed: tuple[ConfirmedSection, ...] = ()
    decision: tuple[DecisionSection, ...] = ()
    contract: ContractSection | None = None
    record: Mapping[str, Any] | None = None  #: descriptive record: kept, not assessed yet
    metadata: Mapping[str, Any] | None = None  #: kept, not assessed yet
    capture: Mapping[str, Any] | None = None  #: kept, not assessed yet
