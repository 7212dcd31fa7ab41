# SPDX-License-Identifier: MIT
"""What places of tables are held against: one part of a delivery, whatever kind it is of."""

from abc import ABC, abstractmethod
from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals, Texts
from foparq.findings.ties import Lies
from foparq.match.causes import Cause
from foparq.match.linework import Footing


class Nearness(NamedTuple):
    """Lengths of the profile, metres."""

    tie: float  #: a point not farther from linework or surface lies on it
    apart: float  #: points not farther apart stand for one place
    search: float  #: around a surveyed place, for its only vertex, or the nearest place of a surface
    visible: float  #: what is shorter cannot be measured in the drawing


class Ground(ABC):
    """One part of a delivery, where tables look for their places; these are metres, in the axes of the file."""

    on: Lies = Lies.LINEWORK  #: where a place lies that is at no vertex
    taken: Lies = Lies.TAKEN_VERTEX  #: and where coordinates come from that nobody delivered

    @property
    @abstractmethod
    def path(self) -> str:
        """Of its file."""

    @property
    @abstractmethod
    def facade(self) -> str:
        """That it shows; ``""`` where nobody names one."""

    @property
    def flat(self) -> int:
        """Axis of the file along which nothing is compared; -1 if there is none."""
        return -1

    @abstractmethod
    def footing(self, places: Coordinates, within: Reals, printed: Reals | None = None) -> Footing:
        """What places (n, 3) lie on.

        Parameters
        ----------
        within : (n,) metres
            Distance up to which a place lies on something.
        printed : (3,) metres, optional
            Half the last printed digits along the axes of the file, which are allowed in addition.
        """

    @abstractmethod
    def called(self, rows: Index) -> tuple[Texts, Texts]:
        """Items and layers of rows of a footing."""

    @abstractmethod
    def near(self, surveyed: Coordinates, radius: float) -> Coordinates:
        """Places (n, 3) that stand for surveyed ones; NaN where none does, or several may."""

    @abstractmethod
    def beyond(self, places: Coordinates, distance: Reals) -> Reals:
        """Distances (n,) of places (n, 3) from the part as a whole, ``distance`` being that of their footing."""

    @abstractmethod
    def longest(self) -> float:
        """Length of the longest line that fits into its box, without strays."""

    @abstractmethod
    def made(self, places: Coordinates, within: Reals, near: Nearness) -> Flags:
        """(n,) places that lie on nothing but what shows nothing else: it was made for the table."""

    @abstractmethod
    def cause(self, places: Coordinates, bearing: Coordinates, within: float, *, corners: bool) -> Cause | None:
        """One cause that explains why places (n, 3) do not lie where they should.

        Parameters
        ----------
        bearing : (n, 3)
            Places that bear their names; NaN where none does.
        corners : bool
            Whether they should lie at vertices; else on anything.
        """

    def hidden(self, printed: Reals) -> float:
        """How far a place may lie from where it is told to, because of the digits that are not printed, metres."""
        return float(np.linalg.norm(printed))

    def bearing(self, name: str) -> Coordinates | None:  # noqa: ARG002 - parts with names have some
        """The one place (3,) that bears a name; ``None`` if none does, or several."""
        return None

    def marked(self, places: Coordinates, within: Reals) -> Flags:  # noqa: ARG002 - as above
        """(n,) whether what bears a name is at a place (n, 3)."""
        return np.zeros(len(places), dtype=bool)

    def apart(self, places: Coordinates, bearing: Coordinates, printed: Reals) -> tuple[Reals, Reals]:  # noqa: ARG002 - as above
        """Distances (n,) of places from those that bear their ids, infinite without; and the same less rounding."""
        nowhere = np.full(len(places), np.inf)
        return nowhere, nowhere
