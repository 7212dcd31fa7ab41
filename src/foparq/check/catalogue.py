# SPDX-License-Identifier: MIT
"""The rules as cards, read from their files without running them: ``foparq rules`` answers at once."""

import ast
import inspect
import itertools
from dataclasses import dataclass
from pathlib import Path

from foparq.errors import RuleError, UsageError

_FOLDER = Path(__file__).resolve().parent / "rules"
_UNITS = {"Metres": "m", "SquareMetres": "m2", "Ratio": "1", "Count": "items", "Radians": "rad"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Card:
    """What a person asks of a rule."""

    code: str
    name: str
    fault: str  #: first line of the manual
    manual: str  #: the docstring
    subject: str  #: what it looks at: ``"Lines"``
    tolerances: tuple[tuple[str, str], ...]  #: name and SI unit
    measures: tuple[str, ...]  #: ISO 19157 ids
    requires: tuple[str, ...]
    preview: bool


def cards() -> list[Card]:
    """A card for every rule, in order of codes."""
    files = sorted(path for path in _FOLDER.rglob("*.py") if path.name != "__init__.py")
    found = sorted((_card(path) for path in files), key=lambda card: card.code)
    for one, two in itertools.pairwise(found):
        if one.code == two.code:
            raise RuleError("rule.code-twice", code=one.code, file=one.name, other=two.name)
    return found


def find_card(text: str) -> Card:
    """Card by code or name, in any case.

    Raises
    ------
    UsageError
        If there is none; names the nearest.
    """
    import difflib  # noqa: PLC0415 - only when a name is wrong

    wanted = text.strip().casefold()
    by_word = {word.casefold(): card for card in cards() for word in (card.code, card.name)}
    if wanted not in by_word:
        near = difflib.get_close_matches(wanted, by_word, n=1, cutoff=0.0)
        raise UsageError("usage.unknown-rule", value=text, example=by_word[near[0]].name if near else "undershoot")
    return by_word[wanted]


def _card(path: Path) -> Card:
    module = ast.parse(path.read_text(encoding="utf-8"))
    function = next(node for node in module.body if isinstance(node, ast.FunctionDef) and node.name == path.stem)
    decorator = next(
        node for node in function.decorator_list
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "rule"
    )  # fmt: skip
    code, name = (ast.literal_eval(argument) for argument in decorator.args)
    options = {keyword.arg: ast.literal_eval(keyword.value) for keyword in decorator.keywords}
    manual = inspect.cleandoc(ast.get_docstring(function) or "")
    return Card(
        code=code,
        name=name,
        fault=manual.split("\n", 1)[0],
        manual=manual,
        subject=_annotation(function.args.args[0]),
        tolerances=tuple((arg.arg, _UNITS[_annotation(arg)]) for arg in function.args.kwonlyargs),
        measures=options.get("measures", ()),
        requires=options.get("requires", ()),
        preview=options.get("preview", False),
    )


def _annotation(argument: ast.arg) -> str:
    return ast.unparse(argument.annotation) if argument.annotation is not None else ""
