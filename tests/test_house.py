# SPDX-License-Identifier: MIT
"""The conventions of the house, executable. A failing message says what to do."""

import ast
import gettext
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.texts import check_texts, placeholders

from foparq.check.catalogue import cards
from foparq.check.registry import all_rules, in_order
from foparq.check.validate import validate_checks
from foparq.profile.load import load_profile, shipped_profiles
from foparq.report.words import DOMAINS, LANGUAGES, Words

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "src" / "foparq"
LOCALE = ROOT / "reports" / "templates" / "locale"
FILES = sorted(SOURCE.rglob("*.py"))
RULES = list(all_rules().values())

#: third-party packages and the only folders that may import them
FLOORED = {
    "ezdxf": ("read", "report"),
    "pyogrio": ("read", "report"),
    "pyproj": ("read", "model"),
    "lxml": ("read", "report"),
    "openpyxl": ("read",),
    "laspy": ("read",),
    "jinja2": ("report",),
    "click": ("cli",),
    "rich": ("cli",),
    "pydantic": ("profile",),
    "numba": ("mesh",),
}
#: operations that change what they are given
FORBIDDEN_CALLS = {"make_valid", "set_precision", "snap", "iterrows", "itertuples"}


def identify(path: Path) -> str:
    return str(path.relative_to(ROOT))


def parse(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def functions(tree: ast.AST) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
    return (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef))


@pytest.mark.parametrize("path", FILES, ids=identify)
def test_file_is_short(path: Path) -> None:
    limit = 200 if "rules" in path.parts else 300
    lines = len(path.read_text(encoding="utf-8").splitlines())
    assert lines <= limit, f"{lines} lines, {limit} are allowed: take one idea out into a file of its own"


@pytest.mark.parametrize("path", FILES, ids=identify)
def test_functions_are_short(path: Path) -> None:
    for function in functions(parse(path)):
        body = function.body[1:] if ast.get_docstring(function) else function.body
        lines = (body[-1].end_lineno or 0) - body[0].lineno + 1 if body else 0
        assert lines <= 60, f"{function.name} has {lines} lines, 60 are allowed: name a part of it"


@pytest.mark.parametrize("path", FILES, ids=identify)
def test_file_states_its_licence(path: Path) -> None:
    first = path.read_text(encoding="utf-8").split("\n", 1)[0]
    assert first == "# SPDX-License-Identifier: MIT", "begin the file with the SPDX line"


@pytest.mark.parametrize("path", FILES, ids=identify)
def test_third_party_imports_stay_on_their_floor(path: Path) -> None:
    room = path.relative_to(SOURCE).parts[0]
    for node in ast.walk(parse(path)):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        names += [node.module or ""] if isinstance(node, ast.ImportFrom) and not node.level else []
        for name in names:
            allowed = FLOORED.get(name.split(".")[0])
            assert allowed is None or room in allowed, (
                f"{name} belongs in {allowed}, not in {room}: see CONTRIBUTING, Where things are"
            )


@pytest.mark.parametrize("path", [p for p in FILES if {"check", "geom", "mesh"} & set(p.parts)], ids=identify)
def test_nothing_is_repaired(path: Path) -> None:
    for node in ast.walk(parse(path)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            assert node.func.attr not in FORBIDDEN_CALLS, f"{node.func.attr} changes what is audited: report it instead"


def tool(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, *command], cwd=ROOT, capture_output=True, text=True, check=False)


def test_floors() -> None:
    done = tool("-c", "import sys; from importlinter.cli import lint_imports_command as run; sys.exit(run())")
    assert done.returncode == 0, f"an import goes upward or sideways:\n{done.stdout}{done.stderr}"


def test_strict_typing() -> None:
    done = tool("-m", "mypy")
    assert done.returncode == 0, done.stdout


def test_lint() -> None:
    done = tool("-m", "ruff", "check", ".")
    assert done.returncode == 0, done.stdout


def test_format() -> None:
    done = tool("-m", "ruff", "format", "--check", ".")
    assert done.returncode == 0, f"run `uv run ruff format .`\n{done.stdout}"


# --- rules -----------------------------------------------------------------------------------------------------------


def test_cards_tell_what_the_rules_are() -> None:
    told = [(c.code, c.name, c.manual, c.tolerances, c.measures, c.requires, c.preview, c.subject) for c in cards()]
    true = [
        (r.code, r.name, r.manual, r.tolerances, r.measures, r.requires, r.preview, r.subject.__name__) for r in RULES
    ]
    assert told == true, "write the arguments of @rule as literals: foparq rules reads the file without running it"


def test_every_rule_file_is_a_rule() -> None:
    files = [path for path in (SOURCE / "check" / "rules").rglob("*.py") if path.name != "__init__.py"]
    assert sorted(path.stem.replace("_", "-") for path in files) == sorted(rule.name for rule in RULES)
    for rule in RULES:
        folder = Path(sys.modules[rule.check.__module__].__file__ or "").parent.name
        assert folder == rule.code[:3].lower(), f"{rule.code} lies in {folder}/: the folder is the family of the code"


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_rule_is_documented(rule) -> None:  # noqa: ANN001
    assert re.fullmatch(r"[A-Z]{3}\d{3}", rule.code)
    assert re.fullmatch(r"[a-z]+(-[a-z]+)*", rule.name), "kebab-case, the fault, reads after 'allow ...'"
    for section in ("Parameters\n", "Returns\n", "Notes\n"):
        assert section in rule.manual, f"the docstring of {rule.code} is its manual: add the section {section.strip()}"
    assert "oes not" in rule.manual, f"the manual of {rule.code} must say what the rule does not test"
    assert re.search(r"O\(", rule.manual), f"the manual of {rule.code} must state the complexity"
    for name, _ in rule.tolerances:
        assert f"{name}" in rule.manual, f"the manual of {rule.code} does not explain {name}"


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_rule_has_its_texts(rule) -> None:  # noqa: ANN001
    file = f"rules/texts/{rule.code}.toml"
    assert (ROOT / file).is_file(), f"write {file}: see CONTRIBUTING.md, step 5"
    check_texts(rule, tomllib.loads((ROOT / file).read_text(encoding="utf-8")))


