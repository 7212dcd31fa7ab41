# SPDX-License-Identifier: MIT
"""References against meshes, as JSON values and as numbers for people."""

from typing import Any

from foparq.evaluate.quality import QualityReport
from foparq.findings.clouds import CloudDistances, detectable
from foparq.report.rows import number


def clouds_json(quality: QualityReport) -> list[dict[str, Any]]:
    """Every reference that was compared, in the order of the manifest; lengths in metres."""
    return [_json(one) for one in quality.clouds]


def _json(one: CloudDistances) -> dict[str, Any]:
    place = one.uncovered.place
    values = {name: None if value is None else number(value) for name, value in statistics(one)}
    return {
        "reference": one.path,
        "meshes": list(one.meshes),
        "n": one.n,
        "signs": one.signs.value,
        "statistics": values,
        "elsewhere": one.elsewhere,
        "repeats": one.repeats,
        "beyond": one.beyond,
        "uncovered": {
            "n": one.uncovered.n,
            "largest_cluster": one.uncovered.largest,
            "where": None if place is None else [number(part) for part in place],
        },
        "worst": [
            {
                "where": [number(part) for part in far.place],
                "distance": number(far.distance),
                "mesh": far.mesh,
                "face": far.face,
            }
            for far in one.worst
        ],
        "histogram": {
            "edges": [number(edge) for edge in one.edges.tolist()],
            "counts": [int(count) for count in one.counts.tolist()],
        },
    }


def statistics(one: CloudDistances) -> tuple[tuple[str, float | None], ...]:
    """Lengths by the names of parameters; ``None`` where there is none."""
    return (
        ("rms", one.rms),
        ("mean", one.mean),
        ("median", one.median),
        ("sd", one.sd if one.n > 1 else None),
        ("quantile-95", one.quantile),
        ("largest-distance", one.largest),
        ("beyond", one.limit),
        ("search", one.search),
        ("survey-sd", one.survey_sd),
        ("detectable", detectable(one.survey_sd)),
    )
