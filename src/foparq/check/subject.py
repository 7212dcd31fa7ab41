# SPDX-License-Identifier: MIT
"""One part of a delivery as the rules see it: all that the engine knows of drawings, meshes and cameras."""

import importlib
import pkgutil
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import cache, cached_property
from typing import NamedTuple, TypeVar

import numpy as np

import foparq.check.subjects
from foparq.columns import Geometries, Index, Reals, Texts
from foparq.findings.because import Because
from foparq.findings.hits import Hits
from foparq.findings.outcome import Outcome
from foparq.model.inputs import Named
from foparq.model.part import Part
from foparq.profile.schema import Profile

Patterns = tuple[str, ...]  #: of layers


class Taken(NamedTuple):
    """Input of one kind on some layers."""

    rows: Named
    unfit: Index  #: rows of the part's items that are of the kind, and that the input cannot hold


class Doubt(NamedTuple):
    """Why tolerances in metres mean nothing on a part."""

    because: Because
    names: tuple[str, ...] = ()  #: who says otherwise, in words of the files


NO_DOUBT = Doubt(Because.RAN)


class Places(NamedTuple):
    """Where k findings lie."""

    where: Geometries  #: (k,) in the coordinates of the file
    sheet: Geometries  #: (k,) in the plane of the part, metres; the same where there is none
    point: Reals  #: (k, 3) one point on each, in the coordinates of the file; NaN if it has none


class Subject(ABC):
    """One part as the rules see it. Columns are built once, when a rule first asks.

    Parameters
    ----------
    part : Part
        Of the kind that the subject is declared for.
    profile : Profile
        Says how the part is looked at.
    """

    #: names of rules whose outcome :meth:`doubt` reads: they run first
    leading: tuple[str, ...] = ()
    #: items have no name that another file of the same thing would give them: findings are known by place alone
    named_by_place: bool = False

    @abstractmethod
    def __init__(self, part: Part, profile: Profile) -> None: ...

    @classmethod  # noqa: B027 - most kinds of parts need nothing
    def prepare(cls) -> None:
        """Make ready, once in this process and outside of the bounds of rules, what they need: compiled code."""

    @property
    @abstractmethod
    def part(self) -> Part:
        """The part."""

    @property
    @abstractmethod
    def metres(self) -> float:
        """Metres in one unit of the file."""

    @property
    def measured(self) -> bool:
        """Whether lengths have a unit; where they have none, sizes of findings are in units of the file."""
        return True

    @classmethod
    @abstractmethod
    def knows(cls, kind: type) -> bool:
        """Whether parts of this kind have such an input at all; rules on others do not concern them."""

    @abstractmethod
    def take(self, kind: type, layers: Patterns) -> Taken:
        """Input of one kind on some layers."""

    def without(self, kind: type, layers: Patterns, rows: Index) -> Named:
        """The same input less some rows of the part's items; made once, so that rules share what kernels compute."""
        whole = self.take(kind, layers).rows
        kept = ~np.isin(whole.row, rows)
        if kept.all():
            return whole
        key = (kind, layers, rows.tobytes())
        if key not in self._reduced:
            self._reduced[key] = whole.take(kept)
        return self._reduced[key]

    def drawn_again(self, kind: type, layers: Patterns, rows: Index, within: float) -> Index:  # noqa: ARG002 - kinds that know layers use it
        """Rows of the part's items that only repeat, within metres, what another layer draws; ``rows`` are left out."""
        return rows[:0]

    def otherwise(self, kind: type, layers: Patterns) -> tuple[str, Named] | None:  # noqa: ARG002 - kinds with two readings use it
        """Name and input of a second reading: its faults are counted beside and decide nothing; ``None``: no other."""
        return None

    @cached_property
    def _reduced(self) -> dict[tuple[type, Patterns, bytes], Named]:
        return {}

    @abstractmethod
    def alone(self, kind: type, layers: Patterns) -> Sequence[Patterns]:
        """Layers that hold anything of a kind, each by itself."""

    @abstractmethod
    def states(self, kind: type) -> bool:
        """Whether an input holds statements of the file, about no item."""

    @abstractmethod
    def examined(self, kind: type) -> bool:
        """Whether an empty input means that the file was looked at and nothing was there to report."""

    @abstractmethod
    def doubt(self, outcomes: Sequence[Outcome], visible: float) -> Doubt:
        """Why tolerances in metres mean nothing on this part; ``NO_DOUBT`` if they do.

        Parameters
        ----------
        visible : float, metres
            What is smaller cannot be seen on the sheet; 0 if the scale is unknown.
        """

    @abstractmethod
    def counted(self, rows: Index, faulty: Index) -> int:
        """Features among the judged rows of the part's items: the denominator of rates."""

    def too_small(self, rows: Index, visible: float) -> Index:  # noqa: ARG002 - kinds of parts that know sizes use it
        """Those of the rows of the part's items that are smaller than what can be seen, metres."""
        return rows[:0]

    def undeclared(self, kind: type, visible: float) -> tuple[str, ...]:  # noqa: ARG002 - kinds that know such use it
        """Patterns of layers that look like such an input and are not declared as one."""
        return ()

    @abstractmethod
    def named(self, rows: Index) -> tuple[Texts, Texts]:
        """Item ids and layers of rows of the part's items."""

    @abstractmethod
    def places(self, found: Hits, rows: Named) -> Places:
        """Where the hits of a rule on an input lie."""


S = TypeVar("S", bound=type[Subject])

#: type of a part, and the type of its subject
SUBJECTS: dict[type[Part], type[Subject]] = {}


def subject(kind: type[Part]) -> Callable[[S], S]:
    """Declare the subject of a kind of part: a class that is made from the part and the profile."""

    def declare(made: S) -> S:
        SUBJECTS[kind] = made
        return made

    return declare


def kind_of_subject(part: Part) -> type[Subject] | None:
    """The subject that is declared for a kind of part; ``None`` if nobody did."""
    _load()
    return SUBJECTS.get(type(part))


@cache
def _load() -> None:
    """Import every module of ``check.subjects``: each declares its subject."""
    for module in pkgutil.walk_packages(foparq.check.subjects.__path__, "foparq.check.subjects."):
        importlib.import_module(module.name)
