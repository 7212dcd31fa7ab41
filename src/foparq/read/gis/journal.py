# SPDX-License-Identifier: MIT
"""Whether changes of a GeoPackage lie in a file beside it: a write-ahead log or a rollback journal of SQLite.

Formats: "Database File Format", sections 4 (WAL) and 3 (rollback journal), sqlite.org.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

_LOG_MAGIC = (0x377F0682, 0x377F0683)
_LOG_HEADER, _FRAME_HEADER = 32, 24  #: bytes
_JOURNAL_HEADER = 28  #: bytes; zeroed once what it holds is done with


def unsaved(path: Path) -> Path | None:
    """File beside a GeoPackage that holds changes which the GeoPackage itself does not; ``None`` if there is none.

    Parameters
    ----------
    path : Path
        The GeoPackage.

    Notes
    -----
    A log says nothing new if every page that it committed stands in the file as it is: its program was closed without
    tidying up, or copied after it had written everything. What was never committed does not count. A file that is no
    log counts as one that holds changes. O(bytes of the log).
    """
    log, journal = (path.with_name(path.name + ending) for ending in ("-wal", "-journal"))
    if _holds_anything(log) and not _written_back(path, log):
        return log
    if _holds_anything(journal):
        with journal.open("rb") as stream:
            head = stream.read(_JOURNAL_HEADER)
        if any(head):
            return journal
    return None


def _holds_anything(path: Path) -> bool:
    return path.exists() and (not path.is_file() or path.stat().st_size > 0)


def _written_back(path: Path, log: Path) -> bool:
    """Whether every page that a log committed stands in the file."""
    if not log.is_file():
        return False
    with log.open("rb") as stream, path.open("rb") as main:
        head = stream.read(_LOG_HEADER)
        size = int.from_bytes(head[8:12], "big")
        if len(head) < _LOG_HEADER or int.from_bytes(head[:4], "big") not in _LOG_MAGIC or not _is_page(size):
            return False
        committed: dict[int, int] = {}  # place of the last version of each page
        pending: dict[int, int] = {}
        pages = 0
        for at, page, after in _frames(stream, size, head[16:24]):
            pending[page] = at
            if after:
                committed.update(pending)
                pending, pages = {}, after
        if not committed:
            return True
        if path.stat().st_size != pages * size:
            return False
        return all(_page(stream, at, size) == _page(main, (page - 1) * size, size) for page, at in committed.items())


def _is_page(size: int) -> bool:
    return 512 <= size <= 65536 and size & (size - 1) == 0  # noqa: PLR2004 - powers of two between them


def _frames(stream: BinaryIO, size: int, salt: bytes) -> Iterator[tuple[int, int, int]]:
    """Place, page, and pages of the file if the frame commits (else 0), up to the first of another time."""
    at = _LOG_HEADER
    while True:
        stream.seek(at)
        head = stream.read(_FRAME_HEADER)
        if len(head) < _FRAME_HEADER or head[8:16] != salt:
            return
        yield at + _FRAME_HEADER, int.from_bytes(head[:4], "big"), int.from_bytes(head[4:8], "big")
        at += _FRAME_HEADER + size


def _page(stream: BinaryIO, at: int, size: int) -> bytes:
    stream.seek(at)
    return stream.read(size)
