# SPDX-License-Identifier: MIT
"""What a hostile file can do to its reader, and what the audit learns of it."""

import os
import signal
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
import shapely

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.items import Items
from foparq.read.guard.parent import guarded

MEMORY = 400_000_000
pytestmark = pytest.mark.usefixtures("alone")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="needs the limits of Linux")


def run(function: object, *args: object, seconds: float = 30.0, memory: int = MEMORY) -> object:
    return guarded(function, *args, file="fachada.dxf", seconds=seconds, memory=memory)  # type: ignore[arg-type]


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """No thread of another test decides how the child is started."""
    monkeypatch.setattr(threading, "active_count", lambda: 1)


def endless() -> NoReturn:
    while True:
        pass


def hog() -> NoReturn:
    kept = []
    while True:
        kept.append(bytearray(10_000_000))


def broken() -> NoReturn:
    message = "an index beyond the end"
    raise IndexError(message)


def unreadable() -> NoReturn:
    raise UnreadableError("read.empty", file="fachada.dxf")


def fault() -> NoReturn:
    os.kill(os.getpid(), signal.SIGSEGV)
    raise AssertionError


def leave() -> NoReturn:
    os._exit(7)


def cut_short() -> object:
    return Quits()


class Quits:
    def __reduce__(self) -> NoReturn:
        os._exit(0)


def test_the_value_comes_back() -> None:
    assert run(pow, 2, 10) == 1024


def test_an_endless_reader_is_stopped() -> None:
    with pytest.raises(UnsafeError) as caught:
        run(endless, seconds=0.3)
    assert caught.value.message == "read.too-slow"
    assert caught.value.fields["file"] == "fachada.dxf"


@LINUX
def test_a_reader_that_grows_is_stopped() -> None:
    with pytest.raises(UnsafeError) as caught:
        run(hog)
    assert caught.value.message == "read.too-much-memory"
    assert caught.value.fields["memory"] == "400 MB"


@pytest.mark.parametrize(
    ("reader", "reason"),
    [(os.abort, "SIGABRT"), (fault, "SIGSEGV"), (leave, "exit code 7"), (cut_short, "exit code 0")],
)
def test_a_reader_that_dies_is_an_unsafe_file(reader: object, reason: str) -> None:
    with pytest.raises(UnsafeError) as caught:
        run(reader)
    assert caught.value.message == "read.died"
    assert caught.value.fields["value"] == reason


def test_an_error_of_ours_about_the_file_passes() -> None:
    with pytest.raises(UnreadableError) as caught:
        run(unreadable)
    assert caught.value.fields == {"file": "fachada.dxf"}


def test_any_other_exception_is_our_crash_with_its_traceback() -> None:
    with pytest.raises(RuntimeError) as caught:
        run(broken)
    assert "in broken" in str(caught.value)
    assert "IndexError: an index beyond the end" in str(caught.value)


def test_nothing_is_printed(capfd: pytest.CaptureFixture[str]) -> None:
    def chatter() -> int:
        print("python")  # noqa: T201
        os.write(1, b"stdout of C\n")
        os.write(2, b"stderr of C\n")
        warnings.warn("a driver complains", RuntimeWarning, stacklevel=1)
        return 1

    assert run(chatter) == 1
    assert capfd.readouterr() == ("", "")


@LINUX
def test_no_file_can_be_filled(tmp_path: Path) -> None:
    target = tmp_path / "written"

    def write() -> str:
        try:
            target.write_bytes(b"0123456789")
        except OSError as error:
            return type(error).__name__
        return "written"

    assert run(write) == "OSError"
    assert target.read_bytes() == b""


@LINUX
def test_children_are_collected_and_descriptors_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    fork, children = os.fork, []

    def counted() -> int:
        children.append(fork())
        return children[-1]

    monkeypatch.setattr(os, "fork", counted)
    before = len(list(Path("/proc/self/fd").iterdir()))
    assert run(pow, 2, 3) == 8
    for reader in (os.abort, endless):
        with pytest.raises(UnsafeError):
            run(reader, seconds=0.2)
    assert len(list(Path("/proc/self/fd").iterdir())) == before
    assert len(children) == 3
    for child in children:
        with pytest.raises(ChildProcessError):
            os.waitpid(child, os.WNOHANG)


