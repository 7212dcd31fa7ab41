# SPDX-License-Identifier: MIT
"""Bytes to an ezdxf document: as they are, or mended in memory, or not at all."""

import gc
import io
import logging
import mmap
import re
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ezdxf import recover
from ezdxf.filemanagement import dxf_file_info, read, readfile

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.drawing import Repair
from foparq.read.dxf.codepage import CodePage, code_page_of, taught
from foparq.read.dxf.damaged import Aside, Depth, set_aside
from foparq.read.dxf.facts import LEAKS
from foparq.read.dxf.removed import handle_in, removed_entities
from foparq.read.dxf.tags import Screen
from foparq.read.guard.sniff import Format, format_of

_BINARY = b"AutoCAD Binary DXF\r\n\x1a\x00"
_BROKEN: tuple[type[Exception], ...] = (*LEAKS, OSError)
_SECTION = re.compile(rb"(?:^|\n)[ \t]*0[ \t]*\r?\n[ \t]*SECTION[ \t]*\r?\n[ \t]*2[ \t]*\r?\n[ \t]*(\w+)")
_NEAR_LINE = re.compile(r"near line:? (\d+)")
_TAIL = 256  #: bytes within which the end marker must stand
_R12 = "AC1009"
UTF8_SINCE = "AC1021"  #: R2007; the code page of the header no longer counts

_Read = tuple[Any, tuple[Repair, ...]]  #: document, and what it took to read it


@dataclass(frozen=True, slots=True)
class Loaded:
    """A document, and what it took to read it."""

    document: Any  #: ezdxf.Drawing
    repairs: tuple[Repair, ...]
    written: frozenset[str] | None  #: handles that stand in the file; None if all of the document's do


def load_document(path: Path, most_bytes: int) -> Loaded:
    """Document of a DXF file.

    Parameters
    ----------
    most_bytes : int
        Larger files are refused unread.

    Raises
    ------
    UnreadableError
        If it is no DXF file, is cut off, or cannot be mended.
    UnsafeError
        If it is too large.
    """
    binary = _sniff(path, most_bytes)
    page = code_page_of(path, binary=binary)
    with _quiet(), taught(page):
        document, repairs = _load(path, binary=binary)
    if not binary:
        repairs += _second_sections(path)
    repairs += _unknown_page(page, document)
    return Loaded(document, repairs, None if binary else _written_handles(path, document))


def _sniff(path: Path, most_bytes: int) -> bool:
    file = path.name
    try:
        if not path.is_file():
            raise UnreadableError("dxf.not-a-file", file=file)
        size = path.stat().st_size
        if size > most_bytes:
            raise UnsafeError("dxf.too-large", file=file, value=size, limit=most_bytes)
        if format_of(path) is not Format.DXF:
            raise UnreadableError("dxf.not-dxf", file=file)
        with path.open("rb") as stream:
            return stream.read(len(_BINARY)) == _BINARY
    except OSError as error:
        raise UnreadableError("dxf.cannot-open", file=file, reason=error.strerror or str(error)) from error


def _second_sections(path: Path) -> tuple[Repair, ...]:
    # A reader takes the last of two sections of one name and forgets the first: half a drawing would pass for all.
    with path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as text:
        names = Counter(_SECTION.findall(text))
    twice = sorted(name.decode("ascii", "replace") for name, count in names.items() if count > 1)
    return tuple(Repair(code="section-twice", text=name) for name in twice)


def _unknown_page(page: CodePage, document: Any) -> tuple[Repair, ...]:  # noqa: ANN401 - ezdxf.Drawing
    # From R2007 on files are in UTF-8, and nobody asks for the code page.
    if not page.unknown or (document.loaded_dxfversion or "") >= UTF8_SINCE:
        return ()
    return (Repair(code="code-page-unknown", kind="$DWGCODEPAGE", text=page.stated, detail=str(document.encoding)),)


def _refuse_truncated(path: Path) -> None:
    # A file that ends inside a section has lost content: half a drawing must not be audited as the whole.
    with path.open("rb") as stream:
        lines = sum(block.count(b"\n") for block in iter(lambda: stream.read(1 << 20), b"")) + 1
        stream.seek(max(0, stream.tell() - _TAIL))
        tail = stream.read().strip(b" \t\r\n\x00\x1a").splitlines()
    if not tail or tail[-1].strip() not in (b"EOF", b"ENDSEC"):
        raise UnreadableError("dxf.truncated", file=path.name, line=lines)


