# SPDX-License-Identifier: MIT
"""Meshes delivered beside a drawing that is accepted, so that what is said of the meshes decides."""

import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.attacks.kinds import BY_ID
from tests.attacks.meshes import write_ply
from tests.mesh.files import Mesh
from tests.tools.office_files import write
from tests.tools.offices import office
from tests.tools.sound import unguarded

from foparq.audit import Audit, audit
from foparq.evaluate.quality import Element
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words

_HEAD = 'extends = "et-doc-foparq-a"\nname = "obra"\nproduct_class = "A"\n[title]\npt-BR = "Obra"\nen = "Works"\n'


@dataclass(frozen=True, kw_only=True)
class Meshes:
    """What is delivered beside the drawing."""

    files: Mapping[str, Mesh | bytes]
    closed: bool | None = None
    unit: str = "m"
    facades: tuple[str, ...] = ()  #: of the files, in their order
    own: str = ""  #: what a profile of the delivery's own says beside the shipped one
    drawing: bool = True


@dataclass(frozen=True)
class Answer:
    """What was said."""

    done: Audit
    found: Mapping[str, int] = field(init=False)

    def __post_init__(self) -> None:
        counts: dict[str, int] = {}
        for one in self.done.record.outcomes:
            if one.name and one.found and one.source.startswith("mesh"):
                counts[one.name] = counts.get(one.name, 0) + one.found
        object.__setattr__(self, "found", counts)

    @property
    def verdict(self) -> str:
        return str(self.done.record.quality.verdict)

    def element(self, of: str = "Q3-mesh") -> Element:
        return next(one for one in self.done.record.quality.elements if one.id == of)

    @property
    def state(self) -> str:
        return str(self.element().status)

    @property
    def sentences(self) -> list[str]:
        """Of the verdict, the remarks, and the element of meshes."""
        quality, words = self.done.record.quality, Words("en")
        said = (*quality.why, *quality.remarks, *self.element().why)
        return list(dict.fromkeys(reason_sentence(words, reason) for reason in said))


def sound_drawing(folder: Path) -> Path:
    """A delivery of class A that is accepted as it is."""
    return write(office(2000, n=9, **BY_ID), folder)


def deliver(made: Meshes, base: Path, folder: Path) -> Answer:
    """Add meshes to a copy of a delivery, and audit it."""
    shutil.copytree(base, folder)
    text = (folder / "delivery.toml").read_text("utf-8")
    if made.own:
        (folder / "own.toml").write_text(_HEAD + made.own, encoding="utf-8")
        text = text.replace("[delivery]\n", '[delivery]\nprofile = "own.toml"\n', 1)
    if not made.drawing:
        text = re.sub(r"\[\[drawing\]\]\n(?:[^\[]+\n)+", "", text)
    for k, (name, content) in enumerate(made.files.items()):
        path = folder / f"mesh-{name}"
        if isinstance(content, bytes):
            path.write_bytes(content)
        else:
            path = write_ply(content, path.with_suffix(".ply"))
        text += f'\n[[mesh]]\npath = "{path.name}"\n'
        text += f'unit = "{made.unit}"\n' if made.unit else ""
        text += "" if made.closed is None else f"closed = {str(made.closed).lower()}\n"
        text += f'facade = "{made.facades[k]}"\n' if made.facades else ""
    (folder / "delivery.toml").write_text(text, encoding="utf-8")
    with unguarded():
        done = audit(folder)
    assert not done.log
    return Answer(done)
