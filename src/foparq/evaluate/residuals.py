# SPDX-License-Identifier: MIT
"""Every difference of a table by itself: which is worst, which are outliers, and where they lie."""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from foparq.accuracy.differences import differences
from foparq.accuracy.moments import moments
from foparq.accuracy.normality import normal_scores
from foparq.accuracy.outliers import most_outliers, outliers
from foparq.columns import Reals, Texts
from foparq.evaluate.evidence import Evidence, Judgement, judged
from foparq.evaluate.quality import ElementStatus, Reason, Residual, Residuals, Standing, because, some
from foparq.evaluate.tied import Tied
from foparq.model.tables import Checkpoints, Distances
from foparq.profile.elements import AXES

_NAMED = 10  #: outliers that a reason names
_WORST = 3  #: of them that it names with size and place


def point_residuals(points: Checkpoints, tied: Tied, evidence: Evidence, axis: int, confidence: float) -> Residuals:
    """Differences of all checkpoints along one axis.

    Parameters
    ----------
    tied : Tied
        What of the table counts.
    confidence : float
        0.95: outliers are told at a significance of 5 %.
    """
    ties = evidence.ties.points if evidence.ties else None
    delivered = points.delivered if ties is None else ties.delivered
    found = differences(delivered, points.surveyed)[:, axis]
    places = np.where(np.isfinite(delivered), delivered, points.surveyed)
    lies = _Lies(ties.lies, ties.drawing, ties.item, ties.layer) if ties is not None else None
    return _residuals(points.id, found, tied, confidence, axis=AXES[axis], lies=lies, places=places)


def distance_residuals(distances: Distances, tied: Tied, evidence: Evidence, confidence: float) -> Residuals:
    """Differences of all distances."""
    ties = evidence.ties.distances if evidence.ties else None
    found = differences(distances.delivered if ties is None else ties.delivered, distances.measured)
    nowhere = np.full(len(found), "", dtype=object)
    lies = _Lies(ties.ends, nowhere, nowhere, nowhere) if ties is not None else None
    ends = np.array(
        [f"{a}\N{EN DASH}{b}" if a and b else "" for a, b in zip(distances.start, distances.end, strict=True)],
        dtype=object,
    )
    return _residuals(distances.id, found, tied, confidence, lies=lies, ends=ends)


class _Lies(NamedTuple):
    """Where rows of a table were tied, as columns."""

    lies: Texts
    drawing: Texts
    item: Texts
    layer: Texts


def _residuals(
    ids: Texts, found: Reals, tied: Tied, confidence: float, *, axis: str = "", lies: _Lies | None,
    places: Reals | None = None, ends: Texts | None = None,
) -> Residuals:  # fmt: skip
    known = np.isfinite(found)
    counts = known & np.isin(np.arange(len(found)), tied.rows)
    rows = np.flatnonzero(counts)
    significance = round(1.0 - confidence, 12)
    outlying = np.zeros(len(found), dtype=bool)
    outlying[rows[outliers(found[rows], significance=significance)]] = True
    whole = moments(found[rows])
    expected = np.full(len(found), np.nan)
    expected[rows[np.argsort(found[rows], kind="stable")]] = normal_scores(len(rows))
    order = np.lexsort((np.arange(len(found)), -np.abs(np.where(known, found, 0.0)), ~known))

    def row(n: int) -> Residual:
        standing = Standing.COUNTED if counts[n] else Standing.REPEATED if known[n] else Standing.MISSING
        own = {} if lies is None else {name: str(column[n]) for name, column in lies._asdict().items()}
        place = places[n].tolist() if places is not None and np.isfinite(places[n]).all() else None
        return Residual(
            id=str(ids[n]), difference=float(found[n]) if known[n] else None, standing=standing,
            normalised=float((found[n] - whole.mean) / whole.sd) if counts[n] and whole.sd > 0.0 else None,
            expected=_number(float(expected[n])), outlier=bool(outlying[n]),
            ends=str(ends[n]) if ends is not None else "",
            place=(place[0], place[1], place[2]) if place else None, **own,
        )  # fmt: skip

    return Residuals(
        axis=axis, rows=tuple(row(n) for n in order.tolist()), significance=significance, n=whole.n,
        most=most_outliers(whole.n), rmse=_number(whole.rmse), rest=_number(moments(found[counts & ~outlying]).rmse),
    )  # fmt: skip


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def naming_worst(judgement: Judgement, residuals: Residuals, name: str, limit: float | None) -> Judgement:
    """Judgement whose failure names the outliers, else the worst difference, with size and place.

    Outliers count all the same: whether they may be left out is for people to say.
    """
    remark = _outlying(residuals, name, limit)
    first, *rest = judgement.why
    counted = [row for row in residuals.rows if row.standing is Standing.COUNTED]
    if judgement.status is ElementStatus.FAIL and counted:
        worst = [row for row in counted if row.outlier][:_WORST] or counted[:1]
        first = replace(first, fields=(*first.fields, ("worst", tuple(_placed(row) for row in worst))))
    return judged(judgement.status, first, *remark, *rest)


def _placed(row: Residual) -> Reason:
    fields = {"id": row.id, "difference": (row.difference or 0.0, "m")}
    place = " ".join(filter(None, [row.drawing, row.item, row.layer, row.ends]))
    return because("residuals.placed", place=place, **fields) if place else because("residuals.placeless", **fields)


def _outlying(residuals: Residuals, name: str, limit: float | None) -> tuple[Reason, ...]:
    ids = list(residuals.outliers)
    if not ids or residuals.rest is None:
        return ()
    fields = {
        "element": name, "n": residuals.n - len(ids), "ids": some(ids, _NAMED),
        "significance": (residuals.significance, "1"), "value": (residuals.rest, "m"),
    }  # fmt: skip
    if limit is None:
        return (because("residuals.outliers", **fields),)
    return (because("residuals.outliers-limit", limit=(limit, "m"), **fields),)
