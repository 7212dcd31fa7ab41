# SPDX-License-Identifier: MIT
"""Whose specification and scale a verdict rests on: its first sentence, where they are not those that one expects."""

from foparq.evaluate.quality import Reason, because
from foparq.model.delivery import Delivery
from foparq.profile.looser import Looser, Point
from foparq.profile.terms import Terms

_REPLACED = {"profile": "terms.reviewer-profile", "scale": "terms.reviewer-scale"}


def whose(terms: Terms, delivery: Delivery) -> Reason | None:
    """What must be known of the terms before the verdict.

    Returns
    -------
    Reason or None
        Where the reviewer's statements differ from the delivery's, and that the profile is not one that comes with
        foparq, with every point in which it is looser than the one it was compared with. ``None`` if neither holds.
    """
    parts = [because(_REPLACED[one.what], reviewer=one.reviewer, delivery=one.delivery) for one in terms.replaced]
    if not terms.profile.shipped:
        parts.append(_own(terms, delivery))
    if len(parts) < 2:  # noqa: PLR2004 - one sentence stays as it is
        return parts[0] if parts else None
    return because("terms.several", parts=tuple(parts))


def _own(terms: Terms, delivery: Delivery) -> Reason:
    files = [source.path for source in delivery.sources if source.role == "profile"]
    fields: dict[str, object] = {"profile": terms.profile.name, "files": files, "compared": terms.compared}
    if terms.looser:
        return because("terms.own-looser", **fields, looser=tuple(_point(one) for one in terms.looser))
    return because("terms.own", **fields)


def _point(one: Looser) -> Reason:
    if one.point is Point.SEVERITY:
        own, other = because(f"severity.{one.own}"), because(f"severity.{one.other}")
        return because("looser.severity", subject=one.subject, own=own, other=other)
    return because(f"looser.{one.point}", subject=one.subject, own=one.own, other=one.other)
