# SPDX-License-Identifier: MIT
"""One delivery: everything that was handed over, and the state of each file."""

from dataclasses import dataclass
from enum import StrEnum

from foparq.model.cloud import Cloud
from foparq.model.drawing import Drawing, Repair, Skipped
from foparq.model.mesh import Mesh
from foparq.model.part import Part
from foparq.model.statements import Confirmation, Contract, Decision
from foparq.model.tables import Checkpoints, Distances, FeatureList


class SourceStatus(StrEnum):
    """How a file of the delivery was taken in."""

    READ = "read"
    RECOVERED = "recovered"  #: readable only after mending in memory
    REFUSED = "refused"  #: unreadable or unsafe: nothing of it was checked
    UNNAMED = "unnamed"  #: lies in the folder, the manifest does not name it: not checked
    MISSING = "missing"  #: named by the manifest, not there


#: named, and nothing of it was seen
LOST = frozenset({SourceStatus.REFUSED, SourceStatus.MISSING})


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """One file of the delivery."""

    path: str  #: relative to the delivery, with ``/``
    #: ``drawing``, ``mesh``, ``reference``, ``checkpoints``, ``distances``, ``features``, ``manifest`` or ``other``
    role: str
    sha256: str  #: of the delivered bytes; ``""`` if missing
    bytes: int
    status: SourceStatus
    items: int = 0  #: items or rows read
    skipped: tuple[Skipped, ...] = ()
    error: str = ""  #: message id in the ``errors`` catalogue when refused
    fields: tuple[tuple[str, object], ...] = ()  #: what that message names


@dataclass(frozen=True, slots=True, kw_only=True)
class Delivery:
    """What was delivered, as read."""

    title: str
    sources: tuple[Source, ...]
    parts: tuple[Part, ...] = ()
    references: tuple[Cloud, ...] = ()  #: in the order of the manifest
    checkpoints: Checkpoints | None = None
    distances: Distances | None = None
    features: FeatureList | None = None
    confirmed: tuple[Confirmation, ...] = ()  #: in the order of the manifest
    decisions: tuple[Decision, ...] = ()  #: likewise
    contract: Contract | None = None  #: none where the manifest states none
    crs: str = ""  #: coordinate reference system that the manifest states; ``""`` for local axes

    @property
    def drawings(self) -> tuple[Drawing, ...]:
        """The parts that are drawings."""
        return tuple(part for part in self.parts if isinstance(part, Drawing))

    @property
    def metres(self) -> dict[str, float | None]:
        """Metres in one unit of each drawing and mesh, by path; ``None`` where nobody knows."""
        return {part.path: part.unit.metres for part in self._files}

    @property
    def repairs(self) -> dict[str, tuple[Repair, ...]]:
        """What had to be mended in memory to read each drawing and mesh, by path."""
        return {part.path: part.reading.repairs for part in self._files}

    @property
    def _files(self) -> tuple[Drawing | Mesh, ...]:
        return tuple(part for part in self.parts if isinstance(part, Drawing | Mesh))

    @property
    def meshes(self) -> tuple[Mesh, ...]:
        """The parts that are meshes."""
        return tuple(part for part in self.parts if isinstance(part, Mesh))
