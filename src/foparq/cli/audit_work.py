# SPDX-License-Identifier: MIT
"""What ``foparq audit`` does."""

from pathlib import Path

from foparq.audit import audit_to
from foparq.cli.common import progress_on_stderr
from foparq.cli.show import show
from foparq.evaluate.exit_of import exit_of
from foparq.profile.terms import Reviewer
from foparq.report.words import Words


def audit_work(
    say: Words, *, asked: str | None, delivery: Path, profile: str | None, scale: str | None, out: Path | None,
    form: str,
) -> int:  # fmt: skip
    """Audit a delivery, write the reports, tell the verdict; returns the exit code."""
    with progress_on_stderr(say) as progress:
        written = audit_to(
            delivery, out, reviewer=Reviewer(profile=profile, scale=scale), language=asked, otherwise=say.language,
            progress=progress,
        )  # fmt: skip
    show(written.record, form, say, written.paths)
    return int(exit_of(written.record.quality))