def test_every_file_of_texts_and_cases_has_its_rule() -> None:
    for folder in (ROOT / "rules" / "texts", ROOT / "tests" / "cases"):
        without = {path.stem for path in folder.iterdir()} - set(all_rules())
        assert not without, f"{identify(folder)}: no rule has the code {sorted(without)}"


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_rule_has_cases(rule) -> None:  # noqa: ANN001
    path = ROOT / "tests" / "cases" / f"{rule.code}.toml"
    assert path.is_file(), (
        f"write {path.relative_to(ROOT)}: a fault, a valid near miss, an empty input, one exactly at tolerance"
    )
    cases = tomllib.loads(path.read_text(encoding="utf-8"))["case"]
    names = " | ".join(case["name"].lower() for case in cases)
    assert any(case["find"] for case in cases), "a case with a fault is missing"
    assert any(not case["find"] for case in cases), "a valid near miss is missing"
    assert "empty" in names or "nothing" in names, "a case with an empty input is missing (say 'empty' in its name)"
    if rule.tolerances:
        assert "exactly" in names, "a case exactly at tolerance is missing (say 'exactly' in its name)"


def test_required_rules_run_first() -> None:
    order = in_order(set(all_rules()))
    for rule in RULES:
        for needed in rule.requires:
            assert order.index(needed) < order.index(rule.code)


@pytest.mark.parametrize("name", shipped_profiles())
def test_shipped_profile_binds_every_rule(name: str) -> None:
    bound = {spec.rule for spec in load_profile(name).checks}
    for rule in RULES:
        assert rule.name in bound, f'{name}: add [[check]] rule = "{rule.name}" to rules/profiles/et-doc-foparq-a.toml'
    validate_checks(load_profile(name))


# --- texts -----------------------------------------------------------------------------------------------------------


def catalogue(language: str, domain: str) -> dict[str, str]:
    compiled = LOCALE / language.replace("-", "_") / "LC_MESSAGES" / f"{domain}.mo"
    with compiled.open("rb") as stream:
        found = gettext.GNUTranslations(stream)._catalog  # type: ignore[attr-defined]
    return {key: text for key, text in found.items() if key and isinstance(key, str)}


@pytest.mark.parametrize("path", sorted(LOCALE.rglob("*.po")), ids=identify)
def test_no_message_is_defined_twice(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    ids = re.findall(r'^msgid "([^"]+)"', text, flags=re.MULTILINE)
    assert not {name for name in ids if ids.count(name) > 1}
    assert not re.findall(r'^msgstr ".+"\n(?=msgstr ")', text, flags=re.MULTILINE), "two texts of one message"


@pytest.mark.parametrize("domain", DOMAINS)
def test_catalogues_speak_of_the_same(domain: str) -> None:
    english, portuguese = catalogue("en", domain), catalogue("pt-BR", domain)
    only = set(english) ^ set(portuguese)
    assert not only, f"{domain}.po: in one language only: {sorted(only)}"
    for key in set(english) & set(portuguese):
        assert placeholders(english[key]) == placeholders(portuguese[key]), (
            f"{domain}: {key} names other fields in one language"
        )
        assert english[key].strip(), f"{domain}: {key} is empty"


def literal_messages() -> Iterator[tuple[str, str]]:
    """Every message id that stands in the code as a plain string."""
    domains = "|".join((*DOMAINS, "rules"))
    for path in FILES:
        for node in ast.walk(parse(path)):
            if (
                isinstance(node, ast.Constant)
                and isinstance(node.value, str)
                and re.fullmatch(rf"({domains})\.[a-zA-Z][\w.-]*[\w]", node.value)
            ):
                yield identify(path), node.value


def test_every_message_of_the_code_exists() -> None:
    words = {language: Words(language) for language in LANGUAGES}
    missing = {
        (where, key)
        for where, key in literal_messages()
        for language in LANGUAGES
        if words[language].find(key) is None and not key.endswith((".po", ".html"))
    }
    assert not missing, f"add to the catalogues: {sorted(missing)}"


def raised_errors() -> Iterator[tuple[str, str]]:
    for path in FILES:
        for node in ast.walk(parse(path)):
            called = node.func if isinstance(node, ast.Call) else None
            name = called.id if isinstance(called, ast.Name) else ""
            if name.endswith("Error") and name not in {
                "KeyError",
                "ValueError",
                "TypeError",
                "RuntimeError",
                "FileNotFoundError",
            }:
                first = node.args[0] if isinstance(node, ast.Call) and node.args else None
                if isinstance(first, ast.Constant) and isinstance(first.value, str):
                    yield identify(path), first.value


def test_every_error_has_its_sentence() -> None:
    missing = {
        (where, key)
        for where, key in raised_errors()
        for language in LANGUAGES
        if Words(language).find(f"errors.{key}") is None
    }
    assert not missing, f"add to errors.po: {sorted(missing)}"
