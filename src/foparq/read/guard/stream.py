# SPDX-License-Identifier: MIT
"""A generator in a child process: bounded in time and memory, told thing by thing.

What it told before it was stopped is not lost.
"""

import contextlib
import os
import pickle
import selectors
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from foparq.read.guard.child import End, serve_stream
from foparq.read.guard.parent import can_fork

_CHUNK = 1 << 20
_KEPT_WORDS = 1 << 16  #: bytes of the child's last words that are kept
#: a child that waits for nothing it can name is stopped too: so many times its processor time, and seconds more
_PATIENCE, _MORE = 20.0, 60.0
#: signals by which a child ends that exceeded its bounds; the last two are the system's answer to too little memory
_SPENT = ("SIGPROF", "SIGXCPU", "SIGKILL", "SIGABRT")


@dataclass(frozen=True, slots=True)
class Stopped:
    """A generator that did not come to its end."""

    spent: bool  #: time or memory ran out; else it failed
    words: str = ""  #: what the child printed last


def streamed(
    function: Callable[..., Iterator[object]], args: tuple[Any, ...], *, seconds: float, at_once: float, memory: int
) -> Iterator[object]:
    """What a generator yields, computed in a child process within bounds.

    Parameters
    ----------
    function : callable
        Importable by name, as are its arguments picklable, where the process has several threads.
    seconds, at_once : float
        Processor time in all, and between two things.
    memory : int
        Bytes that the child may hold in all, those it starts with included.

    Yields
    ------
    object
        What the generator yields; last a :class:`Stopped` if it did not end by itself.

    Notes
    -----
    Bounds of memory and of processor time need Unix. On Linux the child dies with its parent.
    """
    bounds = {"seconds": seconds, "at_once": at_once, "memory": memory}
    child = _forked(function, args, bounds) if can_fork() else _started(function, args, bounds)
    try:
        yield from _frames(child, time.monotonic() + _PATIENCE * seconds + _MORE)
    finally:
        child.end()


@dataclass
class _Child:
    pid: int
    answer: int
    words: int
    process: subprocess.Popen[bytes] | None = None
    status: int | None = None
    said: bytearray = field(default_factory=bytearray)

    def leave(self) -> int:
        """Exit status of a child whose pipes have ended; negative: the signal that ended it."""
        if self.status is None:
            if self.process is not None:
                self.status = self.process.wait()
            else:
                self.status = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        return self.status

    def end(self) -> None:
        """Make sure that nothing runs on."""
        for pipe in (self.answer, self.words):
            with contextlib.suppress(OSError):
                os.close(pipe)
        if self.status is None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)
            self.leave()


def _forked(function: Callable[..., Iterator[object]], args: tuple[Any, ...], bounds: dict[str, Any]) -> _Child:
    answer_out, answer_in = os.pipe()
    words_out, words_in = os.pipe()
    parent = os.getpid()
    pid = os.fork()
    if pid == 0:
        serve_stream(function, args, **bounds, answer=answer_in, words=words_in, parent=parent)
    os.close(answer_in)
    os.close(words_in)
    return _Child(pid, answer_out, words_out)


def _started(function: Callable[..., Iterator[object]], args: tuple[Any, ...], bounds: dict[str, Any]) -> _Child:
    job = pickle.dumps((sys.path, os.getpid()), protocol=5) + pickle.dumps((function, args, bounds), protocol=5)
    command = [sys.executable, "-c", "from foparq.read.guard.child import main; main()"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # noqa: S603 - own interpreter
    assert process.stdin is not None  # noqa: S101 - narrows the type
    assert process.stdout is not None  # noqa: S101
    assert process.stderr is not None  # noqa: S101
    answer, words = os.dup(process.stdout.fileno()), os.dup(process.stderr.fileno())
    process.stdout.close()
    process.stderr.close()
    with contextlib.suppress(BrokenPipeError):  # it died: its words and its status tell why
        process.stdin.write(job)
        process.stdin.close()
    return _Child(process.pid, answer, words, process)


def _frames(child: _Child, deadline: float) -> Iterator[object]:
    buffer = bytearray()
    with selectors.DefaultSelector() as selector:
        for pipe in (child.answer, child.words):
            selector.register(pipe, selectors.EVENT_READ)
        while selector.get_map():
            left = deadline - time.monotonic()
            if left <= 0:
                yield Stopped(spent=True)
                return
            for key, _ in selector.select(left):
                piece = os.read(key.fd, _CHUNK)
                if not piece:
                    selector.unregister(key.fd)
                elif key.fd == child.words:
                    child.said = (child.said + piece)[-_KEPT_WORDS:]
                else:
                    buffer += piece
            for thing in _whole(buffer):
                if isinstance(thing, End):
                    if thing.memory:
                        yield Stopped(spent=True)
                    return
                yield thing
    yield _end_of(child)


def _end_of(child: _Child) -> Stopped:
    """How a child ended that told no end."""
    status = child.leave()
    with contextlib.suppress(ValueError):
        if signal.Signals(-status).name in _SPENT:
            return Stopped(spent=True)
    return Stopped(spent=False, words=f"exit status {status}\n{child.said.decode('utf-8', 'replace')}")


def _whole(buffer: bytearray) -> Iterator[object]:
    """Things of the frames that have arrived whole; they are taken from the buffer."""
    while len(buffer) >= 8:  # noqa: PLR2004 - a length
        size = int.from_bytes(buffer[:8], "big")
        if len(buffer) < 8 + size:
            return
        frame = bytes(buffer[8 : 8 + size])
        del buffer[: 8 + size]
        yield pickle.loads(frame)  # noqa: S301 - written by this program's own child
