# SPDX-License-Identifier: MIT
"""Layers that are not plotted, and letterings on what nobody sees."""

from pathlib import Path

import ezdxf
import pytest
from tests.read.drawn import read

STATES = {"PAREDE": {}, "AUXILIAR": {"plot": 0}, "Defpoints": {}, "GELADA": {"flags": 1}, "apagada": {"color": -7}}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    document = ezdxf.new("R2013")
    for name, state in STATES.items():
        layer = document.layers.get(name) if name in document.layers else document.layers.add(name)
        for key, value in state.items():
            layer.dxf.set(key, value)
    document.blocks.new("ALVO").add_attdef("ID", (0, 0))
    for number, name in enumerate(STATES):
        on = {"layer": name.upper()}
        document.modelspace().add_line((0, number), (9, number), dxfattribs=on)
        document.modelspace().add_text(f"T {name}", dxfattribs={**on, "insert": (0, number)})
        document.modelspace().add_blockref("ALVO", (5, number), dxfattribs=on).add_attrib(
            "ID", f"B {name}", (5, number)
        )
    document.modelspace().add_text("T unsichtbar", dxfattribs={"layer": "PAREDE", "invisible": 1})
    document.saveas(tmp_path / "a.dxf")
    return tmp_path / "a.dxf"


def test_layers_that_are_not_plotted_are_named_as_the_file_does(path: Path) -> None:
    assert set(read(path).reading.unplotted) == {"AUXILIAR", "Defpoints"}


def test_letterings_that_nobody_sees_name_nothing(path: Path) -> None:
    labels = read(path).reading.labels
    assert labels is not None
    assert sorted(labels.text.tolist()) == ["B PAREDE", "T PAREDE"]


def test_linework_that_is_not_plotted_is_checked_like_any_other(path: Path) -> None:
    items = read(path).items
    seen = set(items.layer[items.visible & (items.kind == "LINE")].tolist())
    assert seen == {"PAREDE", "AUXILIAR", "Defpoints"}
