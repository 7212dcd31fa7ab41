# SPDX-License-Identifier: MIT
"""Every reason has a sentence, every sentence has a use, and the catalogue of measures is sound."""

import ast
import re
from pathlib import Path

import pytest

import foparq.evaluate
from foparq.check.registry import all_rules
from foparq.evaluate.balance import Incomparable
from foparq.evaluate.measures import measure_counting, measures
from foparq.evaluate.of_meshes import TWINS
from foparq.evaluate.quality import Verdict
from foparq.findings.because import Because
from foparq.findings.table import Severity
from foparq.profile.load import load_profile, shipped_profiles
from foparq.profile.looser import Point
from foparq.report.words import LANGUAGES, Words
from foparq.resources import shipped

CODE = Path(foparq.evaluate.__path__[0])
SHAPED = r"^[a-z]+\.[a-z-]+$"


def reasons() -> set[str]:
    """Message ids that the evaluation may give, read from its source."""
    found = {f"features.{gap.value}" for gap in Incomparable if gap is not Incomparable.NONE}
    for path in sorted(CODE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and re.match(SHAPED, node.value):
                found.add(node.value)
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "reason":
                cases = [part.value for part in ast.walk(node.args[0]) if isinstance(part, ast.Constant)]
                cases = cases or ["fail", "fail-all-the-same"]
                found |= {f"{kind}.{case}" for kind in ("absolute", "relative") for case in cases}
    found |= {f"checks.{because}" for because in Because if because.opens}
    found |= {f"files.{because}" for because in Because if because.opens and because is not Because.CRASHED}
    found |= {f"looser.{point}" for point in Point} | {f"severity.{severity}" for severity in Severity}
    found |= {f"{message}-mesh" for message in TWINS}
    return found - {"measures.toml"}


def keys() -> set[str]:
    text = (shipped("templates") / "locale/en/LC_MESSAGES/evaluate.po").read_text(encoding="utf-8")
    return set(re.findall(r'^msgid "([^"]+)"$', text, flags=re.MULTILINE))


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_reason_has_a_sentence(language: str) -> None:
    words = Words(language)
    assert len(reasons()) > 60
    assert not sorted(message for message in reasons() if words.find(f"evaluate.{message}") is None)


def test_every_sentence_is_used() -> None:
    spoken = {
        key
        for key in keys()
        if not re.match(r"(element\..*\.title|measure\.|method\.|sampling\.|xml\.|verdict\.name)", key)
    }
    assert sorted(spoken - reasons()) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_elements_measures_and_verdicts_have_names(language: str) -> None:
    words = Words(language)
    for profile in map(load_profile, shipped_profiles()):
        for element in profile.elements:
            axes = ("-X", "-Y", "-Z") if element.kind in {"absolute", "trend"} else ("",)
            assert all(words.find(f"evaluate.element.{element.id}{axis}.title") for axis in axes)
    assert all(words.find(f"evaluate.measure.{id_}") for id_ in measures())
    assert all(words.find(f"evaluate.verdict.name.{verdict.value}") for verdict in Verdict)


def test_english_names_of_measures_are_those_of_the_catalogue() -> None:
    words = Words("en")
    assert {id_: words(f"evaluate.measure.{id_}") for id_ in measures()} == {
        id_: m.name for id_, m in measures().items()
    }


def test_measures_of_the_standard() -> None:
    """Ids, names and elements as public catalogues of ISO 19157 print them."""
    known = {
        "3": ("rate of excess items", "CompletenessCommission"),
        "7": ("rate of missing items", "CompletenessOmission"),
        "23": ("number of missing connections due to undershoots", "TopologicalConsistency"),
        "39": ("root mean square error", "AbsoluteExternalPositionalAccuracy"),
        "101": ("data product specification passed", "UsabilityElement"),
    }
    for id_, (name, element) in known.items():
        assert (measures()[id_].name, measures()[id_].element) == (name, element)
    assert all(":" in id_ or id_.isdigit() for id_ in measures())
    assert all(
        measure.definition and measure.value in {"Boolean", "Integer", "Measure", "Real"}
        for measure in measures().values()
    )


def test_rules_and_catalogue_agree_on_what_counts_what() -> None:
    for rule in all_rules().values():
        counting = measure_counting(rule.name)
        if counting is not None:
            assert counting.id in rule.measures, (
                f"{rule.name} does not claim measure {counting.id}, measures.toml says so"
            )
