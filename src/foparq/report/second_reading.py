# SPDX-License-Identifier: MIT
"""Numbers of faults where a part can be read in two ways: a mesh as delivered, and welded."""

from foparq.findings.outcome import Outcome
from foparq.report.words import Words


def found_words(words: Words, outcome: Outcome) -> str:
    """Faults found, and beside them those of a second reading where it has others: ``"1 (2.065 as delivered)"``."""
    found = words.count(outcome.found)
    if outcome.otherwise is None or outcome.otherwise[1] == outcome.found:
        return found
    reading, count = outcome.otherwise
    return words(f"report.otherwise.{reading}", found=outcome.found, n=count)