def _load(path: Path, *, binary: bool) -> _Read:
    if binary:
        return _load_binary(path)
    # A value that is no number is exchanged first: mending would read it as some number.
    info = _info(path)
    with path.open("rb") as stream:
        spoilt = not Screen().passes(zip(stream, stream, strict=False))
    if spoilt:
        _refuse_truncated(path)
    aside = set_aside(path, *info, Depth.NUMBERS) if spoilt else None
    # Of what fails, only words are kept: an exception would hold the half of a document that was read.
    try:
        return (_strictly(aside, info[1]), aside.repairs) if aside else (readfile(path), ())
    except _BROKEN as error:
        first = Repair(code=type(error).__name__, detail=_words(error))
    _refuse_truncated(path)
    gc.collect()
    known, aside = aside, set_aside(path, *info, Depth.POINTS)
    if aside and aside != known:
        with suppress(*_BROKEN):
            return _strictly(aside, info[1]), aside.repairs
        gc.collect()
    try:
        return _mended(path, aside, first, info[1])
    except _BROKEN as error:
        reason = _words(error)
    if (others := _load_others(path, info)) is not None:
        return others
    raise _unreadable(path, reason, first)


def _load_binary(path: Path) -> _Read:
    try:
        return readfile(path), ()
    except _BROKEN as error:
        first = Repair(code=type(error).__name__, detail=_words(error))
    gc.collect()
    try:
        return _mended(path, None, first)
    except _BROKEN as error:
        reason = _words(error)
    raise _unreadable(path, reason, first)


def _unreadable(path: Path, reason: str, first: Repair) -> UnreadableError:
    near = _NEAR_LINE.search(reason) or _NEAR_LINE.search(first.detail)
    if near is not None:
        return UnreadableError("dxf.unreadable-line", file=path.name, line=int(near[1]), reason=reason)
    return UnreadableError("dxf.unreadable", file=path.name, reason=reason)


def _info(path: Path) -> tuple[str, str]:
    """Version and encoding as the header tells; those of the oldest files if it cannot be read."""
    try:
        info = dxf_file_info(path)
    except _BROKEN:
        return _R12, "cp1252"
    return info.version, info.encoding


def _strictly(aside: Aside, encoding: str) -> Any:  # noqa: ANN401 - ezdxf.Drawing
    return read(io.TextIOWrapper(io.BytesIO(aside.text), encoding, "surrogateescape"))


def _mended(path: Path, aside: Aside | None, first: Repair, encoding: str = "") -> _Read:
    """Document as ezdxf mends it, and what was changed or left out; ``first`` if nobody tells.

    Parameters
    ----------
    encoding : str
        Of a text file, whose entities are compared with those that are left; empty for a binary one.
    """
    document, auditor = recover.read(io.BytesIO(aside.text)) if aside else recover.readfile(path)
    repairs = _audited(auditor)
    if encoding:
        with path.open("rb") as stream:
            removed = removed_entities(stream, document, encoding, repairs)
        gone = {repair.handle.upper() for repair in removed}
        repairs = (*removed, *(repair for repair in repairs if handle_in(repair) not in gone))
    repairs = (*(aside.repairs if aside else ()), *repairs)
    return document, tuple(dict.fromkeys(repairs)) or (first,)


def _load_others(path: Path, info: tuple[str, str]) -> _Read | None:
    """Document without the entities that cannot be loaded; ``None`` if that is not what ails the file."""
    # First only what no way of reading loads; then also what stops the way that mends.
    for depth in (Depth.LOADING, Depth.STRUCTURE):
        gc.collect()
        aside = set_aside(path, *info, depth)
        if aside is None:
            continue
        with suppress(*_BROKEN):
            if depth is Depth.STRUCTURE:
                return _mended(path, aside, aside.repairs[0], info[1])
            return _strictly(aside, info[1]), aside.repairs
    return None


def _audited(auditor: Any) -> tuple[Repair, ...]:  # noqa: ANN401
    return tuple(
        Repair(code=_code(entry.code), detail=str(entry.message), handle=_handle(entry.entity))
        for entry in (*auditor.errors, *auditor.fixes)
    )


def _words(error: Exception) -> str:
    return " ".join(str(error).split()) or type(error).__name__


def _code(code: Any) -> str:  # noqa: ANN401 - an AuditError or a bare number
    return str(getattr(code, "name", code))


def _handle(entity: Any) -> str:  # noqa: ANN401
    handle = getattr(getattr(entity, "dxf", None), "handle", None)
    return handle if isinstance(handle, str) else ""


def _written_handles(path: Path, document: Any) -> frozenset[str] | None:  # noqa: ANN401
    """Handles that stand in a file of R12 or older, where they are optional and ezdxf makes up those that lack."""
    if document.loaded_dxfversion is not None and document.loaded_dxfversion > _R12:
        return None
    with path.open("rb") as stream:
        # Group codes and values alternate, line by line.
        values = {value.strip() for code, value in zip(stream, stream, strict=False) if code.strip() == b"5"}
    return frozenset(value.decode("ascii", "replace") for value in values if value)


@contextmanager
def _quiet() -> Iterator[None]:
    # ezdxf reports to its log what is reported as repairs here; collecting garbage amid a parse costs a third of it.
    logger = logging.getLogger("ezdxf")
    disabled, collecting = logger.disabled, gc.isenabled()
    logger.disabled = True
    gc.disable()
    try:
        yield
    finally:
        logger.disabled = disabled
        if collecting:
            gc.enable()
