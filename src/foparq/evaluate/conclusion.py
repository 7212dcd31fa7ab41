# SPDX-License-Identifier: MIT
"""What is concluded of loose files: faults, none, or nothing that can be said."""

from collections import defaultdict
from collections.abc import Sequence

from foparq.evaluate.evidence import Evidence, named_parts
from foparq.evaluate.left_out import left_out, left_out_doubts
from foparq.evaluate.quality import Element, QualityReport, Reason, Verdict, because, some
from foparq.evaluate.tally import where_broken
from foparq.evaluate.verdict import crashes, lost_files
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome
from foparq.profile.schema import Profile

_SHOWN = 10  #: items that a reason names


def conclude_files(profile: Profile, evidence: Evidence, elements: Sequence[Element]) -> QualityReport:  # noqa: ARG001 - as for deliveries
    """Conclusion on files without a manifest, with its reasons.

    A fault is a fault, whatever else was not seen. Without one, anything that was not looked at leaves it open: a file
    that could not be read, a rule that did not run, an item that no rule could judge, what the reader had to leave out,
    a drawing that holds nothing to check.
    """
    doubts = [*lost_files(evidence), *crashes(evidence), *_not_run(evidence), *_unseen(evidence)]
    if evidence.faults:
        verdict, why = Verdict.REJECTED, [because("files.faults", n=evidence.faults), *doubts]
    elif doubts:
        verdict, why = Verdict.UNDECIDED, doubts
    else:
        verdict, why = Verdict.ACCEPTED, [because("files.none")]
    return QualityReport(
        verdict=verdict, why=tuple(why), remarks=left_out(evidence), elements=tuple(elements), refused=evidence.refused
    )


def _not_run(evidence: Evidence) -> list[Reason]:
    """Rules that did not run, by reason, and items that they could not judge."""
    places: dict[Because, set[str]] = defaultdict(set)
    items: dict[str, None] = {}
    for outcome in evidence.outcomes:
        if outcome.because.opens and outcome.because is not Because.CRASHED:
            places[outcome.because].add(where_broken(outcome))
        items |= dict.fromkeys(f"{one.item} ({one.layer})" for one in outcome.aside if one.open)
    why = [because(f"files.{reason}", files=sorted(places[reason])) for reason in sorted(places)]
    if items:
        why.append(because("files.unfit", items=some(list(items), _SHOWN), n=len(items)))
    return why


def _unseen(evidence: Evidence) -> list[Reason]:
    """Parts of the files that no rule saw."""
    why = []
    for part in evidence.delivery.parts:
        if hidden := named_parts(part):
            why.append(because("files.unseen", file=part.path, parts=hidden))
        if not any(_saw(outcome) for outcome in evidence.outcomes if outcome.source == part.path):
            why.append(because("files.nothing", file=part.path))
    why += left_out_doubts(evidence)
    why += [because("files.open-rim", file=file, n=n) for file, n in evidence.open_rims]
    if not evidence.delivery.parts and not evidence.refused:
        why.append(because("files.no-drawing"))
    return why


def _saw(outcome: Outcome) -> bool:
    """Whether a chosen rule looked at items of the part, not at its file alone."""
    return bool(outcome.checked) and not (outcome.about_file or outcome.helper)
