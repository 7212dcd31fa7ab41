# SPDX-License-Identifier: MIT
"""What ``foparq audit`` does."""

from pathlib import Path

from foparq.audit import audit_to, find_manifest
from foparq.cli.common import Spoken, progress_on_stderr
from foparq.cli.show import show
from foparq.evaluate.exit_of import exit_of
from foparq.profile.load import stated_language
from foparq.profile.terms import Reviewer


def audit_work(
    *, spoken: Spoken, delivery: Path, profile: str | None, scale: str | None, out: Path | None, form: str
) -> int:
    """Audit a delivery, write the reports, tell the verdict; returns the exit code."""
    say = spoken.turn_to(stated_language(find_manifest(delivery)))
    with progress_on_stderr(say) as progress:
        written = audit_to(
            delivery, out, reviewer=Reviewer(profile=profile, scale=scale), language=spoken.asked,
            otherwise=say.language, progress=progress,
        )  # fmt: skip
    show(written.record, form, say, written.paths)
    return int(exit_of(written.record.quality))
