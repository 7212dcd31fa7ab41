# SPDX-License-Identifier: MIT
"""Items on layers of no class, as a remark: those that a person sees, and that could be features."""

from dataclasses import replace

import numpy as np
import pytest
from tests.check.test_engine import drawing

from foparq.check.drawn.features import count_features
from foparq.model.items import Role

SHAPES = ["LINESTRING (0 0, 1 0)", "LINESTRING (0 2, 1 2)", "POINT (5 5)", "POLYGON ((7 7, 8 7, 8 8, 7 7))", None]


@pytest.mark.parametrize(
    ("role", "counted"),
    [
        (Role.LINE, True), (Role.AREA, True), (Role.POINT, True), (Role.ANNOTATION, False), (Role.HATCH, False),
        (Role.SURFACE, False),
    ],
)  # fmt: skip
def test_what_could_be_a_feature_is_counted_where_no_class_is_bound(role: Role, counted: bool) -> None:  # noqa: FBT001
    made = drawing(["LINESTRING (0 0, 1 0)", "LINESTRING (0 2, 1 2)"], layers=["JANELA", "OUTRA"], classes={"J*": "w"})
    roles = np.array(["line", role.value], dtype=object)
    found = count_features([replace(made, items=replace(made.items, role=roles))], gap=0.01)
    assert found is not None
    assert found.unmapped == ((("OUTRA", 1),) if counted else ())
    assert found.count.tolist() == [1]


def test_what_nobody_sees_is_no_remark() -> None:
    layers = ["A", "A", "A", "B", "A"]
    made = drawing(SHAPES, layers=layers, visible=[True, False, True, True, True], classes={"B": "w"})
    found = count_features([made], gap=0.01)
    assert found is not None
    assert found.unmapped == (("A", 2),)
    paper = replace(made, items=replace(made.items, paper=np.array([True, False, False, False, False])))
    found = count_features([paper], gap=0.01)
    assert found is not None
    assert found.unmapped == (("A", 1),)
