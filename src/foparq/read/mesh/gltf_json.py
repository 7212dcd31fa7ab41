# SPDX-License-Identifier: MIT
"""The JSON of a glTF file, asked value by value: what is not of the right kind is refused with its place."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NoReturn

from foparq.errors import UnreadableError, UnsafeError

_MOST_VALUES = 5_000_000  #: of the text: each takes some tens of bytes
_GREATEST = 2**53
_SHOWN = 60  #: letters of a value that a message repeats


@dataclass(frozen=True, slots=True)
class Part:
    """An object of the text, and where it stands there."""

    file: str
    path: str  #: ``"accessors[3]"``; ``""`` for the whole
    said: dict[str, Any]

    def where(self, key: str) -> str:
        """Place of one of its values."""
        return f"{self.path}.{key}" if self.path else key

    def wrong(self, key: str, example: object) -> UnreadableError:
        """Error that says what would be right there."""
        value = "-" if key not in self.said else json.dumps(self.said[key])[:_SHOWN]
        return UnreadableError("mesh.gltf-value", file=self.file, key=self.where(key), value=value, example=example)

    def whole(self, key: str, default: int | None = None) -> int:
        """Whole number, not negative."""
        value = self.said.get(key, default)
        if type(value) is not int or not 0 <= value < _GREATEST:
            raise self.wrong(key, 0)
        return value

    def reals(self, key: str, count: int) -> list[float] | None:
        """So many numbers; ``None`` if there is no such key."""
        value = self.said.get(key)
        if value is None:
            return None
        if not isinstance(value, list) or len(value) != count or not all(map(_is_number, value)):
            raise self.wrong(key, [0.0] * count)
        return [_as_real(number) for number in value]

    def text(self, key: str) -> str:
        """Text; ``""`` if there is no such key."""
        value = self.said.get(key, "")
        if not isinstance(value, str):
            raise self.wrong(key, '"..."')
        return value

    def has(self, key: str) -> bool:
        """Whether there is such a key."""
        return key in self.said

    def part(self, key: str) -> "Part":
        """Object; an empty one if there is no such key."""
        value = self.said.get(key, {})
        if not isinstance(value, dict):
            raise self.wrong(key, "{}")
        return Part(self.file, self.where(key), value)

    def list_of(self, key: str) -> list[Any]:
        """List; an empty one if there is no such key."""
        value = self.said.get(key, [])
        if not isinstance(value, list):
            raise self.wrong(key, "[]")
        return value

    def parts(self, key: str) -> Iterator["Part"]:
        """Objects of a list."""
        for number in range(len(self.list_of(key))):
            yield self.at(key, number)

    def at(self, key: str, number: int) -> "Part":
        """Object of a list, by its number."""
        values = self.list_of(key)
        if number >= len(values) or not isinstance(values[number], dict):
            place = Part(self.file, self.path, {f"{key}[{number}]": None})
            raise place.wrong(f"{key}[{number}]", "{}")
        return Part(self.file, f"{self.where(key)}[{number}]", values[number])

    def wholes(self, key: str) -> list[int]:
        """List of whole numbers, none negative."""
        values = self.list_of(key)
        if not all(type(value) is int and 0 <= value < _GREATEST for value in values):
            raise self.wrong(key, [0])
        return values


def parsed(text: bytes, file: str) -> Part:
    """The text as an object.

    Raises
    ------
    UnreadableError
        If it is no JSON, or no object, or nested too deep.
    UnsafeError
        If it holds more values than any mesh needs.
    """
    if text.count(b",") + text.count(b"[") + text.count(b"{") > _MOST_VALUES:
        raise UnsafeError("mesh.json-large", file=file, limit=_MOST_VALUES)
    try:
        found = json.loads(text.decode("utf-8-sig"), parse_constant=_no_constant)
    except RecursionError:
        raise UnreadableError("mesh.json-deep", file=file) from None
    except ValueError as error:
        raise UnreadableError("mesh.json", file=file, value=str(error)[:_SHOWN]) from None
    if not isinstance(found, dict):
        raise UnreadableError("mesh.json", file=file, value=json.dumps(found)[:_SHOWN])
    return Part(file, "", found)


def _no_constant(name: str) -> NoReturn:
    raise ValueError(name)


def _is_number(value: object) -> bool:
    return type(value) in (int, float)


def _as_real(value: float) -> float:
    try:
        return float(value)
    except OverflowError:  # a whole number of more digits than a float can be large
        return math.copysign(math.inf, value)
