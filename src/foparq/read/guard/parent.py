# SPDX-License-Identifier: MIT
"""A reader in a child process: bounded in time and memory, silent, and unable to fill a file.

The parsers of drawings are large and partly written in C. What a hostile file does to them must not happen to the
audit: the child may hang, grow, crash or print, and the parent learns of it. The limit of memory and the ban on
writing need Linux; elsewhere only time is bounded.
"""

import contextlib
import os
import pickle
import selectors
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from foparq.errors import FoparqError, UnsafeError
from foparq.read.guard.child import serve

T = TypeVar("T")

_CHUNK = 1 << 20
_KEPT_WORDS = 1 << 16  #: bytes of the child's last words that are kept
_LINUX = sys.platform == "linux"


@dataclass(frozen=True, slots=True)
class _End:
    """How a child ended."""

    in_time: bool
    status: int  #: exit code; negative: number of the signal that ended it
    answer: bytes | bytearray
    words: str  #: what it printed last


def guarded(function: Callable[..., T], *args: Any, file: str, seconds: float, memory: int) -> T:  # noqa: ANN401 - any argument
    """Result of a function, computed in a child process within bounds.

    Parameters
    ----------
    function : callable
        Picklable: importable by name, or a ``functools.partial`` of such.
    *args : object
        Picklable arguments.
    file : str
        Name of the file that is read, for messages.
    seconds : float
        Wall time after which the child is killed.
    memory : int
        Bytes that the child may use beyond what it starts with.

    Returns
    -------
    object
        What the function returned.

    Raises
    ------
    UnsafeError
        If time or memory ran out, or the child died.
    FoparqError
        As raised by the function.
    RuntimeError
        If the function raised anything else: a fault of foparq, not of the file. The text is the child's traceback.

    Notes
    -----
    The child is forked where that is safe, which costs 10 ms: on Linux, while the process has one thread. Elsewhere a
    fresh interpreter is started. On Linux the child dies with its parent. Warnings of the libraries stay in the child.
    """
    run = _fork if can_fork() else _start
    end = run(function, args, seconds, memory)
    if not end.in_time:
        raise UnsafeError("read.too-slow", file=file, seconds=int(seconds))
    try:
        kind, value = pickle.loads(end.answer)  # noqa: S301 - written by this program's own child
    except (EOFError, pickle.UnpicklingError):
        raise _died(end, file) from None
    if kind == "result":
        return value  # type: ignore[no-any-return]
    if kind == "memory":
        raise UnsafeError("read.too-much-memory", file=file, memory=f"{memory / 1e6:.0f} MB")
    if isinstance(value, FoparqError):
        raise value
    raise RuntimeError(value)


def can_fork() -> bool:
    """Whether a fork of this process is safe: on Linux, while it has one thread."""
    return _LINUX and threading.active_count() == 1


def _died(end: _End, file: str) -> UnsafeError:
    reason = f"exit code {end.status}"
    if end.status < 0:
        with contextlib.suppress(ValueError):
            reason = signal.Signals(-end.status).name
    error = UnsafeError("read.died", file=file, value=reason)
    if end.words.strip():
        error.add_note(end.words.strip())
    return error


def _fork(function: Callable[..., Any], args: tuple[Any, ...], seconds: float, memory: int) -> _End:
    deadline = time.monotonic() + seconds
    parent = os.getpid()
    import fcntl  # noqa: PLC0415 - exists on Unix only

    answer_out, answer_in = os.pipe()
    words_out, words_in = os.pipe()
    with contextlib.suppress(OSError):
        fcntl.fcntl(answer_in, fcntl.F_SETPIPE_SZ, _CHUNK)
    child = os.fork()
    if child == 0:
        serve(function, args, seconds=seconds, memory=memory, answer=answer_in, words=words_in, parent=parent)
    os.close(answer_in)
    os.close(words_in)
    answer, words = bytearray(), bytearray()
    status = None
    try:
        in_time = _listen({answer_out: answer, words_out: words}, deadline)
        if in_time:
            status = _left(child, deadline)
    finally:
        os.close(answer_out)
        os.close(words_out)
        if status is None:
            os.kill(child, signal.SIGKILL)
            status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return _End(in_time, status, answer, words[-_KEPT_WORDS:].decode("utf-8", "replace"))


def _listen(pipes: dict[int, bytearray], deadline: float) -> bool:
    # Both pipes are drained until they end; false if the time runs out first.
    with selectors.DefaultSelector() as selector:
        for pipe in pipes:
            selector.register(pipe, selectors.EVENT_READ)
        while selector.get_map():
            left = deadline - time.monotonic()
            if left <= 0:
                return False
            for key, _ in selector.select(left):
                piece = os.read(key.fd, _CHUNK)
                if not piece:
                    selector.unregister(key.fd)
                pipes[key.fd] += piece
    return True


def _left(child: int, deadline: float) -> int | None:
    # A child whose pipes have ended is about to leave; None if it stays beyond the deadline.
    while True:
        pid, status = os.waitpid(child, os.WNOHANG)
        if pid:
            return os.waitstatus_to_exitcode(status)
        if time.monotonic() > deadline:
            return None
        time.sleep(0.001)


def _start(function: Callable[..., Any], args: tuple[Any, ...], seconds: float, memory: int) -> _End:
    job = pickle.dumps((sys.path, os.getpid()), protocol=5) + pickle.dumps(
        (function, args, {"seconds": seconds, "memory": memory}), protocol=5
    )
    command = [sys.executable, "-W", "ignore", "-c", "from foparq.read.guard.child import main; main()"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:  # noqa: S603 - own interpreter
        try:
            answer, words = process.communicate(job, timeout=seconds)
            in_time = True
        except subprocess.TimeoutExpired:
            process.kill()
            answer, words = process.communicate()
            in_time = False
        except BaseException:
            process.kill()
            raise
    return _End(in_time, process.returncode, answer, words[-_KEPT_WORDS:].decode("utf-8", "replace"))
