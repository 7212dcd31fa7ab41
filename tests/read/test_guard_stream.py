# SPDX-License-Identifier: MIT
"""A generator in a child process: what it tells arrives, what stops it is told, and nothing runs on."""

import importlib
import os
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from foparq.read.guard import stream
from foparq.read.guard.stream import Stopped, streamed

sys.path.append(str(Path(__file__).parent))  # the child imports it by name
streams = importlib.import_module("streams")
PLENTY = {"seconds": 30, "at_once": 20, "memory": 500_000_000}


@pytest.fixture(params=["forked", "started"])
def run(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Callable[..., list]:
    """The stream as a list; from a fork and from a fresh interpreter."""
    if request.param == "started":
        monkeypatch.setattr(stream, "can_fork", lambda: False)
    return lambda function, *args, **bounds: list(streamed(function, args, **{**PLENTY, **bounds}))


def test_everything_arrives_in_order(run: Callable[..., list]) -> None:
    assert run(streams.counting, 2000) == list(range(2000))


def test_nothing_is_something(run: Callable[..., list]) -> None:
    assert run(streams.counting, 0) == []


def test_time_between_two_things_is_bounded_and_what_came_before_is_kept(run: Callable[..., list]) -> None:
    pid, end = run(streams.pid_then_for_ever, at_once=0.3)
    assert end == Stopped(spent=True)
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_time_in_all_is_bounded(run: Callable[..., list]) -> None:
    *steps, end = run(streams.slow_then_quick, 10_000, seconds=1)
    assert end == Stopped(spent=True)
    assert steps == list(range(len(steps)))
    assert len(steps) > 1


def test_memory_is_bounded(run: Callable[..., list]) -> None:
    assert run(streams.greedy) == ["before", Stopped(spent=True)]


@pytest.mark.skipif(sys.platform != "linux", reason="memory is bounded on Linux only")
def test_what_the_child_starts_with_counts_as_memory() -> None:
    assert list(streamed(streams.taking, (200_000_000,), **{**PLENTY, "memory": 900_000_000})) == [200_000_000]
    held = b"x" * 800_000_000
    assert list(streamed(streams.taking, (200_000_000,), **{**PLENTY, "memory": 900_000_000})) == [Stopped(spent=True)]
    del held


@pytest.mark.parametrize("function", [streams.failing, streams.crashing, streams.unpicklable])
def test_a_failure_is_no_exhaustion(run: Callable[..., list], function: Callable[..., Iterator[object]]) -> None:
    end = run(function)[-1]
    assert not end.spent
    assert end.words


def test_a_listener_that_leaves_early_leaves_nothing_behind() -> None:
    told = streamed(streams.pid_then_for_ever, (), **PLENTY)
    pid = next(told)
    told.close()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_beside_other_threads_nothing_is_forked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "fork", lambda: pytest.fail("forked beside a thread"))
    done = threading.Event()
    thread = threading.Thread(target=done.wait)
    thread.start()
    try:
        assert list(streamed(range, (3,), **PLENTY)) == [0, 1, 2]
    finally:
        done.set()
        thread.join()
