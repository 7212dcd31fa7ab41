# SPDX-License-Identifier: MIT
"""The catalogue of measures, ``rules/measures.toml``."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Any

from foparq.resources import shipped


@dataclass(frozen=True, slots=True, kw_only=True)
class Measure:
    """One measure of data quality."""

    id: str  #: ISO 19157 id, or ``"foparq:..."``
    name: str  #: English, as in the standard
    element: str  #: data quality element of ISO/TS 19157-2 without prefix
    value: str  #: ``Boolean``, ``Integer``, ``Measure`` or ``Real``
    unit: str  #: SI unit of the value
    definition: str
    parameters: tuple[str, ...] = ()  #: what must be reported with the value
    counts: tuple[str, ...] = ()  #: names of the rules whose findings it counts


@cache
def measures() -> Mapping[str, Measure]:
    """Every measure by id, in the order of the catalogue."""
    data: dict[str, Any] = tomllib.loads((shipped("rules") / "measures.toml").read_text(encoding="utf-8"))
    made = [Measure(**{key: _frozen(value) for key, value in row.items()}) for row in data["measure"]]
    return MappingProxyType({measure.id: measure for measure in made})


def _frozen(value: Any) -> Any:  # noqa: ANN401 - TOML
    return tuple(value) if isinstance(value, list) else value


def measure_counting(rule: str) -> Measure | None:
    """The measure that counts the findings of a rule, or ``None``."""
    return next((measure for measure in measures().values() if rule in measure.counts), None)
