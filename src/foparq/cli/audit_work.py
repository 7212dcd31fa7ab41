# SPDX-License-Identifier: MIT
"""What ``foparq audit`` does."""

from pathlib import Path

from foparq.audit import audit, find_manifest
from foparq.cli.common import progress_on_stderr
from foparq.cli.exit_of import exit_of
from foparq.cli.show import show
from foparq.report.files import writable, write_reports
from foparq.report.words import Words

OUT = "audit"  #: folder beside the manifest


def audit_work(say: Words, *, asked: str | None, delivery: Path, out: Path | None, form: str) -> int:
    """Audit a delivery, write the reports, tell the verdict; returns the exit code."""
    folder = out or find_manifest(delivery).parent / OUT
    writable(folder)
    with progress_on_stderr(say) as progress:
        done = audit(delivery, language=asked, otherwise=say.language, progress=progress)
        written = write_reports(done.record, done.log, folder, progress)
    show(written.record, form, say, written.paths)
    return int(exit_of(written.record.quality))
