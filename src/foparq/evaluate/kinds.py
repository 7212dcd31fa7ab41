# SPDX-License-Identifier: MIT
"""Kinds of quality elements and what evaluates them, found by walking ``evaluate.elements``."""

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, TypeVar

import foparq.evaluate.elements
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Element
from foparq.profile.elements import ElementSpec

#: takes an element of the profile, of its own type, and the evidence
Evaluator = Callable[[Any, Evidence], tuple[Element, ...]]
F = TypeVar("F", bound=Evaluator)


@dataclass(frozen=True, slots=True)
class Kind:
    """How elements of one kind are evaluated."""

    evaluate: Evaluator
    measure: str  #: id in the catalogue: names the result also where none could be made


KINDS: dict[type[ElementSpec], Kind] = {}


def evaluates(kind: type[ElementSpec], *, measure: str) -> Callable[[F], F]:
    """Declare a function as what evaluates elements of one kind.

    Parameters
    ----------
    kind : type of ElementSpec
    measure : str
        Id in the catalogue of measures.
    """

    def declare(evaluator: F) -> F:
        KINDS[kind] = Kind(evaluator, measure)
        return evaluator

    return declare


def kind_of(spec: ElementSpec) -> Kind:
    """How an element is evaluated.

    Raises
    ------
    KeyError
        If nobody declared it.
    """
    _load()
    return KINDS[type(spec)]


@cache
def _load() -> None:
    for module in pkgutil.walk_packages(foparq.evaluate.elements.__path__, "foparq.evaluate.elements."):
        importlib.import_module(module.name)
