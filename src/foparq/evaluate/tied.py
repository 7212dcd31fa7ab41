# SPDX-License-Identifier: MIT
"""Differences of the tables as far as the drawings bear them out."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from foparq.accuracy.bounds import rounding_bound
from foparq.accuracy.differences import differences
from foparq.accuracy.too_good import too_good
from foparq.columns import Flags, Index, Reals, Texts
from foparq.evaluate.comparable import unit_doubts
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.facades import facade_doubts, unnamed_remark
from foparq.evaluate.of_meshes import of_meshes
from foparq.evaluate.quality import Reason, because, some
from foparq.evaluate.reference import other_coordinates, other_lengths
from foparq.findings.because import Because
from foparq.findings.ties import DistanceTies, Ends, Lies, PointTies
from foparq.match.causes import Y_UP, Cause
from foparq.model.tables import Checkpoints, Distances
from foparq.names import folded
from foparq.profile.elements import AXES

_SHOWN = 10  #: ids that a reason names
_REMARKED = 0.01  #: probability below which differences that are too small are told
_GROSS = 1e-5  #: and below which nothing is accepted on them
_BROKEN_OFF = {Because.LIMIT: "evidence.limit", Because.CRASHED: "evidence.crashed"}
NOT_DRAWN = "not drawn"  #: confirmed: measured in the stereo model


class Tied(NamedTuple):
    """Differences of one table, delivered minus reference, one row a measurement."""

    rows: Index  #: (m,) rows of the table
    differences: Reals  #: (m,) or (m, 3) metres, NaN where nothing was delivered
    doubts: tuple[Reason, ...]  #: why nothing can be accepted or rejected on them
    remarks: tuple[Reason, ...]  #: what is to be said beside them
    one_way: tuple[Reason, ...] = ()  #: why nothing can be accepted on them, though it can be rejected


def tied_points(points: Checkpoints, evidence: Evidence, name: str, *, fewest: int = 1) -> Tied:
    """Differences (m, 3) of the checkpoints.

    Points that stand for one place count once, with the largest difference among them.

    Parameters
    ----------
    name : str
        Id of the element, for the reasons.
    fewest : int
        Places that each of several facades must have.
    """
    ties = evidence.ties.points if evidence.ties else None
    if ties is None:
        every = differences(points.delivered, points.surveyed)
        return Tied(np.arange(len(points.id)), every, of_meshes(_untied(evidence, name), evidence), ())
    every = differences(ties.delivered, points.surveyed)
    rows = _worst(ties.group, np.nansum(every**2, axis=1))
    repeated = np.setdiff1d(np.arange(len(points.id)), rows)
    remarks = []
    if len(repeated):
        remarks.append(_naming("evidence.repeated", name, points.id[repeated], kept=len(rows)))
    taken = np.isin(ties.lies, [Lies.TAKEN_VERTEX, Lies.TAKEN_NAMED])
    if taken.any():
        remarks.append(_naming("evidence.taken", name, points.id[taken]))
    counted, doubts = ties.held, _absent(points, ties, name)
    # What is on no surface is in no mesh: there is nothing else of it that was not drawn.
    if not evidence.meshes_only and (confirmed := evidence.confirmation("checkpoints", NOT_DRAWN)) is not None:
        absent = np.flatnonzero((ties.lies == Lies.ABSENT) | _made(ties))
        if len(absent):
            most = "evidence.most-confirmed" if 2 * len(absent) > len(points.id) else "evidence.absent-confirmed"
            remarks.insert(0, _naming(most, name, points.id[absent], by=confirmed.by, total=len(points.id)))
        # Points that one cause puts on the drawing are drawn, whoever says that they are not; what is farther from a
        # drawing than this is large is no point of what it shows.
        doubts = () if ties.cause is None else (_of_all(points, ties, ties.cause, name),)
        if ties.beside.size:
            counted = ties.held | ties.beside
            beyond = absent[~counted[absent].any(axis=1)]
            if len(beyond):
                doubts = (*doubts, _naming("evidence.beyond", name, points.id[beyond], total=len(points.id)))
    slips = other_coordinates(points.surveyed, ties.delivered, name)
    doubts = (*slips, *doubts, *facade_doubts(ties, counted, name, fewest)) or unit_doubts(evidence, name)
    remarks += unnamed_remark(ties, counted, name)
    return Tied(rows, every[rows], of_meshes(doubts, evidence), tuple(remarks), _one_way(points, ties, name))


def tied_distances(distances: Distances, evidence: Evidence, name: str) -> Tied:
    """Differences (m,) of the distances; rows that repeat one measurement count once, with the largest difference."""
    ties = evidence.ties.distances if evidence.ties else None
    if ties is None:
        every = differences(distances.delivered, distances.measured)
        return Tied(np.arange(len(distances.id)), every, of_meshes(_untied(evidence, name), evidence), ())
    every = differences(ties.delivered, distances.measured)
    rows = _worst(ties.group, np.nan_to_num(every**2))
    repeated = np.setdiff1d(np.arange(len(distances.id)), rows)
    remarks = []
    if len(repeated):
        remarks.append(_naming("evidence.repeated-distances", name, distances.id[repeated], kept=len(rows)))
    ties = replace(ties, ends=_without_confirmed(distances, evidence, ties))
    names = ties.ends == Ends.NAMES
    if names.any():
        remarks.append(because("evidence.names-only", element=name, n=int(names.sum()), total=len(distances.id)))
    if (confirmed := evidence.confirmation("distances", NOT_DRAWN)) is not None:
        remarks.append(because("evidence.distances-confirmed", element=name, by=confirmed.by))
        # Ends that are in the drawing are drawn: lengths that contradict them stay a doubt.
        drawn = ties.ends == Ends.OTHER_LENGTH
        ties = replace(ties, ends=np.where(drawn, ties.ends, str(Ends.NAMES)))
    slips = other_lengths(distances.measured, ties.delivered, name)
    doubts = (*slips, *_not_of_drawing(distances, ties, name)) or unit_doubts(evidence, name)
    return Tied(rows, every[rows], of_meshes(doubts, evidence), of_meshes(remarks, evidence))


def too_small(found: Reals, survey_sd: float | None, resolution: float, name: str) -> tuple[Reason | None, bool]:
    """Whether differences are smaller than the survey lets them be, and whether grossly.

    Parameters
    ----------
    found : (n,) metres
        Differences that are numbers.
    survey_sd : float or None, metres
        As stated.
    resolution : float, metres
        Half the last printed digits of both.
    """
    if survey_sd is None or not survey_sd > 0.0 or not len(found):
        return None, False
    p = too_good(found, survey_sd, resolution)
    if not p < _REMARKED:
        return None, False
    gross = p < _GROSS
    fields = {"n": len(found), "survey": (survey_sd, "m"), "p": (_GROSS if gross else _REMARKED, "1")}
    return because("evidence.too-good" if gross else "evidence.good", element=name, **fields), gross


def resolution_of(points: Checkpoints, evidence: Evidence, axis: int, rows: Index) -> float:
    """Half the last printed digits of surveyed plus delivered coordinates of one axis, metres: the root mean square.

    What is printed of delivered coordinates that are those of vertices was not rounded by more than it differs from
    them, however few digits round numbers show: each point by itself.

    Parameters
    ----------
    rows : (m,) int
        Points whose differences count.
    """
    printed, resolution = float(points.printed[axis]), float(points.resolution[axis])
    ties = evidence.ties.points if evidence.ties else None
    if ties is None or not len(ties.corner) or ties.unchecked[axis]:
        return resolution
    return rounding_bound(resolution - np.maximum(0.0, printed - ties.corner[rows])) if len(rows) else resolution


def unchecked(evidence: Evidence, axis: int, name: str) -> tuple[Reason, ...]:
    """Remark that a flat drawing says nothing of an axis."""
    ties = evidence.ties.points if evidence.ties else None
    if ties is None or not ties.unchecked[axis] or ties.unchecked.all():
        return ()
    return (because("evidence.flat", element=name),)


def _untied(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    if evidence.ties is None:
        return (because("evidence.unlooked", element=name),)
    if evidence.ties.broken in _BROKEN_OFF:
        return (because(_BROKEN_OFF[evidence.ties.broken], element=name),)
    return (because("evidence.no-drawing", element=name),)


def _one_way(points: Checkpoints, ties: PointTies, name: str) -> tuple[Reason, ...]:
    """That the nearest place of a surface was taken: how far a point slid along the surface cannot be seen."""
    taken = ties.lies == Lies.TAKEN_SURFACE
    return (_naming("evidence.across", name, points.id[taken], total=len(points.id)),) if taken.any() else ()


def _made(ties: PointTies) -> Flags:
    """(n,) points on linework that shows nothing else."""
    return ties.made if len(ties.made) else np.zeros(len(ties.lies), dtype=bool)


def _absent(points: Checkpoints, ties: PointTies, name: str) -> tuple[Reason, ...]:
    absent, made = ties.lies == Lies.ABSENT, _made(ties)
    only: tuple[Reason, ...] = ()
    if made.any():
        layers = sorted(set(ties.layer[made].tolist()))
        only = (_naming("evidence.made", name, points.id[made], total=len(points.id), layers=layers[:_SHOWN]),)
    if not absent.any():
        return only if ties.cause is None else (*only, _of_all(points, ties, ties.cause, name))
    gaps = ties.gap[absent & np.isfinite(ties.gap)]
    least, most = (float(gaps.min()), float(gaps.max())) if len(gaps) else (np.nan, np.nan)
    said = {"total": len(points.id), "least": (least, "m"), "most": (most, "m")}
    why = [_naming("evidence.absent", name, points.id[absent], **said)]
    if ties.cause is not None:
        why.insert(0, _of_all(points, ties, ties.cause, name))
    return (*only, *why)


def _of_all(points: Checkpoints, ties: PointTies, cause: Cause, name: str) -> Reason:
    return _explained(cause, ties.near, name, int(np.isfinite(points.delivered).all(axis=1).sum()))


_CAUSES = {
    **{("mirror", axis): "evidence.cause-mirror-mesh" for axis in "xyz"},
    ("axes", ""): "evidence.cause-axes", ("unit", ""): "evidence.cause-unit", ("shift", ""): "evidence.cause-shift",
    ("mirror", "right"): "evidence.cause-mirror-right", ("mirror", "up"): "evidence.cause-mirror-up",
    ("scale", ""): "evidence.cause-scale", ("scale", "right"): "evidence.cause-scale-right",
    ("scale", "up"): "evidence.cause-scale-up",
}  # fmt: skip


def _explained(cause: Cause, file: str, name: str, n: int) -> Reason:
    axes = [
        f"{AXES[k]} = {'' if sign > 0 else '-'}{AXES[own]}"
        for k, (own, sign) in enumerate(zip(cause.axes, cause.signs, strict=True))
        if own != k or sign < 0
    ]
    right, up, depth = ((length, "m") for length in cause.shift)
    message = "evidence.cause-unit-axes" if cause.kind == "unit" and axes else _CAUSES[cause.kind, cause.along]
    if cause.kind == "axes" and (cause.axes, cause.signs) == Y_UP:
        message = "evidence.cause-up"
    return because(
        message, element=name, n=n, file=file, axes=axes, factor=f"{cause.factor:.6g}", right=right, up=up, depth=depth,
        along=cause.along,
    )  # fmt: skip


def _without_confirmed(distances: Distances, evidence: Evidence, ties: DistanceTies) -> Texts:
    """(n,) ends of distances; one at a checkpoint that a person confirms not to be drawn is a name only."""
    points, there = evidence.delivery.checkpoints, evidence.ties.points if evidence.ties else None
    if points is None or there is None or evidence.confirmation("checkpoints", NOT_DRAWN) is None:
        return ties.ends
    stereo = {folded(str(name)) for name in points.id[there.lies == Lies.ABSENT]}
    ends = ties.ends.copy()
    for row in np.flatnonzero(ends == Ends.ABSENT).tolist():
        if {folded(str(distances.start[row])), folded(str(distances.end[row]))} & stereo:
            ends[row] = str(Ends.NAMES)
    return ends


_DISTANCE_DOUBTS = {
    Ends.ABSENT: "evidence.end-absent", Ends.OTHER_LENGTH: "evidence.other-length",
    Ends.TOO_LONG: "evidence.too-long", Ends.TOO_SHORT: "evidence.too-short",
}  # fmt: skip


def _not_of_drawing(distances: Distances, ties: DistanceTies, name: str) -> tuple[Reason, ...]:
    why = []
    for ends, message in _DISTANCE_DOUBTS.items():
        rows = ties.ends == ends
        if rows.any():
            said = {"total": len(distances.id), "longest": (ties.longest, "m")}
            why.append(_naming(message, name, distances.id[rows], **said))
    if ties.factor != 1.0:
        why.insert(0, because("evidence.distance-factor", element=name, factor=f"{ties.factor:.6g}"))
    return tuple(why)


def _naming(message: str, name: str, ids: Texts, **fields: object) -> Reason:
    """Reason that names the first of some ids, and how many there are."""
    shown = some([*map(str, ids[:_SHOWN])], _SHOWN, len(ids))
    return because(message, element=name, ids=shown, n=len(ids), **fields)


def _worst(group: Index, size: Reals) -> Index:
    """(m,) of each group the row of the greatest size, in the order of rows."""
    order = np.lexsort((np.arange(len(group)), -size, group))
    rows: Index = np.sort(order[np.unique(group[order], return_index=True)[1]])
    return rows
