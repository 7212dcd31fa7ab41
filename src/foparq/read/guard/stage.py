# SPDX-License-Identifier: MIT
"""A private folder in which delivered files have plain names.

Libraries take parts of a path for syntax (``!``, ``#``, ``?``, ``.zip``), look for further files beside the one they
are given, and leave files of their own there. What they are handed instead is a link of a plain name, alone in a folder
of this program.
"""

import contextlib
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from foparq.errors import WriteError

_PREFIX = "foparq"
_OURS = re.compile(rf"^\.?{_PREFIX}-(?P<space>[0-9]+)-(?P<process>[0-9]+)-")
_UNIX = os.name == "posix"


@contextlib.contextmanager
def staged(files: Mapping[str, Path]) -> Iterator[Path]:
    """Links to delivered files.

    Parameters
    ----------
    files : mapping of str to Path
        Plain name to file; the first is the one to open.

    Yields
    ------
    Path
        The first link. Where links need a privilege (Windows), the delivered file itself.

    Raises
    ------
    WriteError
        If there is no room for a folder.
    """
    first = next(iter(files))
    if not _UNIX:
        yield files[first].resolve()
        return
    with private_folder() as folder:
        for name, path in files.items():
            (folder / name).symlink_to(path.resolve())
        yield folder / first


@contextlib.contextmanager
def private_folder() -> Iterator[Path]:
    """A temporary folder, gone afterwards; should this process be killed, the next run removes it.

    Raises
    ------
    WriteError
        If no temporary folder can be used: there is none, or it is full.
    """
    folder = _made()
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def mark() -> str:
    """Beginning of a temporary name: tells whose it is, and whether that process still runs."""
    return f"{_PREFIX}-{_space()}-{os.getpid()}-"


def sweep(folder: Path | None = None) -> None:
    """Remove what killed runs left behind.

    Parameters
    ----------
    folder : Path, optional
        Where to look; the temporary folders of the system if left out.
    """
    if not _UNIX:
        return
    for place in _places() if folder is None else [str(folder)]:
        with contextlib.suppress(OSError), os.scandir(place) as entries:
            for entry in entries:
                found = _OURS.match(entry.name)
                # A folder of another process space may belong to a process that only looks dead from here.
                if found and found["space"] == _space() and _is_abandoned(entry, int(found["process"])):
                    shutil.rmtree(entry.path, ignore_errors=True)


def _is_abandoned(entry: os.DirEntry[str], process: int) -> bool:
    if not entry.is_dir(follow_symlinks=False) or entry.stat(follow_symlinks=False).st_uid != os.getuid():
        return False
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    except (PermissionError, OverflowError):
        return False
    return False


def _space() -> str:
    # Numbers of processes mean something within one namespace only.
    with contextlib.suppress(OSError):
        return "".join(filter(str.isdigit, str(Path("/proc/self/ns/pid").readlink())))
    return "0"


def _places() -> list[str]:
    # Never the working folder, which tempfile falls back to: it may be the delivery.
    named = [os.environ.get(name, "") for name in ("TMPDIR", "TEMP", "TMP")]
    return list(dict.fromkeys(folder for folder in (*named, "/tmp", "/var/tmp") if folder))  # noqa: S108 - tried in turn


def _made() -> Path:
    places = _places() if _UNIX else [tempfile.gettempdir()]
    reasons = []
    for place in places:
        try:
            return Path(tempfile.mkdtemp(prefix=mark(), dir=place))
        except OSError as error:
            reasons.append(f"{place}: {error.strerror or error}")
    raise WriteError("write.temporary", file=places[0], value="; ".join(reasons), example="TMPDIR=/var/tmp")
