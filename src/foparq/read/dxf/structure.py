# SPDX-License-Identifier: MIT
"""Layers, layouts and block definitions of a document; like :mod:`foparq.read.dxf.facts`, only asks."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from foparq.model.layers import NEVER_PLOTTED
from foparq.read.dxf.curves import Point
from foparq.read.dxf.facts import LEAKS, MalformedError
from foparq.read.dxf.text import readable

Answer = TypeVar("Answer")

_EXTERNAL = 4 | 8  # flags of a block definition: external reference, overlay
_CONSTANT = 2  # flag of an attribute definition


@dataclass(frozen=True, slots=True)
class Definition:
    """One block definition."""

    name: str
    base: Point
    entities: list[Any]
    external: bool
    file: str  #: that an external reference points to


def asked(question: Callable[[], Answer]) -> Answer:
    """Answer of ezdxf to a question.

    Raises
    ------
    MalformedError
        If the document is so damaged that ezdxf raises.
    """
    try:
        return question()
    except LEAKS as error:
        raise MalformedError(" ".join(str(error).split()) or type(error).__name__) from error


def layer_table(document: Any) -> list[tuple[str, bool, bool]]:  # noqa: ANN401 - ezdxf publishes no useful types
    """Name, off and frozen of every layer; damaged entries are left out."""
    table = []
    for layer in asked(lambda: list(document.layers)):
        try:
            name = layer.dxf.name
            state = (bool(layer.is_off()), bool(layer.is_frozen()))
        except LEAKS:
            continue
        if isinstance(name, str) and name:
            table.append((readable(name), *state))
    return table


def unplotted_layers(document: Any) -> set[str]:  # noqa: ANN401
    """Names of the layers that are not plotted, and of that which never is; damaged entries are left out."""
    found = {NEVER_PLOTTED}
    for layer in asked(lambda: list(document.layers)):
        try:
            name, plots = layer.dxf.name, bool(layer.dxf.get("plot", 1))
        except LEAKS:
            continue
        if isinstance(name, str) and name and not plots:
            found.add(readable(name))
    return found


def model_entities(document: Any) -> list[Any]:  # noqa: ANN401
    """Entities of model space, in the order of the file.

    Raises
    ------
    MalformedError
        If there is no model space.
    """
    return asked(lambda: list(document.modelspace()))


def paper_entities(document: Any) -> list[Any]:  # noqa: ANN401
    """Entities of all layouts of paper space.

    Raises
    ------
    MalformedError
        If the layouts are damaged.
    """
    return asked(lambda: [entity for layout in document.layouts if not layout.is_modelspace for entity in layout])


def find_definition(document: Any, name: str) -> Definition | None:  # noqa: ANN401
    """Block definition by name; ``None`` if the file holds none, or a damaged one."""
    try:
        return asked(lambda: _definition(document.blocks.get(name)))
    except MalformedError:
        return None


def _definition(block: Any) -> Definition | None:  # noqa: ANN401
    if block is None or block.is_any_layout:
        return None
    x, y, z = block.block.dxf.base_point.xyz
    # A variable attribute definition is a form; the ATTRIB of each insert is what is drawn.
    drawn = [e for e in block if e.dxftype() != "ATTDEF" or int(e.dxf.get("flags", 0)) & _CONSTANT]
    external = bool(int(block.block.dxf.get("flags", 0)) & _EXTERNAL)
    file = str(block.block.dxf.get("xref_path", ""))
    return Definition(str(block.name), (float(x), float(y), float(z)), drawn, external, file)
