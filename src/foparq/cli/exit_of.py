# SPDX-License-Identifier: MIT
"""Exit code of a finished audit."""

from foparq.cli.exits import Exit
from foparq.evaluate.quality import Verdict
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Severity
from foparq.model.delivery import LOST
from foparq.report.record import AuditRecord

_ABOUT_FILES = ("FIL", "DOM")  #: families of rules that look at files; an empty drawing passes them


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
    return Exit.ACCEPTED if looked_at_everything(record) else Exit.UNDECIDED


def looked_at_everything(record: AuditRecord) -> bool:
    """Whether every file was read, every rule could run, and every drawing held something to check."""
    if _refused(record) or any(_stopped(outcome) for outcome in record.outcomes):
        return False
    geometry = [outcome for outcome in record.outcomes if not outcome.rule.startswith(_ABOUT_FILES)]
    seen = {outcome.source for outcome in geometry if outcome.checked}
    return seen == {outcome.source for outcome in geometry}


def _stopped(outcome: Outcome) -> bool:
    return outcome.status is Status.CRASHED or outcome.because in {"unit-unknown", "unit-doubtful", "plane-doubtful"}


def _refused(record: AuditRecord) -> bool:
    return any(source.status in LOST for source in record.delivery.sources)
