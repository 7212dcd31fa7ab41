# SPDX-License-Identifier: MIT
"""What the evaluation looks at, and what of the delivery nobody saw."""

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from foparq.evaluate.measures import measures
from foparq.evaluate.quality import Element, ElementStatus, Reason, Residuals, because, some
from foparq.findings.because import Because
from foparq.findings.clouds import CloudDistances
from foparq.findings.counts import FeatureCounts
from foparq.findings.outcome import Outcome
from foparq.findings.ties import Ties
from foparq.model.delivery import LOST, Delivery
from foparq.model.drawing import Drawing, SkippedReason
from foparq.model.mesh import Mesh
from foparq.model.part import Part
from foparq.model.statements import Confirmation
from foparq.profile.elements import ElementSpec, LimitedSpec

Parameters = tuple[tuple[str, float, str], ...]

_HANDLES = 5  #: of a kind that are told


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """Everything that one evaluation is made from."""

    delivery: Delivery
    outcomes: Sequence[Outcome]
    counts: FeatureCounts | None  #: delivered features; ``None`` if they were not counted
    scale: float | None  #: denominator k of 1:k
    uncounted: Because = Because.RAN  #: why the count of features broke off: ``LIMIT`` or ``CRASHED``
    ties: Ties | None = None  #: what of the tables belongs to the drawings; ``None`` if nobody looked
    clouds: tuple[CloudDistances, ...] = ()  #: references against meshes
    uncompared: Because = Because.RAN  #: why that broke off: ``LIMIT`` or ``CRASHED``
    faults: int = 0  #: findings that are no notes
    crashed: bool = False  #: something of the program crashed outside the rules
    completeness: tuple[str, ...] = ()  #: ids of the elements that count features

    def files(self, role: str) -> str:
        """Paths of the files of one role, as one text."""
        return ", ".join(source.path for source in self.delivery.sources if source.role == role)

    @property
    def meshes_only(self) -> bool:
        """Whether meshes were named and no drawing: what is asked of drawings does not concern the delivery."""
        return bool(self.files("mesh")) and not self.files("drawing")

    @property
    def open_rims(self) -> tuple[tuple[str, int], ...]:
        """Meshes that end in rims that nobody states, and how many."""
        return tuple((one.source, one.found) for one in self.outcomes if one.name == "open-rim" and one.found)

    @property
    def refused(self) -> bool:
        """Whether a file that was named could not be read."""
        return any(source.status in LOST for source in self.delivery.sources)

    def confirmation(self, what: str, value: str) -> Confirmation | None:
        """What a person confirmed by name, if it is this."""
        return next((one for one in self.delivery.confirmed if (one.what, one.value) == (what, value)), None)

    def lost(self, role: str) -> list[str]:
        """Paths of the files of one role that could not be read."""
        return [source.path for source in self.delivery.sources if source.role == role and source.status in LOST]


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """Status of one element with its reasons, the decisive one first."""

    status: ElementStatus
    why: tuple[Reason, ...]


def judged(status: ElementStatus, *why: Reason) -> Judgement:
    """Judgement of a status and its reasons."""
    return Judgement(status=status, why=why)


def element(
    spec: ElementSpec, measure: str, judgement: Judgement, *, id: str | None = None, scope: str, n: int = 0,  # noqa: A002
    value: float | None = None, limit: float | None = None, comparison: str, unit: str | None = None,
    parameters: Iterable[tuple[str, float, str]] = (), method: str, details: tuple[tuple[str, float, float], ...] = (),
    kind: str | None = None, residuals: Residuals | None = None, required: bool | None = None,
) -> Element:  # fmt: skip
    """Element of a measure of the catalogue.

    Parameters
    ----------
    measure : str
        Id in the catalogue.
    id : str, optional
        Id of this result where the profile's element gives several.
    scope, n, value, limit, comparison, parameters, method, details, residuals
        As in :class:`Element`. Numbers that are not finite are left out.
    unit, kind : str, optional
        Unit and data quality element, where they are not the measure's own.
    required : bool, optional
        False where the delivery holds nothing that the element speaks of; as the profile says if left out.
    """
    entry = measures()[measure]
    return Element(
        id=id or spec.id, element=kind or entry.element, measure_id=entry.id, measure_name=entry.name, scope=scope,
        value=value if value is not None and _finite(value) else None, unit=entry.unit if unit is None else unit,
        limit=limit, comparison=comparison, n=n, status=judgement.status,
        required=spec.required if required is None else required, why=judgement.why,
        parameters=tuple(row for row in parameters if _finite(row[1])), method=method, details=details,
        residuals=residuals,
    )  # fmt: skip


