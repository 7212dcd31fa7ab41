# SPDX-License-Identifier: MIT
"""What model space and the blocks it uses hold, as facts; each definition is read once."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

from foparq.model.drawing import SkippedReason
from foparq.model.items import Role
from foparq.read.dxf.blocks import Census, count_blocks
from foparq.read.dxf.curves import Point
from foparq.read.dxf.facts import MalformedError, common_of, facts_of
from foparq.read.dxf.kinds import Unseen
from foparq.read.dxf.records import Common, Facts, InsertFacts, PlaceFacts
from foparq.read.dxf.structure import Definition, asked, find_definition, model_entities
from foparq.read.dxf.text import readable
from foparq.read.dxf.units import Lettered, lettered_dimension

MODEL = ""  #: name of model space among the blocks

MALFORMED = Unseen(SkippedReason.MALFORMED)


@dataclass(frozen=True, slots=True)
class Insert:
    """One reference to an ordinary block."""

    common: Common
    facts: InsertFacts
    block: str  #: key of the definition
    attributes: tuple[tuple[Common, Facts], ...]

    @property
    def times(self) -> int:
        """Cells of the array."""
        return self.facts.rows * self.facts.columns


@dataclass(slots=True)
class Content:
    """Entities of model space or of one block definition, in the order of the file."""

    base: Point = (0.0, 0.0, 0.0)
    entities: list[tuple[Common, Facts]] = field(default_factory=list)
    inserts: list[Insert] = field(default_factory=list)
    dimensions: list[Lettered] = field(default_factory=list)


def read_contents(document: Any, *, explode: bool) -> dict[str, Content]:  # noqa: ANN401 - ezdxf.Drawing
    """Facts of model space (``MODEL``) and of every block definition that it reaches.

    Parameters
    ----------
    document : ezdxf.Drawing
    explode : bool
        False if ordinary blocks are not wanted.

    Raises
    ------
    MalformedError
        If there is no model space.
    """
    blocks = _Blocks(document, explode=explode)
    contents = {MODEL: _content(model_entities(document), blocks)}
    waiting = [insert.block for insert in contents[MODEL].inserts]
    while waiting:
        name = waiting.pop()
        definition = blocks.find(name)
        if name in contents or definition is None:
            continue
        contents[name] = _content(definition.entities, blocks)
        contents[name].base = definition.base
        waiting.extend(insert.block for insert in contents[name].inserts)
    return contents


class _Blocks:
    """Block definitions, each looked up once."""

    def __init__(self, document: Any, *, explode: bool) -> None:  # noqa: ANN401
        self._document, self._explode = document, explode
        self._found: dict[str, Definition | None] = {}

    def find(self, name: str) -> Definition | None:
        """Definition by name."""
        if name not in self._found:
            self._found[name] = find_definition(self._document, name)
        return self._found[name]

    def refusal(self, name: str) -> Unseen | None:
        """Why an insert of that block is not taken apart; ``None`` if it is."""
        definition = self.find(name)
        shown = readable(name)
        if definition is None:
            return Unseen(SkippedReason.MISSING_BLOCK, shown)
        if definition.external and not definition.entities:
            file = readable(definition.file)
            return Unseen(SkippedReason.EXTERNAL_REFERENCE, f"{shown} ({file})" if file else shown)
        return None if self._explode else Unseen(SkippedReason.BLOCKS_SKIPPED, shown)


def count_contents(contents: dict[str, Content]) -> Census:
    """Count what every block, and model space, would expand to; attributes stand with the insert they belong to."""
    own, uses = {}, {}
    for name, content in contents.items():
        attributes = sum(insert.times * len(insert.attributes) for insert in content.inserts)
        own[name] = len(content.entities) + attributes
        uses[name] = [(insert.block, insert.times) for insert in content.inserts]
    return count_blocks(own, uses)


def _content(space: Iterable[Any], blocks: _Blocks) -> Content:
    content = Content()
    for entity in space:
        common, facts = _entity(entity)
        if isinstance(facts, InsertFacts):
            _sort_insert(content, common, facts, blocks)
            continue
        content.entities.append((common, facts))
        if common.kind == "DIMENSION" and facts != MALFORMED:
            dimension = _lettered(entity, common.handle)
            if dimension is not None:
                content.dimensions.append(dimension)
    return content


def _entity(entity: Any) -> tuple[Common, Facts]:  # noqa: ANN401
    try:
        common = asked(lambda: common_of(entity))
    except MalformedError:
        return Common("UNKNOWN", "", "0", 256, invisible=False), MALFORMED
    layer = readable(common.layer)
    if layer != common.layer:
        common = replace(common, layer=layer)
    try:
        return common, facts_of(entity)
    except MalformedError:
        return common, MALFORMED


def _lettered(entity: Any, handle: str) -> Lettered | None:  # noqa: ANN401
    try:
        return lettered_dimension(entity, handle)
    except MalformedError:
        return None  # drawn all the same; its lettering says nothing


def _sort_insert(content: Content, common: Common, facts: InsertFacts, blocks: _Blocks) -> None:
    attributes = tuple(_entity(entity) for entity in facts.attributes)
    kind = facts.name[:2].upper()
    if kind == "*X":  # a hatch of older programs: thousands of strokes that are no linework
        content.entities.append((common, PlaceFacts(facts.point, facts.extrusion, Role.HATCH)))
    elif kind in ("*D", "*T"):  # drawing of a dimension or table
        content.entities.append((common, PlaceFacts(facts.point, facts.extrusion, Role.ANNOTATION)))
    elif (unseen := blocks.refusal(facts.name)) is not None:
        content.entities.append((common, unseen))
    elif (definition := blocks.find(facts.name)) is not None:
        content.inserts.append(Insert(common, facts, definition.name, attributes))
        return
    content.entities.extend(attributes)
