# SPDX-License-Identifier: MIT
"""Specified against drawn features, by class and facade, in words that every report shares."""

from collections.abc import Sequence
from dataclasses import dataclass

from foparq.evaluate.decisions import quoted
from foparq.evaluate.quality import BalanceState, ClassBalance, QualityReport
from foparq.findings.counts import FoundFeatures, Reading
from foparq.report.sentences import COUNTING, class_word
from foparq.report.words import Words, printable

_LISTED = 60  #: ids of the list or of the drawing that people are shown

#: states in which the numbers of list and drawing can be compared
COMPARED = frozenset({BalanceState.EVEN, BalanceState.SHORT, BalanceState.OVER, BalanceState.OPEN})


@dataclass(frozen=True, slots=True, kw_only=True)
class BalanceRow:
    """One class on one facade, ready to be shown; ``–`` where nothing can be said."""

    label: str
    state: str  #: value of :class:`BalanceState`
    word: str
    required: str
    optional: str
    found: str
    missing: str
    surplus: str
    ids: str  #: of the list
    items: tuple[tuple[str, str], ...]  #: reading, and the items of that reading
    notes: tuple[str, ...]  #: decisions, hidden layers
    decision: str  #: lines to be pasted into the manifest, to be filled in; ``""`` where nothing is open
    asked: str  #: what to do with them


def balance_rows(words: Words, quality: QualityReport) -> tuple[BalanceRow, ...]:
    """Rows of the table of completeness, in order."""
    return tuple(_row(words, balance, quality) for balance in quality.balances)


def balance_note(words: Words, quality: QualityReport) -> str:
    """What the table does not say: that only counts were compared; ``""`` where nothing was."""
    counted = [one for one in quality.balances if one.only_counted and one.state in COMPARED]
    if not counted:
        return ""
    if len(counted) == len([one for one in quality.balances if one.state in COMPARED]):
        return words("report.balance.only-counted")
    return words("report.balance.some-counted", classes=[label_of(words, one) for one in counted[:10]])


def _row(words: Words, balance: ClassBalance, quality: QualityReport) -> BalanceRow:
    compared = balance.state in COMPARED
    return BalanceRow(
        label=label_of(words, balance),
        state=balance.state.value,
        word=words(
            f"report.balance.state.{balance.state.value}",
            missing=_range(words, balance.missing),
            surplus=_range(words, balance.surplus),
        ),
        required=words.count(balance.required),
        optional=words.count(balance.optional) if balance.optional else "",
        found=_range(words, balance.found) if compared or balance.state is BalanceState.UNLISTED else "–",
        missing=_range(words, balance.missing) if compared else "–",
        surplus=_range(words, balance.surplus) if compared else "–",
        ids=_some(words, balance.ids),
        items=_items(words, balance.rows, quality.found),
        notes=_notes(words, balance),
        decision=_decision(words, balance, quality),
        asked=words("report.balance.decide", elements=_counting(quality)),
    )


def label_of(words: Words, balance: ClassBalance) -> str:
    """Class in the language of the reader, and facade: ``"janela / N"``; safe to show."""
    name = class_word(words, balance.feature_class)
    return f"{name} / {printable(balance.facade)}" if balance.facade else name


def _counting(quality: QualityReport) -> list[str]:
    return [element.id for element in quality.elements if element.measure_id in COUNTING]


def may_differ(balance: ClassBalance) -> bool:
    """Whether linework allows several numbers of features, and nobody decided which."""
    return balance.state in COMPARED and balance.decision is None and balance.found[0] < balance.found[1]


def _range(words: Words, pair: tuple[int, int]) -> str:
    least, most = pair
    return words.count(least) if least == most else f"{words.count(least)}–{words.count(most)}"


def _some(words: Words, names: Sequence[str]) -> str:
    shown = ", ".join(printable(name) for name in names[:_LISTED])
    more = len(names) - _LISTED
    return f"{shown} {words('report.balance.more', count=words.count(more))}" if more > 0 else shown


def _items(words: Words, rows: Sequence[int], found: FoundFeatures) -> tuple[tuple[str, str], ...]:
    made = []
    for reading in Reading:
        items = [str(found.item[row]) for row in rows if found.reading[row] == reading]
        if items:
            title = words(f"report.balance.reading.{reading.value}", count=words.count(len(items)))
            made.append((title, _some(words, items)))
    return tuple(made)


def _notes(words: Words, balance: ClassBalance) -> tuple[str, ...]:
    notes = []
    if (one := balance.decision) is not None:
        by = f"{one.by} ({one.date})" if one.date else one.by
        notes.append(words("report.balance.decided", by=by, counted=one.counted, reason=one.reason))
    for name, ids in (("absent", balance.absent), ("other", balance.other), ("unsure", balance.unsure)):
        if ids:
            notes.append(words(f"report.balance.{name}", ids=_some(words, ids)))
    if balance.hidden:
        notes.append(words("report.balance.hidden", layers=list(balance.hidden)))
    return tuple(notes)


def _decision(words: Words, balance: ClassBalance, quality: QualityReport) -> str:
    """Lines of ``delivery.toml``; what a person must write is left empty, and refused as long as it is."""
    if not may_differ(balance):
        return ""
    asking = _counting(quality)
    if not asking:
        return ""
    low, high = balance.found
    facade = [f"facade = {quoted(balance.facade)}"] if balance.facade else []
    return "\n".join(
        [
            "[[decision]]",
            f"element = {quoted(asking[-1])}",
            f"class = {quoted(balance.feature_class)}",
            *facade,
            f"counted =   # {words('report.balance.between', low=low, high=high)}",
            f'by = ""   # {words("report.balance.by")}',
            f'reason = ""   # {words("report.balance.reason")}',
            f"# date = 2026-11-30   # {words('report.balance.date')}",
        ]
    )
