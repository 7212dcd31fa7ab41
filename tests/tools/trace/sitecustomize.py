# SPDX-License-Identifier: MIT
"""Tells which functions of foparq every test calls; in effect where ``FOPARQ_REACH`` names a pipe.

Readers run in child processes that may write no file: a pipe reaches from there, and survives ``os._exit``.
"""

import os
import sys
import threading
from collections.abc import Callable
from types import CodeType, FrameType

_PIPE = os.environ.get("FOPARQ_REACH")
_INSIDE = f"{os.sep}src{os.sep}foparq{os.sep}"
_TRACE: list[Callable[[FrameType, str, object], None]] = []


def resume() -> None:
    """Trace again: Python gives up a trace function in which a test's recursion ran out of depth."""
    for called in _TRACE:
        threading.settrace(called)
        sys.settrace(called)


def _start(pipe: int) -> None:
    seen: dict[str, dict[int, CodeType]] = {}

    def called(frame: FrameType, event: str, _: object) -> None:
        code = frame.f_code
        if event != "call" or _INSIDE not in code.co_filename:
            return
        test = os.environ.get("PYTEST_CURRENT_TEST", "")
        known = seen.setdefault(test, {})
        if id(code) not in known:
            known[id(code)] = code
            file = code.co_filename.rpartition(_INSIDE)[2]
            # Shorter than what a pipe takes at once: lines of several processes never mix.
            os.write(pipe, f"{file}\x1f{code.co_qualname}\x1f{test}\n".encode()[:4000])

    _TRACE.append(called)
    resume()


if _PIPE:
    _start(os.open(_PIPE, os.O_WRONLY))
