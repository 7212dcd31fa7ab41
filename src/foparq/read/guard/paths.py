# SPDX-License-Identifier: MIT
"""Which files of a delivery may be opened, and their hashes."""

import hashlib
import re
import stat
import unicodedata
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path, PurePosixPath, PureWindowsPath

from foparq.errors import UnreadableError, UnsafeError
from foparq.names import folded

_SCHEME = re.compile(r"^[A-Za-z][A-Za-z0-9+.\-]*:")
_SURROGATE = re.compile("[\ud800-\udfff]")  #: stands for bytes that are no UTF-8
_LONGEST = 4096  #: letters of a path
_SHOWN = 80  #: letters of an odd path that a message repeats
MOST_FILES = 10_000  #: files of a folder that are listed


def inside(root: Path, named: str) -> Path:
    """File that a manifest names, if it lies inside the delivery.

    Parameters
    ----------
    root : Path
        Folder of the delivery.
    named : str
        As the manifest writes it: relative, with ``/``.

    Returns
    -------
    Path
        Absolute, links resolved. It need not exist. Accents may be composed in the manifest and decomposed in the name
        of the file, as some systems write them, or the other way round; a name that differs in the case of letters, as
        where the delivery was made on Windows, is taken if it is the only such one.

    Raises
    ------
    UnsafeError
        If the name is absolute, leads out of the folder (also through a link), or is an address instead of a path.
    """
    example = "desenhos/fachada.dxf"
    if not named.strip() or any(ord(letter) < ord(" ") for letter in named):
        raise UnsafeError("read.path-odd", file=named, example=example)
    if named.startswith(("/vsi", "<")):
        raise UnsafeError("read.path-address", file=named, example=example)
    if PurePosixPath(named).is_absolute() or (PureWindowsPath(named).anchor and not _SCHEME.match(named)):
        raise UnsafeError("read.path-absolute", file=named, example=example)
    if len(named) > _LONGEST:
        raise UnsafeError("read.path-odd", file=f"{named[:_SHOWN]}...", example=example)
    home = root.resolve()
    try:
        full = (home / named.replace("\\", "/")).resolve()
    except (OSError, RuntimeError):
        # A ring of links.
        raise UnsafeError("read.path-outside", file=named, example=example) from None
    if not full.is_relative_to(home):
        raise UnsafeError("read.path-outside", file=named, example=example)
    try:
        there = full.exists()
    except OSError:
        # A part that is longer than any file system allows.
        raise UnsafeError("read.path-odd", file=f"{named[:_SHOWN]}...", example=example) from None
    if _SCHEME.match(named) and not there:
        raise UnsafeError("read.path-address", file=named, example=example)
    if not there:
        other = alike(full, lambda name: unicodedata.normalize("NFC", name)) or alike(full, folded)
        # What it leads to may lie outside, as any other path.
        return inside(root, other.relative_to(home).as_posix()) if other is not None else full
    return full


def alike(path: Path, key: Callable[[str], str]) -> Path | None:
    """The only other path that exists and whose names have the same keys as those of a path that does not exist.

    Parameters
    ----------
    path : Path
        Absolute. Of each folder at most :data:`MOST_FILES` entries are looked at.
    key : callable
        What of a name counts.
    """
    folder = path.parent if path.parent.exists() else alike(path.parent, key)
    if folder is None or not folder.is_dir():
        return None
    try:
        same = [entry for entry in islice(folder.iterdir(), MOST_FILES) if key(entry.name) == key(path.name)]
        same = [entry for entry in same if entry != path and entry.exists()]
    except OSError:
        return None
    return same[0] if len(same) == 1 else None


def name_of(path: str) -> str:
    """Path as text that can be printed and written: bytes that are no UTF-8 are shown as U+FFFD."""
    return _SURROGATE.sub("\ufffd", path)


def fit_to_read(path: Path, limit: int) -> int:
    """Size of a file in bytes, if it is one and not too large.

    Raises
    ------
    UnreadableError
        If it is a folder, a device or a pipe, or may not be read.
    UnsafeError
        If it is larger than ``limit`` bytes.
    """
    found = path.stat()
    if not stat.S_ISREG(found.st_mode):
        raise UnreadableError("read.not-a-file", file=path.name)
    if found.st_size > limit:
        raise UnsafeError("read.too-large", file=path.name, value=found.st_size, limit=limit)
    return found.st_size


def sha256_of(path: Path) -> str:
    """SHA-256 of the bytes of a file, in hexadecimal."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def files_of(root: Path, leave: frozenset[str]) -> Iterator[Path]:
    """Files below a folder in order of their names, without hidden ones and without following links to folders.

    Parameters
    ----------
    root : Path
        Folder.
    leave : frozenset of str
        Names of folders directly below that are passed over.

    Yields
    ------
    Path
        At most :data:`MOST_FILES` and one more, by which the caller sees that there are too many.
    """
    left = MOST_FILES + 1
    waiting = [root]
    while waiting:
        folder = waiting.pop()
        deeper: list[Path] = []
        try:
            entries = sorted(folder.iterdir())
        except OSError:
            continue
        for entry in entries:
            if entry.name.startswith(".") or (folder == root and entry.name in leave):
                continue
            if entry.is_dir() and not entry.is_symlink():
                deeper.append(entry)
                continue
            yield entry
            left -= 1
            if left == 0:
                return
        waiting.extend(reversed(deeper))
