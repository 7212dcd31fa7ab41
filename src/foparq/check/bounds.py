# SPDX-License-Identifier: MIT
"""Bounds of time and memory for rules: how much, and what a broken run comes to.

How a run is kept within bounds is no matter of rules: whoever audits hands over a :class:`Bounded`.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

from foparq.findings.because import Because
from foparq.model.part import Part
from foparq.profile.schema import LimitsSpec

_SHARE = 3  #: of all time, the part that one call may use
_TIMES = 6  #: of what a part itself holds, the memory that rules may use beyond their bound


@dataclass(frozen=True, slots=True)
class Budget:
    """What a run may use."""

    seconds: float  #: processor time in all
    at_once: float  #: processor time between two things that the run tells
    memory: int  #: bytes in all, the drawing included


@dataclass(frozen=True, slots=True)
class Broken:
    """A run that did not come to its end."""

    because: Because  #: ``LIMIT`` or ``CRASHED``
    trace: str = ""


class Bounded(Protocol):
    """Runs a generator within bounds."""

    def __call__(
        self, function: Callable[..., Iterator[object]], args: tuple[Any, ...], budget: Budget
    ) -> Iterator[object]:
        """Yield what the generator yields; last a :class:`Broken` if it did not end by itself."""


def unbounded(function: Callable[..., Iterator[object]], args: tuple[Any, ...], budget: Budget) -> Iterator[object]:  # noqa: ARG001 - the protocol's signature
    """Run without bounds, in this process."""
    yield from function(*args)


def budget_of(part: Part, limits: LimitsSpec, spent: float) -> Budget:
    """What is left for the rules of a part.

    Parameters
    ----------
    spent : float
        Processor seconds that were used before.
    """
    total = limits.check_seconds + limits.check_seconds_per_million * part.vertices / 1e6
    return Budget(max(0.0, total - spent), total / _SHARE, limits.check_memory + _TIMES * part.held)
