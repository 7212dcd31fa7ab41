# SPDX-License-Identifier: MIT
"""From outcomes and tables to a quality report."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from foparq.evaluate.absolute import absolute
from foparq.evaluate.commission import commission
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.faulty import faulty_rate
from foparq.evaluate.found import found_rate
from foparq.evaluate.normality import normality
from foparq.evaluate.omission import omission
from foparq.evaluate.quality import Element, ElementStatus, QualityReport, because
from foparq.evaluate.relative import relative
from foparq.evaluate.trend import trend
from foparq.evaluate.verdict import decide
from foparq.findings.counts import FeatureCounts
from foparq.findings.outcome import Outcome
from foparq.model.delivery import Delivery
from foparq.profile.schema import ElementSpec, Profile

#: kind of an element in the profile, and what evaluates it
KINDS: dict[str, Callable[[ElementSpec, Evidence], tuple[Element, ...]]] = {
    "absolute": absolute,
    "trend": trend,
    "relative": relative,
    "normality": normality,
    "faulty-rate": faulty_rate,
    "found-rate": found_rate,
    "commission": commission,
    "omission": omission,
}


def evaluate(
    profile: Profile, scale: float | None, delivery: Delivery, outcomes: Sequence[Outcome],
    counts: FeatureCounts | None, *, crashed: bool = False,
) -> QualityReport:  # fmt: skip
    """Quality report of one delivery after ISO 19157.

    Parameters
    ----------
    profile : Profile
    scale : float or None
        Denominator k of the drawing scale 1:k.
    delivery : Delivery
    outcomes : sequence of Outcome
        Of all drawings.
    counts : FeatureCounts or None
        Delivered features; ``None`` if they were not counted.
    crashed : bool
        True if anything of the program crashed: the delivery is not to blame, and cannot be accepted either.

    Returns
    -------
    QualityReport
        Elements in the order of the profile. An element that the class of product does not ask for keeps its value.
    """
    evidence = Evidence(delivery=delivery, outcomes=outcomes, counts=counts, scale=scale)
    elements: list[Element] = []
    for spec in profile.elements:
        made = KINDS[spec.kind](spec, evidence)
        elements.extend(made if spec.applicable else (_waived(element) for element in made))
    return decide(profile, evidence, elements, crashed=crashed)


def _waived(element: Element) -> Element:
    why = (because("element.not-applicable", element=element.id),)
    return replace(element, status=ElementStatus.NOT_APPLICABLE, why=why)
