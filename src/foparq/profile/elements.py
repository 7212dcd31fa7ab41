# SPDX-License-Identifier: MIT
"""Quality elements of a product specification: ``[[element]]``, one type a kind.

``kind`` says which keys an element has. A kind is declared by a class here and by what evaluates it in
``foparq.evaluate.elements``; nothing else has to know it.
"""

import math
from collections.abc import Mapping
from typing import ClassVar

from foparq.profile.quantities import AnyQuantity, Length, LooserWhen, Share, Strict

AXES = ("X", "Y", "Z")


def results_of(id_: str) -> tuple[str, ...]:
    """Ids of the results that one element may give: its own, and one an axis."""
    return (id_, *(f"{id_}-{axis}" for axis in AXES))


class ElementSpec(Strict):
    """One required or reported quality element."""

    KIND: ClassVar[str] = ""  #: as the profile writes it
    KINDS: ClassVar[dict[str, type["ElementSpec"]]] = {}  #: every kind by name
    #: which change of a key lets more pass; of a key that is not named here, any
    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {}
    ABSENT: ClassVar[Mapping[str, float]] = {}  #: the number that a key left out amounts to

    id: str  #: ``"Q1"``; one element may give several results (``Q1-X``, ``Q1-Y``, ``Q1-Z``)
    kind: str
    required: bool
    applicable: bool = True  #: false: the class of product does not ask for it

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: object) -> None:
        """Enter the kind; a class without one is shared by several."""
        super().__pydantic_init_subclass__(**kwargs)
        if cls.KIND:
            ElementSpec.KINDS[cls.KIND] = cls

    @property
    def uses(self) -> tuple[str, ...]:
        """Names of the rules that it counts."""
        return ()


class LimitedSpec(ElementSpec):
    """An element whose value has a limit, or is only reported."""

    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {"limit": LooserWhen.LARGER}
    ABSENT: ClassVar[Mapping[str, float]] = {"limit": -math.inf}  # a required element without a limit passes nothing

    limit: AnyQuantity | None = None


class SampledSpec(ElementSpec):
    """An element of measured differences."""

    # The bound that is told beside a pass grows with the confidence.
    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {"confidence": LooserWhen.SMALLER, "fewest": LooserWhen.SMALLER}

    confidence: Share = 0.95  #: of tests and bounds
    fewest: int = 2  #: observations below which nothing can be said


class ReferencedSpec(SampledSpec, LimitedSpec):
    """An element whose differences are against a reference that has an accuracy of its own."""

    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {
        **SampledSpec.LOOSER,
        **LimitedSpec.LOOSER,
        "reference_share": LooserWhen.LARGER,
    }
    ABSENT: ClassVar[Mapping[str, float]] = {**LimitedSpec.ABSENT, "reference_share": math.inf}

    reference_share: Share | None = None  #: the reference must be better than this share of the limit


class AbsoluteSpec(ReferencedSpec):
    """Absolute positional accuracy at checkpoints."""

    KIND = "absolute"


class RelativeSpec(ReferencedSpec):
    """Relative positional accuracy of distances."""

    KIND = "relative"


class TrendSpec(SampledSpec):
    """Trend of coordinate differences."""

    KIND = "trend"
    # A test that must be surer finds less.
    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {**SampledSpec.LOOSER, "confidence": LooserWhen.LARGER}


class NormalitySpec(SampledSpec):
    """Normality of distance differences."""

    KIND = "normality"
    # A test that must be surer finds less.
    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {**SampledSpec.LOOSER, "confidence": LooserWhen.LARGER}


class RulesSpec(LimitedSpec):
    """An element of what rules found."""

    rules: tuple[str, ...] = ()  #: names

    @property
    def uses(self) -> tuple[str, ...]:
        """The rules."""
        return self.rules


class FaultyRateSpec(RulesSpec):
    """Share of the features that are at fault."""

    KIND = "faulty-rate"


class FoundRateSpec(RulesSpec):
    """Faults of one kind, for each feature checked."""

    KIND = "found-rate"


class SurfaceRateSpec(RulesSpec):
    """Share of the surface of meshes that is at fault, by faces and by area."""

    KIND = "surface-rate"


class SurfaceDistanceSpec(ElementSpec):
    """Distances of clouds of reference from meshes. Nothing passes or fails: a number without a limit."""

    KIND = "surface-distance"
    LOOSER: ClassVar[Mapping[str, LooserWhen]] = {"beyond": LooserWhen.LARGER}
    ABSENT: ClassVar[Mapping[str, float]] = {"beyond": math.inf}  # nothing is counted

    beyond: Length | None = None  #: what is farther from the surface is counted apart: the limit of Q1


class CommissionSpec(LimitedSpec):
    """Delivered features that the list does not allow."""

    KIND = "commission"


class OmissionSpec(LimitedSpec):
    """Specified features that are not drawn."""

    KIND = "omission"
