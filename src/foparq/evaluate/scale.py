# SPDX-License-Identifier: MIT
"""The stated scale against what the sheets say, and against what the product allows."""

import math
from collections import defaultdict

from foparq.errors import QuantityError
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because
from foparq.profile.schema import Profile
from foparq.units import parse_scale

_PAPER = 0.001  #: metres in one unit of the paper
_SAME = 0.01  #: relative difference up to which two scales are one
_WITNESSES = 2  #: that contradict a person


def scale_doubts(profile: Profile, evidence: Evidence) -> tuple[list[Reason], list[Reason]]:
    """Why nothing can be accepted or rejected at the stated scale, and what is to be said beside it.

    A scale beyond those of the profile is doubtful by itself. Lettering and viewports are one witness each: a sheet may
    hold details at other scales, so a witness contradicts only if it never names the stated one.

    Returns
    -------
    doubts, remarks : lists of Reason
        Both empty if no scale is stated, or a person confirms it.
    """
    scale = evidence.scale
    if scale is None or any(one.what == "scale" and _names(one.value, scale) for one in evidence.delivery.confirmed):
        return [], []
    doubts, spec = [], profile.evidence
    if spec and spec.finest and spec.coarsest:
        finest, coarsest = parse_scale(spec.finest), parse_scale(spec.coarsest)
        if not finest <= scale <= coarsest:
            said = {"finest": f"1:{finest:g}", "coarsest": f"1:{coarsest:g}"}
            doubts.append(because("scale.unusual", scale=f"1:{scale:g}", **said))
    witnesses = _against(evidence, scale)
    told = [because("scale.contradicted", scale=f"1:{scale:g}", witnesses=witnesses)] if witnesses else []
    return (doubts + told, []) if len(witnesses) >= _WITNESSES else (doubts, told)


def _names(text: str, scale: float) -> bool:
    try:
        return math.isclose(parse_scale(text), scale)
    except QuantityError:
        return False


def _against(evidence: Evidence, scale: float) -> list[str]:
    """Witnesses that name scales and never the stated one."""
    said: dict[str, dict[str, float]] = defaultdict(dict)
    for drawing in evidence.delivery.drawings:
        for one in drawing.reading.scales:
            metres = drawing.unit.metres
            named = one.denominator or (one.ratio * metres / _PAPER if metres else math.nan)
            if math.isfinite(named):
                means = "" if one.denominator else f" = 1:{named:.4g}"
                said[one.witness][f"{drawing.path}: {one.said}{means}"] = named
    return [
        min(named)
        for _, named in sorted(said.items())
        if not any(math.isclose(scale, other, rel_tol=_SAME) for other in named.values())
    ]