@LINUX
def test_the_child_dies_with_its_parent(tmp_path: Path) -> None:
    note = tmp_path / "pid"
    note.touch()
    middle = os.fork()
    if middle == 0:

        def tell() -> NoReturn:
            # Files cannot grow in the child: the number goes into the name.
            note.rename(tmp_path / f"pid-{os.getpid()}")
            endless()

        try:
            run(tell, seconds=60)
        finally:
            os._exit(0)
    grandchild = awaited(tmp_path)
    os.kill(middle, signal.SIGKILL)
    os.waitpid(middle, 0)
    assert gone(grandchild)


def awaited(folder: Path) -> int:
    while True:
        for path in folder.glob("pid-*"):
            return int(path.name.removeprefix("pid-"))
        time.sleep(0.01)


def gone(pid: int) -> bool:
    for _ in range(1000):
        try:
            state = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return True
        if state == "Z":
            return True
        time.sleep(0.01)
    return False


def many(n: int) -> Items:
    numbers = np.arange(n)
    geometry = shapely.linestrings(np.stack([np.column_stack([numbers, numbers + k]) for k in range(10)], axis=1))
    geometry[3] = None
    geometry[5] = shapely.from_wkt("POINT Z (1 2 3)")
    geometry[6] = shapely.from_wkt("POLYGON EMPTY")
    names = np.array([f"plots:{number}" for number in numbers], dtype=object)
    layers = np.array(["Vãos_Ç", "a\0b", ""] * (n // 3 + 1), dtype=object)[:n]
    flags = numbers % 2 == 0
    return Items(
        geometry=geometry, layer=layers, kind=np.full(n, "LineString", dtype=object),
        role=np.full(n, "line", dtype=object), item=names,
        handle=np.array([chr(0) + name for name in names], dtype=object), inserts=np.full(n, "", dtype=object),
        colour=np.full(n, 256, dtype=np.int32), closed=flags, visible=~flags, paper=flags.copy(),
    )  # fmt: skip


def test_items_come_back_as_they_were() -> None:
    there, here = run(many, 1000), many(1000)
    assert isinstance(there, Items)
    same = shapely.equals_identical(there.geometry, here.geometry)
    assert same[shapely.is_valid_input(here.geometry) & ~shapely.is_missing(here.geometry)].all()
    assert there.geometry[3] is None
    for name in ("layer", "kind", "role", "item", "handle", "inserts", "colour", "closed", "visible", "paper"):
        assert getattr(there, name).tolist() == getattr(here, name).tolist(), name
    assert not there.item.flags.writeable


def test_a_process_with_threads_starts_a_fresh_interpreter(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threading, "active_count", lambda: len(threading.enumerate()))
    done = threading.Event()
    thread = threading.Thread(target=done.wait)
    thread.start()
    try:
        assert run(os.path.join, "a", "b") == str(Path("a") / "b")
        with pytest.raises(UnsafeError) as died:
            run(os.abort)
        with pytest.raises(UnsafeError) as slow:
            run(time.sleep, 60, seconds=2.0)
        with pytest.raises(RuntimeError, match="TypeError"):
            run(len, 3)
    finally:
        done.set()
        thread.join()
    assert died.value.fields["value"] == "SIGABRT"
    assert slow.value.message == "read.too-slow"


@LINUX
def test_where_less_memory_is_allowed_than_a_reader_may_take_files_are_read_all_the_same() -> None:
    # As after "ulimit -v": nobody may take more than that, nor wish to.
    text = (
        "import resource; resource.setrlimit(resource.RLIMIT_AS, (1_600_000_000,) * 2); "
        "from foparq.read.guard.parent import guarded; "
        "print(guarded(abs, -3, file='a.dxf', seconds=30.0, memory=2_000_000_000))"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=False, timeout=60)
    assert (done.stdout.strip(), done.returncode) == ("3", 0), done.stderr
