# SPDX-License-Identifier: MIT
"""The quality report as records: elements after ISO 19157, and the verdict."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from foparq.findings.clouds import CloudDistances
from foparq.findings.counts import FoundFeatures
from foparq.model.statements import Decision


class ElementStatus(StrEnum):
    """Result of one quality element (design law 1)."""

    PASS = "pass"  # noqa: S105 - a result, not a password
    FAIL = "fail"
    UNDECIDED = "undecided"
    NOT_APPLICABLE = "not-applicable"
    NOT_ASSESSED = "not-assessed"
    REPORTED = "reported"  #: a value without a limit: there is nothing to meet


class Verdict(StrEnum):
    """What the reviewer can defend."""

    ACCEPTED = "accepted"
    REJECTED = "rejected"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reason:
    """A sentence to be made: message id in the ``evaluate`` catalogue and what it names.

    Fields that are lengths are pairs (value, unit) so that every language writes them its own way. A field may be a
    reason itself, a tuple of reasons, or a list of names with a reason behind them, see :func:`some`.
    """

    message: str
    fields: tuple[tuple[str, object], ...] = ()


def because(message: str, **fields: object) -> Reason:
    """Reason of a message id and the values it names."""
    return Reason(message=message, fields=tuple(fields.items()))


def some(names: Sequence[object], most: int = 10, total: int | None = None) -> list[object]:
    """The first of many names, and behind them a reason that says how many more there are.

    Parameters
    ----------
    most : int
        Names that are told.
    total : int, optional
        How many there are, where not all are named.
    """
    rest = (len(names) if total is None else total) - min(len(names), most)
    return [*names[:most], because("list.more", n=rest)] if rest > 0 else list(names)


class Standing(StrEnum):
    """Whether a difference counts; each is an id in the ``report`` catalogue under ``standing.``."""

    COUNTED = "counted"
    REPEATED = "repeated"  #: another row stands for the same place or measurement, with a larger difference
    MISSING = "missing"  #: nothing was delivered to compare with


@dataclass(frozen=True, slots=True, kw_only=True)
class Residual:
    """One difference, delivered minus reference, metres."""

    id: str  #: of the checkpoint or distance
    difference: float | None  #: ``None`` where nothing was delivered
    normalised: (
        float | None
    )  #: from the mean of those that count, in their standard deviations; ``None`` if it does not
    expected: float | None  #: the same, as a normal sample of that size has it at this rank
    standing: Standing
    outlier: bool
    lies: str = ""  #: value of :class:`foparq.findings.ties.Lies`, of a distance of ``Ends``; ``""`` if nobody looked
    drawing: str = ""  #: path of the drawing it was tied to; ``""`` if to none
    item: str = ""  #: item it lies on
    layer: str = ""  #: layer of that item
    ends: str = ""  #: of a distance: between which points, by name
    place: tuple[float, float, float] | None = None  #: delivered coordinates, metres; ``None`` if it has none


@dataclass(frozen=True, slots=True, kw_only=True)
class Residuals:
    """Every difference of one element, and the test that tells outliers among them."""

    axis: str  #: ``"X"``, ``"Y"`` or ``"Z"``; ``""`` of distances
    rows: tuple[Residual, ...]  #: worst first
    significance: float  #: of the test of outliers: generalised ESD
    most: int  #: outliers that were looked for at the most
    n: int  #: differences that count
    rmse: float | None  #: of those that count
    rest: float | None  #: RMSE of those that count without outliers

    @property
    def outliers(self) -> tuple[str, ...]:
        """Ids of the outliers, worst first."""
        return tuple(row.id for row in self.rows if row.outlier)


@dataclass(frozen=True, slots=True, kw_only=True)
class Element:
    """One quality element with its measure, value, limit and status."""

    id: str  #: ``"Q1-X"``, ``"Q2"``, ``"Q3"``
    element: str  #: ISO 19157 element: ``"AbsoluteExternalPositionalAccuracy"``
    measure_id: str  #: ISO 19157 measure id, or ``"foparq:..."`` for our own
    measure_name: str  #: English name of the measure, as in the standard
    scope: str  #: what was measured: files, facade, class
    value: float | None  #: SI; ``None`` if not assessed
    unit: str  #: ``"m"``, ``"1"``, ``"items"``, ``""``
    limit: float | None  #: in the same unit; ``None`` if there is none
    comparison: str  #: ``"<"`` or ``"<="``: value COMPARISON limit passes; ``">"`` likewise
    n: int  #: sample size or denominator
    status: ElementStatus
    required: bool  #: the verdict depends on it
    why: tuple[Reason, ...] = ()
    parameters: tuple[tuple[str, float, str], ...] = ()  #: name, value, unit: mean, sd, t, critical ...
    method: str = "directInternal"  #: ISO 19157 evaluation method type, or ``directExternal``
    details: tuple[tuple[str, float, float], ...] = ()  #: per class or rule: name, found, out of
    residuals: Residuals | None = None  #: of an element of measured differences


class BalanceState(StrEnum):
    """What list and drawings say of a class on a facade; each is an id under ``report.balance.state``."""

    EVEN = "even"  #: as many as specified
    SHORT = "short"  #: fewer
    OVER = "over"  #: more
    OPEN = "open"  #: linework allows more than one of these
    UNBOUND = "unbound"  #: no layer of the class
    FACADE = "facade"  #: only one side names the facade
    UNLISTED = "unlisted"  #: the list says nothing of it


@dataclass(frozen=True, slots=True, kw_only=True)
class ClassBalance:
    """Specified against drawn features of one class on one facade. Intervals are (least, most)."""

    feature_class: str
    facade: str  #: ``""`` if the list states none
    state: BalanceState
    required: int
    optional: int
    found: tuple[int, int]
    missing: tuple[int, int]
    surplus: tuple[int, int]
    ids: tuple[str, ...]  #: of the list
    rows: tuple[int, ...]  #: of what was found, in ``FeatureCounts.found``
    hidden: tuple[str, ...] = ()  #: layers of the class with items that nobody sees
    decision: Decision | None = None  #: by which a person settled how many are drawn
    only_counted: bool = True  #: which feature is missing is not known: one missing and one surplus cancel
    absent: tuple[str, ...] = ()  #: ids of required features that are not where they are listed
    other: tuple[str, ...] = ()  #: those of them in whose place another class is drawn
    unsure: tuple[str, ...] = ()  #: ids of which linework does not decide

    @property
    def label(self) -> str:
        """``"window / N"``."""
        return f"{self.feature_class} / {self.facade}" if self.facade else self.feature_class


@dataclass(frozen=True, slots=True, kw_only=True)
class QualityReport:
    """All elements of one delivery, or of loose files, and the one conclusion that every report and exit code reads.

    Of loose files ``ACCEPTED`` means that no fault was found and nothing was left unseen, ``REJECTED`` that faults were
    found; nothing is said of a delivery.
    """

    verdict: Verdict
    why: tuple[Reason, ...]  #: what decides
    elements: tuple[Element, ...]
    remarks: tuple[Reason, ...] = ()  #: what is to be said beside it
    refused: bool = False  #: a file that was named could not be read
    terms: Reason | None = None  #: whose specification and scale it rests on; then it is the first of the reasons
    balances: tuple[ClassBalance, ...] = ()  #: by class and facade; none where nothing was compared
    clouds: tuple[CloudDistances, ...] = ()  #: references against meshes
    found: FoundFeatures = field(default_factory=FoundFeatures.none)  #: drawn features

    @property
    def measured(self) -> tuple[tuple[Element, Residuals], ...]:
        """Elements of measured differences, with these."""
        return tuple((one, one.residuals) for one in self.elements if one.residuals is not None)

    @property
    def within_blocks(self) -> bool:
        """Whether a point lies on an item within a block."""
        return any("/" in row.item for _, residuals in self.measured for row in residuals.rows)

    @property
    def worst(self) -> tuple[Element, Residual] | None:
        """The difference that is greatest against its limit; ``None`` if nothing was measured, or has no limit."""
        rows = [
            (abs(row.difference) / one.limit, one, row)
            for one, residuals in self.measured
            for row in residuals.rows
            if one.limit and row.difference is not None and row.standing is Standing.COUNTED
        ]
        return max(rows, key=lambda row: row[0])[1:] if rows else None
