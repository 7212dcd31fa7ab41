# SPDX-License-Identifier: MIT
"""A table as a sheet of a workbook: XLSX (openpyxl) or ODS.

Cells count by value, as last calculated; how they are formatted is nobody's business. Hidden rows and columns are read:
what is hidden is delivered. No link to another file is followed, no macro is read.
"""

import contextlib
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.names import folded, nearest
from foparq.read.table.grid import Book
from foparq.read.table.ods import OdsBook
from foparq.read.table.sheet import Asked, Sheet, sheet_of
from foparq.read.table.xlsx import XlsxBook

MOST_BYTES = 50_000_000
MOST_UNPACKED = 500_000_000
_ODS = "application/vnd.oasis.opendocument.spreadsheet"
_SHOWN = 20  #: sheets that a message names


def read_workbook(path: Path, asked: Asked, sheet: str | None) -> Sheet:
    """Table of a workbook.

    Parameters
    ----------
    path : Path
        A regular file.
    sheet : str or None
        Name of the sheet, compared without case and composition of accents; ``None``: the first.

    Raises
    ------
    UnreadableError
        If the file is no workbook that can be read, the sheet is not there, is empty, or is the first and hidden.
    UnsafeError
        If what is packed is too large.
    """
    with _opened(path) as book:
        chosen = _chosen(path, book.sheets, sheet)
        lines = book.lines(chosen)
    if not lines:
        raise UnreadableError("table.no-columns", file=path.name, value="", example=asked.example)
    others = tuple(name for name in book.sheets if name != chosen) if sheet is None else ()
    told = tuple(Skipped(reason=SkippedReason.NOT_ASKED, kind="", layer=name, count=1) for name in others)
    return sheet_of(path.name, lines, asked, skipped=told)


def sheets_of(path: Path) -> dict[str, bool]:
    """Name of each sheet in order, and whether it is visible; raises as :func:`read_workbook`."""
    with _opened(path) as book:
        return dict(book.sheets)


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[Book]:
    try:
        with zipfile.ZipFile(path) as archive:
            _bounded(path, archive)
            yield _book(path, archive)
    except (UnreadableError, UnsafeError, MemoryError):
        raise
    except Exception as error:  # noqa: BLE001 - libraries raise anything on a broken file
        raise UnreadableError("table.workbook-broken", file=path.name, value=type(error).__name__) from None


def _bounded(path: Path, archive: zipfile.ZipFile) -> None:
    # No more is unpacked of a member than it states.
    unpacked = sum(member.file_size for member in archive.infolist())
    for size, limit in ((path.stat().st_size, MOST_BYTES), (unpacked, MOST_UNPACKED)):
        if size > limit:
            raise UnsafeError("read.too-large", file=path.name, value=size, limit=limit)


def _book(path: Path, archive: zipfile.ZipFile) -> Book:
    names = set(archive.namelist())
    if "mimetype" in names and archive.read("mimetype").strip() == _ODS.encode():
        return OdsBook(path.name, archive)
    if "xl/workbook.bin" in names:
        raise UnreadableError("table.old-workbook", file=path.name, value="XLSB")
    if "[Content_Types].xml" in names and any(name.startswith("xl/") for name in names):
        return XlsxBook(path)
    raise UnreadableError("table.not-csv", file=path.name, value="ZIP")


def _chosen(path: Path, sheets: Mapping[str, bool], stated: str | None) -> str:
    known = ", ".join(nearest(stated or "", sheets)[:_SHOWN])
    if not sheets:
        raise UnreadableError("table.sheet-missing", file=path.name, value=stated or "1", known="-")
    if stated is None:
        first = next(iter(sheets))
        if not sheets[first]:
            raise UnreadableError(
                "table.sheet-hidden", file=path.name, value=first, known=known, example=_example(sheets)
            )
        return first
    found = [name for name in sheets if folded(name) == folded(stated)]
    if stated in found or len(found) == 1:
        return stated if stated in found else found[0]
    raise UnreadableError("table.sheet-missing", file=path.name, value=stated, known=known)


def _example(sheets: Mapping[str, bool]) -> str:
    seen: Sequence[str] = [name for name, visible in sheets.items() if visible]
    return f'sheet = "{seen[0] if seen else next(iter(sheets))}"'
