# SPDX-License-Identifier: MIT
"""An element names the files that it speaks of, and claims no number where nothing was assessed."""

import pytest
from tests.evaluate.deliveries import judge, source, spec

from foparq.evaluate.quality import ElementStatus
from foparq.model.delivery import Delivery

#: files of every role
SOURCES = tuple(
    source(path, role)
    for path, role in [
        ("a.dxf", "drawing"), ("p.csv", "checkpoints"), ("d.csv", "distances"), ("f.csv", "features"),
        ("b.gpkg", "drawing"), ("delivery.toml", "manifest"), ("o.txt", "other"),
    ]
)  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "scope"),
    [
        ("absolute", "p.csv"), ("trend", "p.csv"), ("relative", "d.csv"), ("normality", "d.csv"),
        ("omission", "f.csv, a.dxf, b.gpkg"), ("commission", "f.csv, a.dxf, b.gpkg"),
        ("faulty-rate", "a.dxf, b.gpkg"), ("found-rate", "a.dxf, b.gpkg"),
    ],
)  # fmt: skip
def test_an_element_names_the_files_of_its_role(kind: str, scope: str) -> None:
    given = {"rules": ("gap",)} if scope.startswith("a.dxf") else {}
    elements = judge(spec(kind, **given), delivery=Delivery(title="", sources=SOURCES)).elements
    assert {element.scope for element in elements} == {scope}
    assert {(element.n, element.value) for element in elements} == {(0, None)}
    assert {element.status for element in elements} <= {ElementStatus.NOT_ASSESSED, ElementStatus.NOT_APPLICABLE}
