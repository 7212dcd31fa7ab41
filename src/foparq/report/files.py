# SPDX-License-Identifier: MIT
"""All report files of one audit: written aside, complete, then moved into place."""

import errno
import os
import shutil
import tempfile
import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Any

from foparq.errors import WriteError
from foparq.evaluate.late_doubt import without_reports
from foparq.read.guard.stage import mark, sweep
from foparq.report.formats import WRITTEN, Format
from foparq.report.harmless import log_text
from foparq.report.record import AuditRecord

LOG = "crash.log"  #: only where a rule, a reader or a report crashed
_PIECE = 1000  #: lines that go out together

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Written:
    """What became of the reports of one audit."""

    record: AuditRecord  #: as the reports tell it: a report that crashed leaves the question open
    paths: tuple[Path, ...]
    log: tuple[str, ...]  #: tracebacks of everything that crashed on our side


def text_of(record: AuditRecord, form: Format) -> Iterator[str]:
    """A report that is text, in pieces of many lines."""
    lines = iter(_function(form.lines)(record))
    while piece := list(islice(lines, _PIECE)):
        yield "\n".join(piece) + "\n"


def writable(folder: Path) -> None:
    """Make sure that reports can be written, before any work is done.

    Raises
    ------
    WriteError
        If the folder cannot be made or written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise WriteError(
            "write.folder", file=str(folder), value=error.strerror or str(error), example="--out /tmp/audit"
        ) from None


def write_reports(record: AuditRecord, log: Sequence[str], folder: Path, progress: Progress | None = None) -> Written:
    """Write every report, or, if the folder does not take them, none.

    A report that crashes costs no other one: it is left out, and all others tell of it.

    Parameters
    ----------
    log : sequence of str
        Tracebacks of what crashed on our side before.
    folder : Path
        Where the reports go. Files of an earlier run are replaced.
    progress : callable, optional
        Told the name of each file before it is written.

    Raises
    ------
    WriteError
        If a file cannot be written; an earlier report then stays as it was.
    """
    writable(folder)
    sweep(folder)
    aside = Path(tempfile.mkdtemp(prefix=f".{mark()}", dir=folder))
    try:
        record, traces = _write_into(aside, record, progress)
        traces = (*log, *traces)
        if traces:
            (aside / LOG).write_text(log_text(traces), encoding="utf-8")
        return Written(record=record, paths=_moved(aside, folder), log=traces)
    except OSError as error:
        raise WriteError(
            "write.failed", file=str(folder), value=error.strerror or str(error), example="--out /tmp/audit"
        ) from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _write_into(aside: Path, record: AuditRecord, progress: Progress | None) -> tuple[AuditRecord, tuple[str, ...]]:
    """Write what can be written; returns the record as it was told, and the tracebacks of what crashed."""
    crashed: dict[str, str] = {}
    while True:
        told = _with_crashes(record, tuple(crashed))
        known = len(crashed)
        for form in (form for form in WRITTEN if form.file not in crashed):
            if progress is not None:
                progress(form.file)
            try:
                _write(told, form, aside / form.file)
            except OSError:
                raise
            except Exception:  # noqa: BLE001 - our fault, whatever it is, never costs the other reports
                crashed[form.file] = traceback.format_exc()
                (aside / form.file).unlink(missing_ok=True)
        if len(crashed) == known:
            return told, tuple(crashed.values())
        # What was written meanwhile knows nothing of it: once more.


def _with_crashes(record: AuditRecord, reports: tuple[str, ...]) -> AuditRecord:
    if not reports:
        return record
    return replace(record, crashed=reports, quality=without_reports(record.quality, reports))


def _write(record: AuditRecord, form: Format, path: Path) -> None:
    if form.writer:
        _function(form.writer)(record, path)
        return
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(text_of(record, form))


def _function(name: str) -> Callable[..., Any]:
    module, _, function = name.partition(":")
    made: Callable[..., Any] = getattr(import_module(f"foparq.report.{module}"), function)
    return made


def _moved(aside: Path, folder: Path) -> tuple[Path, ...]:
    """Move the files into place; what an earlier run left and this one could not make goes."""
    made = sorted(aside.iterdir())
    for path in made:
        _to_disk(path)
    names = [*(form.file for form in WRITTEN), LOG]
    for name in names:
        if (folder / name).is_dir():  # told before the first file is replaced
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(folder / name))
    for name in set(names) - {path.name for path in made}:
        (folder / name).unlink(missing_ok=True)
    return tuple(path.replace(folder / path.name) for path in made)


def _to_disk(path: Path) -> None:
    """Make sure the bytes are on disk: a full disk must be noticed before anything is moved."""
    with path.open("rb") as stream:
        os.fsync(stream.fileno())
