# SPDX-License-Identifier: MIT
"""TOML with the line of every key, so that an error can say where."""

import hashlib
import re
import stat
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foparq.errors import UsageError
from foparq.profile.examples import EXAMPLES

_TABLE = re.compile(r"^\s*\[(?!\[)\s*(?P<path>[^\]]+?)\s*\]")
_ARRAY = re.compile(r"^\s*\[\[\s*(?P<path>[^\]]+?)\s*\]\]")
_KEY = re.compile(r"^\s*(?P<key>\"[^\"]*\"|'[^']*'|[A-Za-z0-9_.-]+)\s*=")
_PLACE = re.compile(r"\(at line (\d+), column (\d+)\)")

_NOT_TEXT = frozenset({"date", "counted"})  #: keys whose value is no text: quotes would not mend it
_SHOWN = 80  #: characters of a wrong line that a message repeats
_MOST_BYTES = 1_000_000
_DEEPEST = 32  #: tables and arrays within each other
#: so many parts of a dotted key that its cost, which grows with their square, could be felt
_CHAIN = re.compile(r"(?<![\w.\-])(?:(?:[\w\-]++|\"[^\"\n]*+\"|'[^'\n]*+')[ \t]*+\.[ \t]*+){" + str(_DEEPEST) + "}")
_LONG_NUMBER = re.compile(r"[0-9_]{1000}")

Place = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class TomlText:
    """A TOML file as data, with line numbers."""

    path: Path
    data: dict[str, Any]
    lines: dict[Place, int]
    sha256: str  #: of the bytes that the data were read from
    size: int  #: bytes

    def line(self, place: Sequence[str | int]) -> int:
        """Line of a key, or of the nearest table that holds it; 1-based."""
        known = tuple(place)
        while known and known not in self.lines:
            known = known[:-1]
        return self.lines.get(known, 1)


def read_toml(path: Path, kind: type[UsageError]) -> TomlText:
    """Read a TOML file.

    Parameters
    ----------
    kind : type of UsageError
        What to raise.

    Raises
    ------
    UsageError
        Of that kind: if the file cannot be read, is not UTF-8, or is not TOML.
    """
    try:
        raw = _bytes(path, kind)
        text = raw.decode("utf-8-sig")
    except OSError as error:
        raise kind("toml.unreadable", file=str(path), value=error.strerror or str(error)) from None
    except UnicodeDecodeError as error:
        raise kind("toml.not-utf8", file=str(path), value=error.start) from None
    if _CHAIN.search(text):
        raise kind("toml.too-deep", file=str(path), limit=_DEEPEST)
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise kind("toml.too-deep", file=str(path), limit=_DEEPEST) from None
    except tomllib.TOMLDecodeError as error:
        found = _PLACE.search(str(error))
        line = int(found[1]) if found else len(text.splitlines())
        shown = text.splitlines()[line - 1].strip() if 0 < line <= len(text.splitlines()) else ""
        if (key := _KEY.match(shown)) and not shown.partition("=")[2].split("#")[0].strip():
            raise kind("toml.no-value", file=str(path), line=line, key=key["key"][:_SHOWN]) from None
        raise kind("toml.syntax", file=str(path), line=line, value=shown[:_SHOWN], example=_quoted(shown)) from None
    except ValueError:
        # Python turns no text of thousands of digits into a number.
        long = _LONG_NUMBER.search(text)
        line = text.count("\n", 0, long.start()) + 1 if long else 1
        raise kind("toml.long-number", file=str(path), line=line) from None
    if _depth(data) > _DEEPEST:
        raise kind("toml.too-deep", file=str(path), limit=_DEEPEST)
    return TomlText(path, data, _index(text), hashlib.sha256(raw).hexdigest(), len(raw))


def _bytes(path: Path, kind: type[UsageError]) -> bytes:
    # A pipe would never end.
    found = path.stat()
    if not stat.S_ISREG(found.st_mode):
        raise kind("toml.not-a-file", file=str(path))
    if found.st_size > _MOST_BYTES:
        raise kind("toml.too-large", file=str(path), value=found.st_size, limit=_MOST_BYTES)
    return path.read_bytes()


def _depth(data: object) -> int:
    """Greatest number of tables and arrays within each other."""
    depth, level = 0, [data]
    while level:
        depth += 1
        held: list[object] = []
        for part in level:
            held += part.values() if isinstance(part, dict) else part if isinstance(part, list) else ()
        level = held
    return depth


def _quoted(line: str) -> str:
    """The line as it would be right, if all it lacks is quotes; else any right line."""
    key, equals, value = line.partition("=")
    if key.strip() in _NOT_TEXT:
        return EXAMPLES[key.strip()]
    value = value.split("#")[0].strip().strip("\"'“”").replace("\\", "/")
    plain = _KEY.match(line) is not None and value and not value.startswith(("[", "{"))
    return f'{key.strip()} = "{value[:_SHOWN]}"' if equals and plain else 'unit = "m"'


def _index(text: str) -> dict[Place, int]:
    """Lines of tables and keys; written for messages, so a rare form may be missing."""
    lines: dict[Place, int] = {}
    counts: dict[str, int] = {}
    table: Place = ()
    for number, line in enumerate(text.splitlines(), start=1):
        if found := _ARRAY.match(line):
            name = found["path"]
            counts[name] = counts.get(name, -1) + 1
            table = (*_parts(name), counts[name])
            lines[table] = number
        elif found := _TABLE.match(line):
            table = _parts(found["path"])
            lines[table] = number
        elif found := _KEY.match(line):
            lines.setdefault((*table, *_parts(found["key"])), number)
    return lines


def _parts(path: str) -> tuple[str, ...]:
    if path[:1] in "\"'":
        return (path[1:-1],)
    return tuple(part.strip().strip("\"'") for part in path.split("."))
