# SPDX-License-Identifier: MIT
"""Exit code of a finished audit."""

from foparq.cli.exits import Exit
from foparq.evaluate.quality import Verdict
from foparq.findings.outcome import Status
from foparq.findings.table import Severity
from foparq.model.delivery import SourceStatus
from foparq.report.record import AuditRecord


def exit_of(record: AuditRecord) -> Exit:
    """Exit code of a finished audit: a proven fault first, then refused input, then what stays open."""
    if record.loose:
        return _exit_of_files(record)
    if record.quality.verdict is Verdict.ACCEPTED:
        return Exit.ACCEPTED
    if record.quality.verdict is Verdict.REJECTED:
        return Exit.REJECTED
    return Exit.REFUSED if _refused(record) else Exit.UNDECIDED


def _exit_of_files(record: AuditRecord) -> Exit:
    if any(severity != Severity.NOTE for severity in record.findings.severity.tolist()):
        return Exit.REJECTED
    if _refused(record):
        return Exit.REFUSED
    open_ends = {"unit-unknown", "unit-doubtful", "crashed"}
    if any(outcome.status is Status.CRASHED or outcome.because in open_ends for outcome in record.outcomes):
        return Exit.UNDECIDED
    return Exit.ACCEPTED


def _refused(record: AuditRecord) -> bool:
    return any(source.status in {SourceStatus.REFUSED, SourceStatus.MISSING} for source in record.delivery.sources)
