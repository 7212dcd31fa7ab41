# SPDX-License-Identifier: MIT
"""Rules and searches in a child process within the bounds of the profile, for whoever audits."""

import traceback
from collections.abc import Callable, Iterator
from typing import Any, TypeVar, cast

from foparq.check.bounds import Broken, Budget, budget_of
from foparq.findings.because import Because
from foparq.model.delivery import Delivery
from foparq.profile.schema import Profile
from foparq.read.guard.stream import Stopped, streamed

_BYTES_A_POINT = 200  #: of a reference that is compared: the point, its nearest place and what is sorted
T = TypeVar("T")


def in_child(function: Callable[..., Iterator[object]], args: tuple[Any, ...], budget: Budget) -> Iterator[object]:
    """Rules within the bounds of the profile: what a drawing does to them must not happen to the audit."""
    told = streamed(function, args, seconds=budget.seconds, at_once=budget.at_once, memory=budget.memory)
    for thing in told:
        if isinstance(thing, Stopped):
            yield Broken(Because.LIMIT) if thing.spent else Broken(Because.CRASHED, thing.words)
        else:
            yield thing


def once(
    what: str, function: Callable[..., T], args: tuple[Any, ...], delivery: Delivery, profile: Profile, *, more: int = 0
) -> tuple[T | None, Broken | None]:
    """Result of one function within the bounds of the profile for rules, or why it broke off.

    Parameters
    ----------
    what : str
        Heads the log if it crashes.
    more : int
        Points that are looked at beside the parts of the delivery.
    """
    limits = profile.limits
    seconds = sum(budget_of(part, limits, 0.0).seconds for part in delivery.parts) or 1.0
    seconds += limits.check_seconds_per_million * more / 1e6
    memory = limits.check_memory + _BYTES_A_POINT * more
    result: T | None = None
    for thing in streamed(_made, (what, function, args), seconds=seconds, at_once=seconds, memory=memory):
        if isinstance(thing, Stopped):
            return None, Broken(Because.LIMIT) if thing.spent else Broken(Because.CRASHED, thing.words)
        if isinstance(thing, Broken):
            return None, thing
        result = cast("T", thing)
    return result, None


def _made(what: str, function: Callable[..., T], args: tuple[Any, ...]) -> Iterator[T | Broken]:
    try:
        yield function(*args)
    except MemoryError:
        raise
    except Exception:  # noqa: BLE001 - a crash is ours: elements that need the result are undecided
        yield Broken(Because.CRASHED, f"{what}\n{traceback.format_exc()}")
