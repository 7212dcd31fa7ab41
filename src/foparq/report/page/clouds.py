# SPDX-License-Identifier: MIT
"""References against meshes on the page: statistics, a histogram, and the places that are farthest."""

from dataclasses import dataclass

from foparq.evaluate.quality import QualityReport
from foparq.findings.clouds import CloudDistances
from foparq.report.clouds import statistics
from foparq.report.sentences import parameter_name
from foparq.report.words import Words, printable

_WIDTH, _HEIGHT = 400.0, 80.0  #: of a histogram


@dataclass(frozen=True, slots=True, kw_only=True)
class CloudView:
    """One reference."""

    title: str
    signs: str
    numbers: tuple[tuple[str, str], ...]
    bars: tuple[tuple[float, float, float, float], ...]  #: left, top, width and height of each class
    zero: float  #: where the distance is nought
    histogram: str
    worst: tuple[tuple[str, str, str, str], ...]  #: place, distance, mesh and face
    worst_title: str


def cloud_views(words: Words, quality: QualityReport) -> tuple[CloudView, ...]:
    """Every reference that was compared."""
    return tuple(_view(words, one) for one in quality.clouds)


def _view(words: Words, one: CloudDistances) -> CloudView:
    low, high = float(one.edges[0]), float(one.edges[-1])
    distances = words.column([far.distance for far in one.worst])
    return CloudView(
        title=words("report.clouds.against", file=one.path, meshes=list(one.meshes)),
        signs=words(f"report.clouds.signs.{one.signs}"),
        numbers=_numbers(words, one), bars=_bars(one), zero=round(_WIDTH * -low / (high - low), 2),
        histogram=words("report.clouds.histogram", low=(low, "m"), high=(high, "m")),
        worst=tuple(
            (_place(words, far.place), told, printable(far.mesh), f"f{far.face}")
            for far, told in zip(one.worst, distances, strict=True)
        ),
        worst_title=words("report.clouds.worst", search=(one.search, "m")),
    )  # fmt: skip


def _numbers(words: Words, one: CloudDistances) -> tuple[tuple[str, str], ...]:
    lengths = [
        (parameter_name(words, name), words.quantity(value, "m"))
        for name, value in statistics(one)
        if value is not None
    ]
    shares = [("share-uncovered", one.uncovered.n), *([] if one.limit is None else [("share-beyond", one.beyond)])]
    told = [
        (parameter_name(words, name), f"{words.quantity(count / one.n, '1')} ({words.count(count)})")
        for name, count in shares
    ]
    return ((words("report.clouds.points"), words.count(one.n)), *lengths, *told)


def _bars(one: CloudDistances) -> tuple[tuple[float, float, float, float], ...]:
    counts = one.counts.tolist()
    width, most = _WIDTH / len(counts), max(counts)
    heights = [round(_HEIGHT * count / most, 2) for count in counts]
    return tuple((round(k * width, 2), _HEIGHT - high, round(width, 2), high) for k, high in enumerate(heights) if high)


def _place(words: Words, place: tuple[float, float, float]) -> str:
    return words("report.clouds.xyz", **{axis: words.number(part, 3) for axis, part in zip("xyz", place, strict=True)})
