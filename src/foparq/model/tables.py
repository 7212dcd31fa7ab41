# SPDX-License-Identifier: MIT
"""Delivered tables: checkpoints, distances and the specified features, as columns."""

from dataclasses import dataclass, field

import numpy as np

from foparq.columns import Flags, Index, Reals, Texts
from foparq.model.drawing import Skipped


def _exact() -> Reals:
    return np.zeros(3)


def _nameless() -> Texts:
    return np.empty(0, dtype=object)


def _placeless() -> Reals:
    return np.empty((0, 2, 3))


@dataclass(frozen=True, slots=True, kw_only=True)
class Checkpoints:
    """Independent checkpoints: surveyed and delivered coordinates of n points, metres."""

    id: Texts  #: (n,)
    surveyed: Reals  #: (n, 3) X, Y, Z
    delivered: Reals  #: (n, 3) X, Y, Z; NaN where not delivered
    resolution: Reals  #: (3,) half the last printed digit of surveyed plus delivered, per axis, metres
    survey_sd: float | None  #: standard deviation of the survey, metres; ``None`` if not stated
    skipped: tuple[Skipped, ...] = ()  #: what of the file is no row of it
    printed: Reals = field(default_factory=_exact)  #: (3,) half the last printed digit of delivered alone, metres


@dataclass(frozen=True, slots=True, kw_only=True)
class Distances:
    """Independently measured distances, n rows, metres."""

    id: Texts  #: (n,)
    measured: Reals  #: (n,) by the survey
    delivered: Reals  #: (n,) in the delivery; NaN where not delivered
    resolution: float  #: half the last printed digit of measured plus delivered, metres
    survey_sd: float | None  #: standard deviation of the survey, metres; ``None`` if not stated
    skipped: tuple[Skipped, ...] = ()  #: what of the file is no row of it
    start: Texts = field(default_factory=_nameless)  #: (n,) name of the first end, ``""`` if none; left out: none
    end: Texts = field(default_factory=_nameless)  #: (n,) of the second
    places: Reals = field(default_factory=_placeless)  #: (n, 2, 3) delivered coordinates of both, metres; NaN if none
    printed: float = 0.0  #: half the last printed digit of delivered alone, metres
    places_printed: Reals = field(default_factory=_exact)  #: (3,) half the last printed digit of ``places``, metres

    def __post_init__(self) -> None:
        n = len(self.id)
        for name, missing in (
            ("start", np.full(n, "", dtype=object)),
            ("end", np.full(n, "", dtype=object)),
            ("places", np.full((n, 2, 3), np.nan)),
        ):
            if len(getattr(self, name)) != n:
                object.__setattr__(self, name, missing)


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
    #: (n, 3) X, Y, Z of a place on the feature, in axes of the drawing, metres; NaN where not given. Left out: none
    place: Reals = field(default_factory=lambda: np.empty((0, 3)))
    tol: Reals = field(default_factory=lambda: np.empty(0))  #: (n,) how far from it the feature may lie, metres; or NaN
    printed: Reals = field(default_factory=_exact)  #: (3,) half the last printed digit of ``place``, metres
    #: how far from a place of the list what was asked for may be, metres; ``None`` if nobody states it
    spacing: float | None = None

    def __post_init__(self) -> None:
        n = len(self.id)
        for name, missing in (("place", np.full((n, 3), np.nan)), ("tol", np.full(n, np.nan))):
            if len(getattr(self, name)) != n:
                object.__setattr__(self, name, missing)

    def required(self) -> Flags:
        """(n,) true where the contract demands the feature."""
        asked: Flags = self.use == "required"
        return asked
