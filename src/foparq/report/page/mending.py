# SPDX-License-Identifier: MIT
"""What is to be mended first, by whoever delivered, and what whoever decides has to do first, in one language."""

from collections.abc import Sequence
from dataclasses import dataclass

from foparq.evaluate.quality import ClassBalance, Element, ElementStatus, Residual, Standing
from foparq.report.balances import label_of, may_differ
from foparq.report.page.findings import Group
from foparq.report.record import AuditRecord
from foparq.report.sentences import element_title, reason_sentence
from foparq.report.words import Words, printable

_FIRST = 5  #: things to mend that the headline names
_NAMED = 5  #: points, distances or classes that one of them names
_OMISSION, _COMMISSION = "7", "3"  #: measures


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """One thing to mend, and what to do about it."""

    anchor: str
    title: str
    found: str  #: how many; ``""`` of an element
    mend: str


def causes_of(words: Words, record: AuditRecord, faults: Sequence[Group], suffix: str) -> tuple[Cause, ...]:
    """What to mend first, by what it does to the verdict.

    Failing required elements come first, each as the faults that it counts, or with the points, distances or classes
    that make it fail, else with its own first reason; then those that leave it open; then all other faults, the most
    frequent first. What only whoever decides can settle is none of it: see :func:`tasks_of`.
    """
    left = {group.name: group for group in sorted(faults, key=lambda group: -group.found)}
    causes: list[Cause] = []
    told: set[tuple[str, str]] = set()  # axes of one element are one thing to mend
    required = [element for element in record.quality.elements if element.required and not record.loose]
    for status in (ElementStatus.FAIL, ElementStatus.UNDECIDED, ElementStatus.NOT_ASSESSED):
        of_status = [one for one in required if one.status is status and not _settled_by_counting(one)]
        for element in of_status:
            counted = [name for name in left if name in {name for name, _, _ in element.details}]
            causes += [_fault(words, left.pop(name), suffix) for name in counted]
            kind = (element.element, element.measure_id)
            if not counted and element.why and kind not in told:
                alike = [one for one in of_status if (one.element, one.measure_id) == kind]
                causes.append(_cause(words, record, alike, suffix))
                told.add(kind)
    return tuple([*causes, *(_fault(words, group, suffix) for group in left.values())][:_FIRST])


def tasks_of(words: Words, record: AuditRecord, suffix: str) -> tuple[Cause, ...]:
    """What whoever decides has to count on the drawing, where that settles an element that is left open."""
    open_ = [one for one in record.quality.elements if one.required and _settled_by_counting(one)]
    if not open_ or record.loose:
        return ()
    return tuple(
        Cause(
            anchor=f"completeness{suffix}", title=words("report.headline.count", label=label_of(words, one)), found="",
            mend=words(
                "report.headline.count-between", low=one.found[0], high=one.found[1], elements=[e.id for e in open_]
            ),
        )
        for one in record.quality.balances
        if may_differ(one)
    )  # fmt: skip


def _settled_by_counting(element: Element) -> bool:
    undecided = element.status is ElementStatus.UNDECIDED
    return undecided and any(reason.message.endswith(".interval") for reason in element.why[:1])


def _cause(words: Words, record: AuditRecord, alike: Sequence[Element], suffix: str) -> Cause:
    first = alike[0]
    # Axes of one element are told together.
    title = element_title(words, first)
    mend = _named(words, record, alike) if first.status is ElementStatus.FAIL else ""
    if not mend and first.why[0] not in record.quality.why:
        mend = reason_sentence(words, first.why[0])
    return Cause(anchor=f"e-{printable(first.id)}{suffix}", title=title, found="", mend=mend)


def _named(words: Words, record: AuditRecord, alike: Sequence[Element]) -> str:
    """Points, distances or classes that make elements fail."""
    if any(one.residuals is not None for one in alike):
        return "; ".join(_points(words, one, axis=len(alike) > 1) for one in alike)
    short = {_OMISSION: "missing", _COMMISSION: "surplus"}.get(alike[0].measure_id)
    if short is None:
        return ""
    rows: list[tuple[ClassBalance, int]] = [(one, getattr(one, short)[0]) for one in record.quality.balances]
    rows = sorted((row for row in rows if row[1]), key=lambda row: (-row[1], row[0].label))
    return "; ".join(
        words(f"report.headline.{short}", count=count, label=label_of(words, one)) for one, count in rows[:_NAMED]
    )


def _points(words: Words, element: Element, *, axis: bool) -> str:
    """Outliers of an element, else its worst difference, with size and place."""
    if element.residuals is None:
        return ""
    counted = [row for row in element.residuals.rows if row.standing is Standing.COUNTED]
    worst = [row for row in counted if row.outlier][:_NAMED] or counted[:1]
    return (f"{element.residuals.axis}: " if axis else "") + ", ".join(_placed(words, row) for row in worst)


def _placed(words: Words, row: Residual) -> str:
    place = " ".join(printable(part) for part in (row.drawing, row.item, row.layer, row.ends) if part)
    told = f"{printable(row.id)} {words.quantity(row.difference or 0.0, 'm')}"
    return f"{told} ({place})" if place else told


def _fault(words: Words, group: Group, suffix: str) -> Cause:
    return Cause(
        anchor=f"r-{group.rule}{suffix}", title=words(f"rules.{group.rule}.title"), found=words.count(group.found),
        mend=words(f"rules.{group.rule}.mend"),
    )  # fmt: skip
