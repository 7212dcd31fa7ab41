# SPDX-License-Identifier: MIT
"""Which reasons only stand beside a decision, and which decide."""

from foparq.evaluate.quality import Element, Reason

#: messages that decide nothing, wherever they stand
_REMARKS = frozenset({
    "absolute.upper", "relative.upper", "absolute.measured", "relative.measured",
    "trend.not-normal", "trend.several", "residuals.outliers",
    "residuals.outliers-limit", "outlier.contradicted", "outlier.borne-out",
    "evidence.repeated", "evidence.repeated-distances", "evidence.taken", "evidence.flat",
    "absolute.survey-finer", "relative.survey-finer",
    "evidence.names-only", "evidence.good", "evidence.absent-confirmed", "evidence.distances-confirmed",
    "checks.preview", "checks.unfit", "faulty.free", "faulty.probable", "faulty.shared",
    "features.unmapped", "omission.net", "omission.unproven", "evidence.most-confirmed", "evidence.unnamed",
    "surface.not-compared", "surface.stated-rims", "evidence.names-only-mesh",
    "surface.reference-elsewhere", "omission.uncovered", "omission.uncovered-at",
    "omission.openings", "commission.confirmed", "commission.unlisted",
})  # fmt: skip


def deciding(element: Element) -> tuple[Reason, ...]:
    """Reasons that leave an element open: all but remarks, at least the first."""
    return tuple(reason for reason in element.why if reason.message not in _REMARKS) or element.why[:1]


def basis(element: Element) -> tuple[Reason, ...]:
    """The first reason of an element that is decided, and what a person decided that it rests on."""
    return (*element.why[:1], *(reason for reason in element.why[1:] if reason.message == "features.decided"))


def remarks_on(element: Element, decisive: tuple[Reason, ...]) -> tuple[Reason, ...]:
    """The other reasons of an element."""
    return tuple(reason for reason in element.why if reason not in decisive)
