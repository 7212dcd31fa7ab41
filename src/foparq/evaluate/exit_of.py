# SPDX-License-Identifier: MIT
"""Exit code of a finished audit."""

from foparq.evaluate.quality import QualityReport, Verdict
from foparq.exits import Exit


def exit_of(quality: QualityReport) -> Exit:
    """Exit code of a conclusion: a proven fault first, then refused input, then what stays open."""
    if quality.verdict is Verdict.ACCEPTED:
        return Exit.ACCEPTED
    if quality.verdict is Verdict.REJECTED:
        return Exit.REJECTED
    return Exit.REFUSED if quality.refused else Exit.UNDECIDED
