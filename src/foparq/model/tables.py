# SPDX-License-Identifier: MIT
"""Delivered tables: checkpoints, distances and the specified features, as columns."""

from dataclasses import dataclass

from foparq.columns import Flags, Index, Reals, Texts
from foparq.model.drawing import Skipped


@dataclass(frozen=True, slots=True, kw_only=True)
class Checkpoints:
    """Independent checkpoints: surveyed and delivered coordinates of n points, metres."""

    id: Texts  #: (n,)
    surveyed: Reals  #: (n, 3) X, Y, Z
    delivered: Reals  #: (n, 3) X, Y, Z; NaN where not delivered
    resolution: Reals  #: (3,) half the last printed digit of surveyed plus delivered, per axis, metres
    survey_sd: float | None  #: standard deviation of the survey, metres; ``None`` if not stated
    skipped: tuple[Skipped, ...] = ()  #: what of the file is no row of it


@dataclass(frozen=True, slots=True, kw_only=True)
class Distances:
    """Independently measured distances, n rows, metres."""

    id: Texts  #: (n,)
    measured: Reals  #: (n,) by the survey
    delivered: Reals  #: (n,) in the delivery; NaN where not delivered
    resolution: float  #: half the last printed digit of measured plus delivered, metres
    survey_sd: float | None  #: standard deviation of the survey, metres; ``None`` if not stated
    skipped: tuple[Skipped, ...] = ()  #: what of the file is no row of it


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureList:
    """What the contract asks to be drawn, n rows."""

    id: Texts  #: (n,) unique
    feature_class: Texts  #: (n,) ``"window"``
    facade: Texts  #: (n,) ``"N"``; ``""`` if not stated
    count: Index  #: (n,) how many the row stands for
    use: Texts  #: (n,) ``"required"``, ``"optional"`` or ``"prohibited"``
    accepted: Texts  #: (n,) code of an accepted omission, ``""`` if none
    evidence: Texts  #: (n,) what supports the accepted omission
    ignored: tuple[str, ...] = ()  #: columns of the file that no check uses
    skipped: tuple[Skipped, ...] = ()  #: what of the file is no row of it

    def required(self) -> Flags:
        """(n,) true where the contract demands the feature."""
        asked: Flags = self.use == "required"
        return asked
