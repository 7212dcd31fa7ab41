# SPDX-License-Identifier: MIT
"""The example of CONTRIBUTING.md is run as it is printed."""

import re
import tomllib
from pathlib import Path

import pytest

from foparq.model.inputs import lines_of
from foparq.units import parse_quantity

GUIDE = (Path(__file__).resolve().parents[1] / "CONTRIBUTING.md").read_text(encoding="utf-8")


def block(language: str, start: str) -> str:
    found = re.findall(rf"```{language}\n(.*?)```", GUIDE, flags=re.DOTALL)
    return next(text for text in found if text.startswith(start))


def test_the_example_passes_its_own_cases(tmp_path: Path) -> None:
    module: dict[str, object] = {}
    (tmp_path / "short_line.py").write_text(block("python", "# SPDX"), encoding="utf-8")
    exec(compile(block("python", "# SPDX"), str(tmp_path / "short_line.py"), "exec"), module)  # noqa: S102
    rule = module["short_line"].rule  # type: ignore[attr-defined]
    cases = tomllib.loads(block("toml", "rule = "))["case"]
    assert len(cases) == 3
    for case in cases:
        tolerances = {name: parse_quantity(text, "m").si() for name, text in case["with"].items()}
        found = rule.check(lines_of(case["given"]["lines"]), **tolerances)
        assert found.row.tolist() == [want["row"] for want in case["find"]]
        assert found.size.tolist() == pytest.approx([want["size"] for want in case["find"]])
