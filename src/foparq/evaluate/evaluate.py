# SPDX-License-Identifier: MIT
"""From outcomes and tables to a quality report."""

import traceback
from dataclasses import dataclass, replace

from foparq.evaluate.completeness import class_balances
from foparq.evaluate.conclusion import conclude_files
from foparq.evaluate.evidence import Evidence, element, judged
from foparq.evaluate.kinds import kind_of
from foparq.evaluate.quality import ClassBalance, Element, ElementStatus, QualityReport, because
from foparq.evaluate.verdict import decide
from foparq.evaluate.whose import whose
from foparq.profile.elements import CommissionSpec, ElementSpec, OmissionSpec
from foparq.profile.schema import Profile
from foparq.profile.terms import Terms


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A quality report, and what went wrong on our side while it was made."""

    quality: QualityReport
    log: tuple[str, ...]  #: tracebacks


def evaluate(profile: Profile, evidence: Evidence, *, terms: Terms | None = None, loose: bool = False) -> Evaluation:
    """Quality report of one delivery after ISO 19157.

    Parameters
    ----------
    terms : Terms, optional
        Who states profile and scale: the first sentence of a verdict tells where that is not what one expects.
    loose : bool
        True for files without a manifest: faults and what nobody saw are concluded from, not elements.

    Returns
    -------
    Evaluation
        Elements in the order of the profile. An element that the class of product does not ask for keeps its value. One
        whose evaluation crashed is undecided, and takes nothing from the others.
    """
    counting = (one.id for one in profile.elements if isinstance(one, CommissionSpec | OmissionSpec) and one.applicable)
    evidence = replace(evidence, completeness=tuple(counting))
    elements: list[Element] = []
    log: list[str] = []
    for spec in profile.elements:
        try:
            made = kind_of(spec).evaluate(spec, evidence)
        except Exception:  # noqa: BLE001 - a crash is ours: it makes the element undecided and ends nothing
            log.append(f"element {spec.id}\n{traceback.format_exc()}")
            made = (_crashed(spec),)
        elements.extend(made if spec.applicable else (_waived(one) for one in made))
    balanced: tuple[ClassBalance, ...] = ()
    try:
        balanced = class_balances(evidence)
    except Exception:  # noqa: BLE001 - as above
        log.append(f"balances\n{traceback.format_exc()}")
    if log:
        evidence = replace(evidence, crashed=True)
    if loose:
        return Evaluation(conclude_files(profile, evidence, elements), tuple(log))
    quality = replace(decide(profile, evidence, elements), balances=balanced, clouds=evidence.clouds)
    if evidence.counts is not None:
        quality = replace(quality, found=evidence.counts.found)
    if terms is not None and (first := whose(terms, evidence.delivery)):
        quality = replace(quality, why=(first, *quality.why), terms=first)
    return Evaluation(quality, tuple(log))


def _waived(one: Element) -> Element:
    why = (because("element.not-applicable", element=one.id),)
    return replace(one, status=ElementStatus.NOT_APPLICABLE, why=why)


def _crashed(spec: ElementSpec) -> Element:
    why = judged(ElementStatus.UNDECIDED, because("element.crashed", element=spec.id))
    return element(spec, kind_of(spec).measure, why, scope="", comparison="", method="directInternal")
