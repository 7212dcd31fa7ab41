# SPDX-License-Identifier: MIT
"""The product specification, typed: which rules on which layers with which tolerances, and which limits."""

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from pydantic import Field

from foparq.findings.table import Severity
from foparq.profile.elements import ElementSpec
from foparq.profile.quantities import Angle, AnyQuantity, Length, Ratio, ScaleText, Strict, Times
from foparq.units import Quantity


class CheckSpec(Strict):
    """One rule bound to layers: ``[[check]]``."""

    rule: str  #: name
    severity: Severity
    layers: tuple[str, ...] = ("*",)  #: patterns; the layers that match are checked together
    on: Mapping[str, tuple[str, ...]] = Field(default_factory=dict)  #: of single inputs of a rule that takes several
    apart: bool = False  #: check every layer by itself
    helper: bool = False  #: runs only because chosen rules require it: nothing of it is told
    tolerances: dict[str, AnyQuantity] = Field(default_factory=dict)
    file: str = ""  #: where the profile says so
    line: int = 0


class LimitsSpec(Strict):
    """Bounds of time and space: ``[limits]``.

    Meant to keep a run within 2 GB, and within 20 s for drawings of up to 100,000 vertices. Facade-like linework needs
    about 20 s a million vertices for all rules: four times less than the bounds of time. A drawing that is quadratic by
    nature exceeds the share of one rule about twice.
    """

    entities: int = 2_000_000  #: entities after taking blocks apart, per drawing
    vertices: int = 5_000_000  #: vertices after flattening, per drawing
    faces: int = 20_000_000  #: faces of one mesh; as many vertices
    points: int = 50_000_000  #: points of one reference
    bytes: int = 1_000_000_000  #: size of one file
    seconds: int = 600  #: reading one file
    memory: int = 2_000_000_000  #: bytes beyond the start, reading one file
    check_seconds: int = 9  #: processor time of all rules on one part; one rule may use a third of it
    check_seconds_per_million: int = 80  #: and so much more for each million vertices
    check_memory: int = 2_000_000_000  #: bytes in all, the drawing included, rules on one part
    written: int = 100_000  #: findings written, per rule; counting is never capped


class CompletenessSpec(Strict):
    """What counts as one delivered feature: ``[completeness]``."""

    gap: Length  #: linework of one class nearer than this belongs to one feature


class EvidenceSpec(Strict):
    """How tables of evidence are tied to the drawings: ``[evidence]``."""

    tie: Length  #: a delivered point not farther from linework lies on it; printed digits are added
    apart: Length  #: checkpoints not farther apart stand for one place
    search: Length  #: radius in which the only vertex is taken for a checkpoint without delivered coordinates
    visible: Length  #: what is shorter cannot be measured at the scale of the drawing
    finest: ScaleText | None = None  #: a finer scale is doubtful for the product
    coarsest: ScaleText | None = None  #: and a coarser one


class LineworkSpec(Strict):
    """What the direction of linework means, and what is none: ``[linework]``.

    Tolerances of every rule that has them, unless the rule's own ``[[check]]`` says otherwise.
    """

    ahead: Angle = Quantity(60.0, "deg")  #: half-angle of the cone before an end in which it misses what is near
    alongside: Angle = Quantity(15.0, "deg")  #: what turns less against an end runs alongside
    remainder: Ratio = Quantity(300.0, "%")  #: an overshoot's line goes on beyond the meeting, in lengths of the stub
    heading: Length = Quantity(1.0, "mm", at_scale=True)  #: how far an end may head for a line
    symbol: Length = Quantity(
        3.0, "mm", at_scale=True
    )  #: circle into which the linework of a point symbol fits; 0: none
    symbol_times: Times = 3  #: inserts from which on a block so small is a sign that is repeated

    @property
    def tolerances(self) -> dict[str, Quantity]:
        """All of them by name; what is no quantity is none."""
        values = {name: getattr(self, name) for name in type(self).model_fields}
        return {name: value for name, value in values.items() if isinstance(value, Quantity)}


class ReadingSpec(Strict):
    """How drawings are taken in: ``[reading]``."""

    sagitta: Length  #: greatest distance between a curve and the chords that replace it
    blocks: Literal["explode", "skip"] = "explode"  #: ``skip``: only top-level linework is checked
    hidden: Literal["leave", "check"] = "leave"  #: ``check``: off and frozen layers are looked at too
    visible: Length = Quantity(0.2, "mm", at_scale=True)  #: what is smaller cannot be seen: it counts only if at fault


class MeshSpec(Strict):
    """How meshes are looked at: ``[mesh]``."""

    weld: Literal["identical", "none"] = "identical"  #: vertices with the same coordinates are one, or as delivered


_ENDS = ("undershoot", "overshoot", "free-end")  #: rules that ask whether an end lies on a curve


class ProfileFile(Strict):
    """A file of one's own that a profile was read from."""

    path: Path  #: as found
    sha256: str
    bytes: int


class Profile(Strict):
    """A product specification."""

    name: str
    title: dict[str, str] = Field(default_factory=dict)  #: per language
    product_class: Literal["A", "B"]
    norms: tuple[str, ...] = ()
    scale: str | None = None
    reading: ReadingSpec
    completeness: CompletenessSpec | None = None
    evidence: EvidenceSpec | None = None  #: left out: nothing can be tied, and no table shows anything
    linework: LineworkSpec = LineworkSpec()
    mesh: MeshSpec = MeshSpec()
    limits: LimitsSpec = LimitsSpec()
    checks: tuple[CheckSpec, ...]
    elements: tuple[ElementSpec, ...] = ()
    path: str = ""  #: file it came from
    sha256: str = ""  #: of that file; if it extends another, of both
    extends: str = ""  #: shipped name or path of what it extends
    files: tuple[ProfileFile, ...] = ()  #: of one's own, that it was read from; none if all of it is shipped
    changes: tuple[str, ...] = ()  #: what was set otherwise for one run: ``"--set undershoot.reach=5mm"``

    @property
    def shipped(self) -> bool:
        """Whether it comes with foparq."""
        return not self.files

    def titled(self, language: str) -> str:
        """Title in a language; its name, if it has none."""
        return self.title.get(language) or self.name

    def chord_distance(self, scale: float | None) -> float:
        """Greatest distance between a curve and its chords, metres.

        The stated sagitta, or a quarter of the finest ``coincide`` if that is less: a line that ends on a circle must
        not stop beside the chord.
        """
        finest = [spec.tolerances["coincide"].si(scale) / 4 for spec in self.checks if spec.rule in _ENDS]
        return min([self.reading.sagitta.si(scale), *(length for length in finest if length > 0)])

    def least_seen(self, scale: float | None) -> float:
        """Size below which nothing can be seen on the sheet, metres; 0 if it depends on a scale that nobody states."""
        visible = self.reading.visible
        return 0.0 if visible.at_scale and scale is None else visible.si(scale)
