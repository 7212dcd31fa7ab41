# SPDX-License-Identifier: MIT
"""All report files of one audit: written aside, complete, then moved into place."""

import errno
import os
import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from foparq.errors import WriteError
from foparq.read.guard.stage import mark, sweep
from foparq.report.audit_json import write_audit_json, write_findings_jsonl
from foparq.report.findings_gpkg import write_findings_gpkg
from foparq.report.iso19157 import write_quality_xml
from foparq.report.page.page import write_page
from foparq.report.record import AuditRecord

Writer = Callable[[AuditRecord, Path], None]

#: file name and its writer, in the order they are written
WRITERS: dict[str, Writer] = {
    "audit.json": write_audit_json,
    "findings.jsonl": write_findings_jsonl,
    "findings.gpkg": write_findings_gpkg,
    "quality.xml": write_quality_xml,
    "report.html": write_page,
}
LOG = "crash.log"  #: only where a rule or a reader crashed


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


def write_reports(
    record: AuditRecord, log: Sequence[str], folder: Path, progress: Callable[[str], None] | None = None
) -> list[Path]:
    """Write every report, or none.

    Parameters
    ----------
    record : AuditRecord
    log : sequence of str
        Tracebacks of what crashed on our side.
    folder : Path
        Where the reports go. Files of an earlier run are replaced.
    progress : callable, optional
        Told the name of each file before it is written.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    WriteError
        If a file cannot be written; an earlier report then stays as it was.
    """
    writable(folder)
    sweep(folder)
    aside = Path(tempfile.mkdtemp(prefix=f".{mark()}", dir=folder))
    try:
        for name, writer in WRITERS.items():
            if progress is not None:
                progress(name)
            writer(record, aside / name)
        if log:
            (aside / LOG).write_text("\n".join(log), encoding="utf-8")
        for path in aside.iterdir():
            _to_disk(path)
        for path in aside.iterdir():
            if (folder / path.name).is_dir():  # told before the first file is replaced
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(folder / path.name))
        (folder / LOG).unlink(missing_ok=True)
        return [path.replace(folder / path.name) for path in sorted(aside.iterdir())]
    except OSError as error:
        raise WriteError(
            "write.failed", file=str(folder), value=error.strerror or str(error), example="--out /tmp/audit"
        ) from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _to_disk(path: Path) -> None:
    """Make sure the bytes are on disk: a full disk must be noticed before anything is moved."""
    with path.open("rb") as stream:
        os.fsync(stream.fileno())
