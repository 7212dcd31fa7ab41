# SPDX-License-Identifier: MIT
"""From outcomes and tables to a quality report."""

import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace

from foparq.evaluate.absolute import absolute
from foparq.evaluate.commission import commission
from foparq.evaluate.conclusion import conclude_files
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.faulty import faulty_rate
from foparq.evaluate.found import found_rate
from foparq.evaluate.normality import normality
from foparq.evaluate.omission import omission
from foparq.evaluate.quality import Element, ElementStatus, QualityReport, because
from foparq.evaluate.relative import relative
from foparq.evaluate.trend import trend
from foparq.evaluate.verdict import decide
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


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A quality report, and what went wrong on our side while it was made."""

    quality: QualityReport
    log: tuple[str, ...]  #: tracebacks


def evaluate(profile: Profile, evidence: Evidence, *, loose: bool = False) -> Evaluation:
    """Quality report of one delivery after ISO 19157.

    Parameters
    ----------
    profile : Profile
    evidence : Evidence
    loose : bool
        True for files without a manifest: faults and what nobody saw are concluded from, not elements.

    Returns
    -------
    Evaluation
        Elements in the order of the profile. An element that the class of product does not ask for keeps its value. One
        whose evaluation crashed is undecided, and takes nothing from the others.
    """
    elements: list[Element] = []
    log: list[str] = []
    for spec in profile.elements:
        try:
            made = KINDS[spec.kind](spec, evidence)
        except Exception:  # noqa: BLE001 - a crash is ours: it makes the element undecided and ends nothing
            log.append(f"element {spec.id}\n{traceback.format_exc()}")
            made = (_crashed(spec),)
        elements.extend(made if spec.applicable else (_waived(element) for element in made))
    if log:
        evidence = replace(evidence, crashed=True)
    conclude = conclude_files if loose else decide
    return Evaluation(conclude(profile, evidence, elements), tuple(log))


def _waived(element: Element) -> Element:
    why = (because("element.not-applicable", element=element.id),)
    return replace(element, status=ElementStatus.NOT_APPLICABLE, why=why)


def _crashed(spec: ElementSpec) -> Element:
    return Element(
        id=spec.id, element="", measure_id="", measure_name="", scope="", value=None, unit="", limit=None,
        comparison="", n=0, status=ElementStatus.UNDECIDED, required=spec.required,
        why=(because("element.crashed", element=spec.id),),
    )  # fmt: skip
