# SPDX-License-Identifier: MIT
"""Mutants: one small change each, in a copy of the source; made by hand in ``mutants.toml`` or by chance."""

import ast
import hashlib
import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from difflib import unified_diff
from itertools import islice
from pathlib import Path

import numpy as np

#: folders of the source that are mutated, and the name they have in the table
ROOMS = ("geom", "accuracy", "check", "evaluate", "read", "profile", "report", "findings", "model", "units.py")

_COMPARED = {
    ast.Lt: ("<", "<="), ast.LtE: ("<=", "<"), ast.Gt: (">", ">="), ast.GtE: (">=", ">"), ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="), ast.In: ("in", "not in"), ast.NotIn: ("not in", "in"), ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
}  # fmt: skip
_CALCULATED = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.BitAnd: ("&", "|"),
    ast.BitOr: ("|", "&"),
}  # fmt: skip
_SWAPPED = {
    "min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum", "argmin": "argmax", "argmax": "argmin",
    "any": "all", "all": "any", "floor": "ceil", "ceil": "floor",
}  # fmt: skip
#: calls whose arguments are words for people, or say how objects are laid out: no test is owed for these
_WORDS = {"because", "dataclass", "reason", "Field", "TypeVar", "ConfigDict"}
_SILENT_KEYWORDS = {"strict", "encoding", "errors", "dtype", "usedforsecurity", "repr"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """One change of one file."""

    file: str  #: below ``src/foparq``
    start: int  #: offset in the text of the file
    old: str
    new: str
    function: str  #: qualified name of the function it lies in; ``""`` outside of any
    kind: str  #: ``hand``, or what the random change is
    why: str = ""  #: of a change by hand: what would go wrong
    equivalent: str = ""  #: why no test can tell

    @property
    def room(self) -> str:
        """Name in the table."""
        return self.file.split("/")[0]

    @property
    def key(self) -> str:
        """Name that stays while other parts of the file change."""
        text = (
            f"{self.file}\x1f{self.function}\x1f{self.kind}\x1f{self.old}\x1f{self.new}\x1f{self.why}\x1f{self.start}"
        )
        return hashlib.sha256(text.encode()).hexdigest()[:12]

    def applied(self, text: str) -> str:
        """Text of the file with the change."""
        assert text[self.start : self.start + len(self.old)] == self.old, f"{self.file} has changed"
        return text[: self.start] + self.new + text[self.start + len(self.old) :]

    def diff(self, text: str) -> str:
        """The change as a reader of code sees it."""
        lines = unified_diff(text.splitlines(), self.applied(text).splitlines(), n=1, lineterm="")
        return "\n".join([self.file, *list(lines)[2:]])


def by_hand(data: Path, source: Path) -> tuple[list[Mutant], list[str]]:
    """Mutants of the data file, and complaints about those whose old text is not exactly once in its file."""
    made, stale = [], []
    for row in tomllib.loads(data.read_text(encoding="utf-8"))["mutant"]:
        text = (source / row["file"]).read_text(encoding="utf-8") if (source / row["file"]).is_file() else ""
        if text.count(row["old"]) != 1:
            stale.append(f"{row['file']}: {text.count(row['old'])} times: {row['old']}")
            continue
        start = text.index(row["old"])
        function = _function_at(text, start)
        made.append(Mutant(**{"equivalent": "", **row}, start=start, function=function, kind="hand"))
    return made, stale


def by_chance(source: Path, count: int, seed: int) -> list[Mutant]:
    """``count`` random mutants; every room gets a share by the square root of what can be changed in it."""
    sites: dict[str, list[Mutant]] = {room: [] for room in ROOMS}
    texts: dict[str, str] = {}
    for path in sorted(source.rglob("*.py")):
        name = path.relative_to(source).as_posix()
        if name.split("/")[0] in sites:
            texts[name] = path.read_text(encoding="utf-8")
            sites[name.split("/")[0]].extend(changes(name, texts[name]))
    weight = np.sqrt([len(found) for found in sites.values()])
    share = np.floor(count * np.cumsum(weight) / weight.sum() + 0.5).astype(int)
    rng = np.random.default_rng(seed)
    chosen: list[Mutant] = []
    for number, found in zip(np.diff(share, prepend=0), sites.values(), strict=True):
        order = (found[row] for row in rng.permutation(len(found)).tolist())
        chosen += islice((one for one in order if _parses(one.applied(texts[one.file]))), int(number))
    return chosen


def _parses(text: str) -> bool:
    try:
        ast.parse(text)
    except SyntaxError:
        return False
    return True


def changes(file: str, text: str) -> list[Mutant]:
    """Every random change that a file offers."""
    walker = _Walker(file, text)
    walker.visit(ast.parse(text))
    return walker.made


class _Walker(ast.NodeVisitor):
    def __init__(self, file: str, text: str) -> None:
        self.file, self.text, self.made = file, text, list[Mutant]()
        self._names: list[str] = []
        self._inside = 0  # functions around
        lines = text.splitlines(keepends=True)
        self._lines = [line.encode() for line in lines]
        self._starts = np.concatenate([[0], np.cumsum([len(line) for line in lines])])

    def _offset(self, line: int, column: int) -> int:
        return int(self._starts[line - 1]) + len(self._lines[line - 1][:column].decode())

    def _span(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        return self._offset(node.lineno, node.col_offset), self._offset(node.end_lineno or 0, node.end_col_offset or 0)

    def _add(self, kind: str, start: int, old: str, new: str) -> None:
        function = ".".join(self._names) if self._inside else ""
        found = Mutant(file=self.file, start=start, old=old, new=new, function=function, kind=kind)
        self.made.append(found)

    def _between(self, kind: str, left: ast.expr, right: ast.expr, old: str, new: str) -> None:
        start, end = self._span(left)[1], self._span(right)[0]
        word = rf"\b{old}\b" if old.isalpha() else re.escape(old).replace(r"\ ", r"\s+")
        if found := re.search(word, self.text[start:end]):
            self._add(kind, start + found.start(), found[0], new)

    # What is never changed: annotations, messages, layout of classes.

    def _function(self, node: ast.FunctionDef | ast.AsyncFunctionDef) -> None:
        self._names.append(node.name)
        for default in (*node.args.defaults, *filter(None, node.args.kw_defaults)):
            self.visit(default)
        self._inside += 1
        for statement in node.body[1:] if ast.get_docstring(node) else node.body:
            self.visit(statement)
        self._inside -= 1
        self._names.pop()

    visit_FunctionDef = visit_AsyncFunctionDef = _function  # noqa: N815

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self._names.append(node.name)
        for statement in node.body:
            self.visit(statement)
        self._names.pop()

    def visit_Assign(self, node: ast.Assign) -> None:
        """All but names for types, ``Facts = LineFacts | ArcFacts``."""
        if self._inside or not _is_type(node.value):
            self.generic_visit(node)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value:
            self.visit(node.value)

    def visit_Raise(self, node: ast.Raise) -> None:
        """Messages."""

    def visit_Assert(self, node: ast.Assert) -> None:
        """For readers."""

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        """Positions inside are not those of the file."""

    def visit_keyword(self, node: ast.keyword) -> None:
        if node.arg not in _SILENT_KEYWORDS:
            self.visit(node.value)

    # What is changed.

    def visit_Compare(self, node: ast.Compare) -> None:
        for left, operator, right in zip([node.left, *node.comparators], node.ops, node.comparators, strict=False):
            old, new = _COMPARED[type(operator)]
            self._between("compare", left, right, old, new)
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        old, new = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
        for left, right in zip(node.values, node.values[1:], strict=False):
            self._between("and-or", left, right, old, new)
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        start, end = self._span(node)
        inner = self._span(node.operand)[0]
        if not isinstance(node.op, ast.UAdd):
            dropped = {ast.Not: "drop-not", ast.Invert: "drop-not", ast.USub: "sign"}[type(node.op)]
            self._add(dropped, start, self.text[start:end], self.text[inner:end])
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        if type(node.op) in _CALCULATED:
            old, new = _CALCULATED[type(node.op)]
            self._between("operator", node.left, node.right, old, new)
        if isinstance(node.op, ast.Add | ast.Sub | ast.BitAnd | ast.BitOr):
            start, end = self._span(node)
            first = self._span(node.left)
            self._add("drop-term", start, self.text[start:end], self.text[first[0] : first[1]])
        self.generic_visit(node)

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        if type(node.op) in _CALCULATED and isinstance(node.target, ast.expr):
            old, new = _CALCULATED[type(node.op)]
            self._between("operator", node.target, node.value, f"{old}=", f"{new}=")
        self.visit(node.value)

    def visit_Constant(self, node: ast.Constant) -> None:
        start, end = self._span(node)
        value, old = node.value, self.text[start:end]
        if isinstance(value, bool):
            self._add("flag", start, old, str(not value))
        elif isinstance(value, int):
            self._add("constant", start, old, str(value + 1))
        elif isinstance(value, float):
            self._add("constant", start, old, repr(value * 2 if value else 1.0))

    def visit_Call(self, node: ast.Call) -> None:
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name in _WORDS or name.endswith("Error"):
            return
        if name in _SWAPPED:
            end = self._span(node.func)[1]
            self._add("swap", end - len(name), name, _SWAPPED[name])
        self.generic_visit(node)

    def visit_Return(self, node: ast.Return) -> None:
        if isinstance(node.value, ast.Tuple) and len(node.value.elts) == 1:
            start, end = self._span(node.value)
            self._add("empty", start, self.text[start:end], "()")
        self.generic_visit(node)

    def visit_If(self, node: ast.If) -> None:
        if isinstance(node.test, ast.Name | ast.Call | ast.Attribute):
            start, end = self._span(node.test)
            self._add("negate", start, self.text[start:end], f"not {self.text[start:end]}")
        self.generic_visit(node)


def _is_type(node: ast.expr) -> bool:
    """Whether an expression is a union of classes."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        return _is_type(node.left) and _is_type(node.right)
    return isinstance(node, ast.Name) and node.id[0].isupper() and not node.id.isupper()


def functions(text: str) -> Iterator[tuple[str, int, int]]:
    """Qualified name, first and last line of every function that lies in no other function."""

    def inside(body: Iterable[ast.stmt], names: tuple[str, ...]) -> Iterator[tuple[str, int, int]]:
        for node in body:
            if isinstance(node, ast.ClassDef):
                yield from inside(node.body, (*names, node.name))
            elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                first = min([node.lineno, *(part.lineno for part in node.decorator_list)])
                yield ".".join([*names, node.name]), first, node.end_lineno or 0

    yield from inside(ast.parse(text).body, ())


def _function_at(text: str, start: int) -> str:
    line = text.count("\n", 0, start) + 1
    return next((name for name, first, last in functions(text) if first <= line <= last), "")
