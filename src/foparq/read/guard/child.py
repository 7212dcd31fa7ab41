# SPDX-License-Identifier: MIT
"""The child's side of :mod:`foparq.read.guard.parent`: bounds itself, works, answers and leaves."""

import ctypes
import faulthandler
import logging
import math
import os
import pickle
import signal
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, NoReturn

from foparq.errors import FoparqError

_DIE_WITH_PARENT = 1  #: PR_SET_PDEATHSIG of Linux
_GRACE = 5  #: seconds of processor time beyond the limit of wall time


def serve(
    function: Callable[..., Any],
    args: tuple[Any, ...],
    *,
    seconds: float,
    memory: int,
    answer: int,
    words: int,
    parent: int,
) -> NoReturn:
    """Call a function within bounds, write the pickled answer to a pipe and leave.

    Parameters
    ----------
    function, args
        What to call.
    seconds : float
        Wall time that the parent will wait.
    memory : int
        Bytes beyond what this process has now.
    answer, words : int
        File descriptors: the answer; whatever is printed.
    parent : int
        Process id of the parent.

    Notes
    -----
    The answer is a pair: ``"result"`` and the value, ``"error"`` and a ``FoparqError``, ``"memory"`` and ``None``, or
    ``"crash"`` and the text of a traceback.
    """
    status = 1
    try:
        _hush(words)
        restore = _bound(seconds, memory, parent)
        message = _call(function, args)
        restore()
        with os.fdopen(answer, "wb") as pipe:
            pickle.dump(message, pipe, protocol=5)
        status = 0
    except BaseException:  # noqa: BLE001 - nothing may run on in a forked child
        traceback.print_exc()
    finally:
        # Neither exit handlers nor buffers of the parent belong to the child.
        os._exit(status)


@dataclass(frozen=True, slots=True)
class End:
    """Last frame of a generator."""

    memory: bool  #: it ended because memory ran out


def serve_stream(
    function: Callable[..., Iterator[object]],
    args: tuple[Any, ...],
    *,
    seconds: float,
    at_once: float,
    memory: int,
    answer: int,
    words: int,
    parent: int,
) -> NoReturn:
    """Run a generator within bounds, write what it yields to a pipe, pickled and framed, and leave.

    Parameters
    ----------
    function, args
        The generator.
    seconds : float
        Processor time in all.
    at_once : float
        Processor time between two things. The process ends by ``SIGPROF`` where it is exceeded, also within C.
    memory : int
        Bytes in all: what this process holds now counts.
    answer, words : int
        File descriptors: the frames; whatever is printed.
    parent : int
        Process id of the parent.

    Notes
    -----
    A frame is its length in eight bytes and a pickle. The last holds an :class:`End`.
    """
    status = 1
    try:
        _hush(words)
        lift = _bound(seconds, max(0, memory - _held()), parent, grace=0)
        with os.fdopen(answer, "wb") as pipe:
            try:
                _timed(at_once)
                for thing in function(*args):
                    _timed(0)
                    _write_frame(pipe, thing)
                    _timed(at_once)
                last = End(memory=False)
            except MemoryError:
                last = End(memory=True)
            _timed(0)
            lift()
            _write_frame(pipe, last)
        status = 0
    except BaseException:  # noqa: BLE001 - nothing may run on in a forked child
        traceback.print_exc()
    finally:
        os._exit(status)


def _timed(seconds: float) -> None:
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, seconds)


def _write_frame(pipe: IO[bytes], thing: object) -> None:
    data = pickle.dumps(thing, protocol=5)
    pipe.write(len(data).to_bytes(8, "big"))
    pipe.write(data)
    pipe.flush()


def main() -> NoReturn:
    """Entry of a fresh interpreter: the job comes from stdin, the answer goes to stdout."""
    sys.path[:], parent = pickle.load(sys.stdin.buffer)  # noqa: S301 - written by the parent
    function, args, bounds = pickle.load(sys.stdin.buffer)  # noqa: S301
    answer, words = os.dup(1), os.dup(2)
    if "at_once" in bounds:
        serve_stream(function, args, **bounds, answer=answer, words=words, parent=parent)
    serve(function, args, **bounds, answer=answer, words=words, parent=parent)


def _call(function: Callable[..., Any], args: tuple[Any, ...]) -> tuple[str, object]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return "result", function(*args)
    except MemoryError:
        return "memory", None
    except FoparqError as error:
        return "error", error
    except RecursionError:
        return "crash", traceback.format_exc(limit=20)
    except Exception:  # noqa: BLE001 - the parent tells faults of foparq from faults of the file
        return "crash", traceback.format_exc()


def _hush(words: int) -> None:
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(words, 1)
    os.dup2(words, 2)
    sys.stdout = sys.stderr = os.fdopen(2, "w", encoding="utf-8", errors="backslashreplace", closefd=False)
    faulthandler.enable(2)
    logging.disable(logging.CRITICAL)
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _held() -> int:
    # Bytes of memory in use now; pages shared with the parent count.
    if sys.platform != "linux":
        return 0
    import resource  # noqa: PLC0415 - exists on Unix only

    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * resource.getpagesize()


def _bound(seconds: float, memory: int, parent: int, grace: int = _GRACE) -> Callable[[], None]:
    # Returns what lifts the limit of memory again: the answer is not part of the reading.
    if sys.platform != "linux":
        return lambda: None
    import resource  # noqa: PLC0415 - exists on Unix only

    ctypes.CDLL(None).prctl(_DIE_WITH_PARENT, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    _, highest = resource.getrlimit(resource.RLIMIT_AS)
    wanted = pages * resource.getpagesize() + memory
    allowed = wanted if highest == resource.RLIM_INFINITY else min(wanted, highest)
    resource.setrlimit(resource.RLIMIT_AS, (allowed, highest))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
    processor = math.ceil(seconds) + grace
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(
        resource.RLIMIT_CPU, (processor if most == resource.RLIM_INFINITY else min(processor, most), most)
    )
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (highest, highest))
