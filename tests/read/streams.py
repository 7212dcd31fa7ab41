# SPDX-License-Identifier: MIT
"""Generators of all tempers, importable by a fresh interpreter."""

import os
import signal
from collections.abc import Iterator


def counting(count: int) -> Iterator[object]:
    yield from range(count)


def pid_then_for_ever() -> Iterator[object]:
    yield os.getpid()
    while True:
        pass


def slow_then_quick(many: int) -> Iterator[object]:
    """Each step is short, all together are not."""
    for step in range(many):
        total = 0
        for n in range(2_000_000):
            total += n
        yield step


def greedy() -> Iterator[object]:
    yield "before"
    yield len(bytearray(4_000_000_000))


def taking(count: int) -> Iterator[object]:
    yield len(b"x" * count)


def failing() -> Iterator[object]:
    yield "before"
    raise ValueError("planted")


def crashing() -> Iterator[object]:
    yield "before"
    os.kill(os.getpid(), signal.SIGSEGV)


def unpicklable() -> Iterator[object]:
    yield lambda: None
