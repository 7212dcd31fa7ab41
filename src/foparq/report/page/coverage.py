# SPDX-License-Identifier: MIT
"""What was checked, and what was not and why, in one language."""

from collections.abc import Sequence
from dataclasses import dataclass

from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Severity
from foparq.model.delivery import Source
from foparq.report.page.drawing import Picture
from foparq.report.page.tables import TAKEN_IN, ElementView, InputView, input_views, open_elements
from foparq.report.record import AuditRecord
from foparq.report.second_reading import found_words
from foparq.report.sentences import (
    aside_sentence,
    outcome_because,
    outcome_scope,
    parameters_sentence,
    repair_sentence,
    skipped_sentence,
)
from foparq.report.words import Words, printable

_ROWS = 300  #: rows of a list of left-out things


@dataclass(frozen=True, slots=True, kw_only=True)
class RunView:
    """One run of one rule."""

    code: str
    name: str
    title: str
    scope: str
    checked: str
    found: str
    faulty: str
    skipped: str
    status: str
    word: str
    tolerances: str
    seconds: str
    because: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ToleranceView:
    """Tolerances of one rule, and where it was run with them."""

    code: str
    title: str
    scopes: tuple[str, ...]
    told: str


@dataclass(frozen=True, slots=True, kw_only=True)
class SkippedView:
    """Things of one file that no check saw."""

    source: str
    kind: str
    layer: str
    count: str
    reason: str
    handles: str


@dataclass(frozen=True, slots=True, kw_only=True)
class LookedAt:
    """All of it."""

    ran: tuple[RunView, ...]
    not_run: tuple[RunView, ...]
    tolerances: tuple[ToleranceView, ...]
    aside: bool  #: some run set items aside
    aside_items: tuple[str, ...]  #: the first of them, with their layers and why
    aside_more: str
    unfit: bool  #: some of them no rule could judge
    open_elements: tuple[ElementView, ...]
    files_out: tuple[InputView, ...]
    skipped: tuple[SkippedView, ...]
    skipped_more: str
    hidden: tuple[str, ...]
    repairs: tuple[tuple[str, str], ...]  #: file and what was changed or left out
    repairs_more: str

    @property
    def complete(self) -> bool:
        """Nothing was left out."""
        left_out = self.open_elements or self.files_out or self.skipped or self.hidden
        return not (self.not_run or self.unfit or left_out)


def coverage(words: Words, record: AuditRecord, pictures: tuple[Picture, ...]) -> LookedAt:
    """What was looked at in one audit.

    Parameters
    ----------
    pictures : tuple of Picture
        They know how much of each drawing is hidden.
    """
    told = [run for run in record.outcomes if not run.helper]
    runs = [(run, _run_view(words, run, noted=_only_notes(record, run))) for run in told]
    aside = dict.fromkeys(aside_sentence(words, one) for run in told for one in run.aside)
    ended = {Status.CLEAN, Status.FAULTY}
    skipped = [(source, part) for source in record.delivery.sources for part in source.skipped]
    repairs = [
        (printable(path), repair_sentence(words, repair))
        for path, made in record.delivery.repairs.items()
        for repair in made
    ]
    return LookedAt(
        ran=tuple(view for run, view in runs if run.status in ended),
        not_run=tuple(view for run, view in runs if run.status not in ended),
        tolerances=_tolerances([view for run, view in runs if run.status in ended]),
        aside=any(run.skipped for run in told),
        aside_items=tuple(aside)[:_ROWS],
        aside_more=_more(words, len(aside)),
        unfit=any(one.open for run in told for one in run.aside),
        open_elements=open_elements(words, record),
        files_out=input_views(words, _left_out(record)),
        skipped=tuple(
            SkippedView(
                source=printable(source.path),
                kind=printable(part.kind),
                layer=printable(part.layer),
                count=words.count(part.count),
                reason=skipped_sentence(words, part),
                handles=", ".join(printable(handle) for handle in part.handles),
            )
            for source, part in skipped[:_ROWS]
        ),
        skipped_more=_more(words, len(skipped)),
        repairs=tuple(repairs[:_ROWS]),
        repairs_more=_more(words, len(repairs)),
        hidden=tuple(_hidden_line(words, picture) for picture in pictures if _hides(picture)),
    )


def _tolerances(runs: Sequence[RunView]) -> tuple[ToleranceView, ...]:
    alike: dict[tuple[str, str, str], list[str]] = {}
    for run in runs:
        if run.tolerances:
            alike.setdefault((run.code, run.title, run.tolerances), []).append(run.scope)
    return tuple(
        ToleranceView(code=code, title=title, scopes=tuple(scopes), told=told)
        for (code, title, told), scopes in alike.items()
    )


def _left_out(record: AuditRecord) -> tuple[Source, ...]:
    return tuple(source for source in record.delivery.sources if source.status not in TAKEN_IN)


def _more(words: Words, number: int) -> str:
    return words("report.coverage.more", count=words.count(number - _ROWS)) if number > _ROWS else ""


def _hides(picture: Picture) -> bool:
    return bool(picture.hidden or picture.paper or picture.drawing.reading.hidden_layers)


def _hidden_line(words: Words, picture: Picture) -> str:
    layers = picture.drawing.reading.hidden_layers
    named = ", ".join(printable(layer) for layer in layers[:_ROWS])
    more = _more(words, len(layers))
    return words(
        "report.coverage.hidden-line",
        file=picture.drawing.path,
        hidden=words.count(picture.hidden),
        paper=words.count(picture.paper),
        layers=f"{named} {more}".strip() or words("report.page.none"),
    )


def _only_notes(record: AuditRecord, run: Outcome) -> bool:
    """Whether a rule found something, and nothing that is a fault."""
    findings = record.findings
    found = findings.severity[(findings.rule == run.rule) & (findings.source == run.source)]
    return bool(len(found)) and set(found) == {Severity.NOTE.value}


def _run_view(words: Words, run: Outcome, *, noted: bool) -> RunView:
    status = "noted" if noted and run.status is Status.FAULTY else run.status.value
    return RunView(
        code=run.rule,
        name=run.name,
        title=words(f"rules.{run.rule}.title"),
        scope=outcome_scope(words, run),
        checked=words.count(run.checked),
        found=found_words(words, run),
        faulty=words.count(len(run.faulty)),
        skipped=words.count(run.skipped),
        status=status,
        word=words(f"report.outcome.{status}"),
        tolerances=parameters_sentence(words, run.parameters),
        because=outcome_because(words, run),
        seconds=words("report.coverage.second", seconds=words.number(run.seconds, 2)),
    )
