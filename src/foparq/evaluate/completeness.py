# SPDX-License-Identifier: MIT
"""Specified against drawn features, class by class and facade by facade, for every report."""

from foparq.evaluate.balance import Balance, Incomparable, balances
from foparq.evaluate.comparable import doubtful
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import BalanceState, ClassBalance
from foparq.findings.counts import FoundFeatures
from foparq.names import folded, of_kind

_GAPS = {
    Incomparable.UNBOUND: BalanceState.UNBOUND, Incomparable.FACADE: BalanceState.FACADE,
    Incomparable.UNLISTED: BalanceState.UNLISTED,
}  # fmt: skip


def class_balances(evidence: Evidence) -> tuple[ClassBalance, ...]:
    """Balances of every class and facade, ordered by both.

    Returns
    -------
    tuple of ClassBalance
        None without a list or counts, and none where the unit or the plane of a drawing is in doubt: what counts as one
        feature depends on both.
    """
    features, counts = evidence.delivery.features, evidence.counts
    if features is None or counts is None or doubtful(evidence, ""):
        return ()
    return tuple(_balance(row, counts.found) for row in balances(features, counts, evidence.delivery.decisions))


def _balance(row: Balance, found: FoundFeatures) -> ClassBalance:
    missing = (0 if row.hidden else row.missing_least, row.missing)
    surplus = (row.surplus, row.surplus_most)
    return ClassBalance(
        feature_class=row.feature_class, facade=row.facade, state=_state(row, missing, surplus), required=row.required,
        optional=row.optional, found=row.deciding, missing=missing, surplus=surplus, ids=row.ids,
        rows=_rows(row, found), hidden=row.hidden, decision=row.decision,
        only_counted=row.placed.required < row.required, absent=row.placed.absent, other=row.placed.other,
        unsure=row.placed.unsure,
    )  # fmt: skip


def _state(row: Balance, missing: tuple[int, int], surplus: tuple[int, int]) -> BalanceState:
    if row.gap in _GAPS:
        return _GAPS[row.gap]
    if missing[0]:
        return BalanceState.SHORT
    if surplus[0]:
        return BalanceState.OVER
    return BalanceState.OPEN if missing[1] or surplus[1] else BalanceState.EVEN


def _rows(row: Balance, found: FoundFeatures) -> tuple[int, ...]:
    kind, facade = of_kind(row.feature_class), folded(row.facade)
    pairs = enumerate(zip(found.feature_class, found.facade, strict=True))
    return tuple(n for n, (name, side) in pairs if of_kind(name) == kind and (not facade or folded(side) == facade))