def limit_of(spec: LimitedSpec, evidence: Evidence, symbol: str, name: str) -> tuple[float | None, Reason | None]:
    """Limit of an element in SI units, or why there is none that can be used.

    Parameters
    ----------
    symbol : str
        SI unit of the value.
    name : str
        Id of the element, for the reason.
    """
    if spec.limit is None:
        return None, because("limit.none", element=name)
    if spec.limit.symbol != symbol:
        return None, because("limit.unit", element=name, limit=str(spec.limit))
    if spec.limit.at_scale and evidence.scale is None:
        return None, because("limit.no-scale", element=name, limit=str(spec.limit))
    return spec.limit.si(evidence.scale), None


def unseen(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Parts of the drawings that no check saw: what is there can only add to what was found.

    Parameters
    ----------
    name : str
        Id of the element, for the reasons.
    """
    why: list[Reason] = []
    if lost := evidence.lost("drawing"):
        why.append(because("unseen.file", element=name, files=lost))
    if bare := _bare(evidence):
        why.append(because("unseen.nothing", element=name, files=bare))
    for drawing in evidence.delivery.drawings:
        if bombs := sorted({bomb.block for bomb in drawing.reading.bombs}):
            why.append(because("unseen.block", element=name, file=drawing.path, blocks=some(bombs, 5), n=len(bombs)))
        # Blocks that are not taken apart are told by name above.
        why += _lost_within(drawing, name, but={SkippedReason.BLOCK_BOMB})
    return tuple(why)


def _bare(evidence: Evidence) -> list[str]:
    """Drawings among several in which no rule had anything to look at: nothing in model space, or nothing visible."""
    if len(evidence.delivery.drawings) == 1:
        return []
    there = {one.source for one in evidence.outcomes if not one.about_file}
    looked = {
        one.source
        for one in evidence.outcomes
        if not one.about_file and (one.checked or len(one.unjudged) or one.because.opens)
    }
    return [drawing.path for drawing in evidence.delivery.drawings if drawing.path in there - looked]


def unseen_meshes(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Meshes, and parts of them, that no check saw.

    Parameters
    ----------
    name : str
        Id of the element, for the reasons.
    """
    why: list[Reason] = []
    if lost := evidence.lost("mesh"):
        why.append(because("unseen.mesh", element=name, files=lost))
    for mesh in evidence.delivery.meshes:
        why += _lost_within(mesh, name)
    return tuple(why)


def _lost_within(part: Drawing | Mesh, name: str, *, but: Collection[SkippedReason] = ()) -> list[Reason]:
    """What was lost of a file that could be read, and what of it no check saw."""
    why = []
    if repairs := sum(repair.loses for repair in part.reading.repairs):
        why.append(because("unseen.repaired", element=name, file=part.path, n=repairs))
    if hidden := hidden_parts(part, but=but):
        kinds, n = [kind for kind, _ in hidden], sum(count for _, count in hidden)
        why.append(because("unseen.skipped", element=name, file=part.path, kinds=some(kinds, 5), n=n))
    return why


def hidden_parts(part: Part, *, but: Collection[SkippedReason] = ()) -> list[tuple[str, int]]:
    """Things of a part that no check saw and behind which faults may hide, with their numbers, in order.

    Parameters
    ----------
    but : collection of SkippedReason
        Reasons that are left out.
    """
    if not isinstance(part, Drawing | Mesh):
        return []
    found: Counter[str] = Counter()
    for skipped in part.reading.skipped:
        if skipped.reason.opens and skipped.reason not in but:
            found[skipped.thing] += skipped.count
    return sorted(found.items())


def named_parts(part: Part) -> list[str]:
    """The same with their first handles: ``"1 × LINE (2F)"``, ``"9 × MLINE (30, 31, +7)"``."""
    handles: dict[str, list[str]] = defaultdict(list)
    if isinstance(part, Drawing | Mesh):
        for skipped in part.reading.skipped:
            if skipped.reason.opens:
                handles[skipped.thing] += skipped.handles
    return [f"{n} × {thing}{_first(handles[thing], n)}" for thing, n in hidden_parts(part)]


def _first(handles: Sequence[str], n: int) -> str:
    told = handles[:_HANDLES]
    rest = [f"+{n - len(told)}"] if n > len(told) else []
    return f" ({', '.join([*told, *rest])})" if told else ""


def _finite(value: float) -> bool:
    return value - value == 0.0
