# SPDX-License-Identifier: MIT
"""The example of CONTRIBUTING.md is run as it is printed."""

import re
import tomllib
from pathlib import Path

import pytest
from tests.texts import check_texts

from foparq.check.rule import Rule
from foparq.model.inputs import lines_of
from foparq.units import parse_quantity

GUIDE = (Path(__file__).resolve().parents[1] / "CONTRIBUTING.md").read_text(encoding="utf-8")


def block(language: str, start: str) -> str:
    found = re.findall(rf"```{language}\n(.*?)```", GUIDE, flags=re.DOTALL)
    return next(text for text in found if text.startswith(start))


@pytest.fixture(scope="module")
def example(tmp_path_factory: pytest.TempPathFactory) -> Rule:
    file = tmp_path_factory.mktemp("example") / "short_line.py"
    file.write_text(block("python", "# SPDX"), encoding="utf-8")
    module: dict[str, object] = {}
    exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), module)  # noqa: S102
    rule = module["short_line"].rule  # type: ignore[attr-defined]
    assert isinstance(rule, Rule)
    return rule


def test_the_example_passes_its_own_cases(example: Rule) -> None:
    cases = tomllib.loads(block("toml", "rule = "))["case"]
    assert len(cases) == 3
    for case in cases:
        tolerances = {name: parse_quantity(text, "m").si() for name, text in case["with"].items()}
        found = example.check(lines_of(case["given"]["lines"]), **tolerances)
        assert found.row.tolist() == [want["row"] for want in case["find"]]
        assert found.size.tolist() == pytest.approx([want["size"] for want in case["find"]])


def test_the_texts_of_the_example_are_whole(example: Rule) -> None:
    check_texts(example, tomllib.loads(block("toml", "[en]")))


def test_the_example_is_bound_with_its_tolerances(example: Rule) -> None:
    (bound,) = tomllib.loads(block("toml", "[[check]]"))["check"]
    assert bound["rule"] == example.name
    assert {name for name, _ in example.tolerances} == set(bound) - {"rule", "severity"}
    for name, unit in example.tolerances:
        assert parse_quantity(bound[name], unit)
