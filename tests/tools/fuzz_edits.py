# SPDX-License-Identifier: MIT
"""Mild changes of delivered files: what editors, converters, cables and hands do to them."""

import contextlib
import json
import math
import re
import sqlite3
import struct
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from tests.tools.fuzz_seeds import Seed

Rng = np.random.Generator
Files = dict[str, bytes]
Pair = tuple[int, str]
Edit = Callable[[Any, Rng], Any]
T = TypeVar("T")

#: what stands where a number is due
NUMBERS = (
    "nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "-0.0", "0", "-1", "1e16", "", " ", "1,5", "1.5.2", "+", "0x10",
    "9" * 40, "1e400", "१", "2147483648", "-9223372036854775809",
)  # fmt: skip
NAMES = (
    "", " ", "0", "*", "PAREDE", "RELÓGIO", "RELÃ“GIO", "JANELA", "a" * 300, "<b>&amp;", "={}", "../x", "\\U+00C1",
    "%%c", "{title}", "\u202eabc", "😀", "paredes", "__proto__", "TEXTO|A",
)  # fmt: skip
DOUBLES = (math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, -0.0, 0.0, 1e16, -1.0, 0.5)
ENCODINGS = ("cp1252", "utf-8", "utf-16", "utf-8-sig", "cp437", "utf-32", "utf-7")


def pick(rng: Rng, things: Sequence[T]) -> T:
    """One of some things."""
    return things[int(rng.integers(len(things)))]


def chance(rng: Rng, share: float) -> bool:
    """True in a share of the calls."""
    return bool(rng.random() < share)


# --- bytes and text ---------------------------------------------------------------------------------------------------


def cut_tail(data: bytes, rng: Rng) -> bytes:
    """A file that ends too early, mostly by little."""
    return data[: len(data) - int(len(data) * rng.random() ** 4) - 1]


def change_byte(data: bytes, rng: Rng) -> bytes:
    """One byte of another value."""
    at = int(rng.integers(len(data))) if data else 0
    return data[:at] + bytes([int(rng.integers(256))]) + data[at + 1 :]


def flip_bit(data: bytes, rng: Rng) -> bytes:
    """One bit of another value."""
    if not data:
        return data
    at = int(rng.integers(len(data)))
    return data[:at] + bytes([data[at] ^ (1 << int(rng.integers(8)))]) + data[at + 1 :]


def drop_bytes(data: bytes, rng: Rng) -> bytes:
    """Some bytes lost."""
    at = int(rng.integers(len(data) + 1))
    return data[:at] + data[at + int(rng.integers(1, 9)) :]


def repeat_bytes(data: bytes, rng: Rng) -> bytes:
    """Some bytes twice."""
    at, size = int(rng.integers(len(data) + 1)), int(rng.integers(1, 65))
    return data[: at + size] + data[at:]


def put_double(data: bytes, rng: Rng) -> bytes:
    """An odd number over eight bytes."""
    at = 4 * int(rng.integers(len(data) // 4 + 1))
    return data[:at] + struct.pack("<d", pick(rng, DOUBLES)) + data[at + 8 :]


def swap_doubles(data: bytes, rng: Rng) -> bytes:
    """Two neighbouring numbers exchanged."""
    at = 4 * int(rng.integers(len(data) // 4 + 1))
    return data[:at] + data[at + 8 : at + 16] + data[at : at + 8] + data[at + 16 :]


def change_digit(data: bytes, rng: Rng) -> bytes:
    """One digit of another value."""
    places = [found.start() for found in re.finditer(rb"[0-9]", data)]
    if not places:
        return data
    at = pick(rng, places)
    return data[:at] + str(int(rng.integers(10))).encode() + data[at + 1 :]


def change_number(data: bytes, rng: Rng) -> bytes:
    """Something odd for a number."""
    places = [found.span() for found in re.finditer(rb"-?[0-9]+(?:\.[0-9]+)?", data)]
    if not places:
        return data
    start, end = pick(rng, places)
    return data[:start] + pick(rng, NUMBERS).encode() + data[end:]


def swap_numbers(data: bytes, rng: Rng) -> bytes:
    """Two neighbouring numbers exchanged."""
    places = [found.span() for found in re.finditer(rb"-?[0-9]+(?:\.[0-9]+)?", data)]
    if len(places) < 2:
        return data
    n = int(rng.integers(len(places) - 1))
    (a, b), (c, d) = places[n], places[n + 1]
    return data[:a] + data[c:d] + data[b:c] + data[a:b] + data[d:]


def exchange_encoding(data: bytes, rng: Rng) -> bytes:
    """The same text in another encoding."""
    return data.decode("utf-8", "replace").encode(pick(rng, ENCODINGS), "replace")


def change_line(data: bytes, rng: Rng) -> bytes:
    """A line dropped, repeated, moved or emptied."""
    lines = data.split(b"\n")
    at, to = int(rng.integers(len(lines))), int(rng.integers(len(lines)))
    how = pick(rng, ("drop", "repeat", "move", "empty"))
    line = lines[at]
    if how == "empty":
        lines[at] = b""
    elif how != "repeat":
        del lines[at]
    if how in {"repeat", "move"}:
        lines.insert(to, line)
    return b"\n".join(lines)


BYTES: tuple[Edit, ...] = (change_byte, flip_bit, drop_bytes, repeat_bytes, put_double, swap_doubles, cut_tail)

# --- DXF: pairs of group code and value -------------------------------------------------------------------------------


def pairs_of(data: bytes) -> list[Pair]:
    """Pairs of a text that a library wrote."""
    lines = data.decode("utf-8", "surrogateescape").split("\n")
    return [(int(code), value) for code, value in zip(lines[::2], lines[1::2], strict=False)]


def text_of(pairs: Sequence[Pair]) -> bytes:
    """Text form of pairs."""
    return "".join(f"{code:>3}\n{value}\n" for code, value in pairs).encode("utf-8", "surrogateescape")


def _whole(value: str, bits: int) -> int:
    try:
        number = int(float(value))
    except (ValueError, OverflowError):
        return 0
    return (number + (1 << (bits - 1))) % (1 << bits) - (1 << (bits - 1))


def _real(value: str) -> float:
    try:
        return float(value)
    except ValueError:
        return math.nan


_CHUNKS = frozenset({1004, *range(310, 320)})
_BITS = (
    (16, (range(60, 80), range(170, 180), range(270, 290), range(370, 390), range(400, 410), range(1060, 1071))),
    (32, (range(90, 100), range(420, 430), range(440, 460), range(1071, 1072))),
    (64, (range(160, 170),)),
    (8, (range(290, 300),)),
)
_REALS = (range(10, 60), range(110, 150), range(210, 240), range(460, 470), range(1010, 1060))


def binary_of(pairs: Sequence[Pair]) -> bytes:
    """Binary form of pairs, after the DXF reference: two bytes of group code, then the value."""
    out = [b"AutoCAD Binary DXF\r\n\x1a\x00"]
    formats = {8: "<b", 16: "<h", 32: "<i", 64: "<q"}
    for code, value in pairs:
        out.append(struct.pack("<H", code % 65536))
        bits = next((bits for bits, ranges in _BITS if any(code in some for some in ranges)), 0)
        if any(code in some for some in _REALS):
            out.append(struct.pack("<d", _real(value)))
        elif bits:
            out.append(struct.pack(formats[bits], _whole(value, bits)))
        elif code in _CHUNKS:
            chunk = bytes.fromhex(value) if re.fullmatch(r"(?:[0-9A-Fa-f]{2})*", value) else b""
            out.append(bytes([len(chunk) % 256]) + chunk[:255])
        else:
            out.append(value.encode("utf-8", "surrogateescape").replace(b"\0", b"") + b"\0")
    return b"".join(out)


def _section(pairs: Sequence[Pair], name: str) -> range:
    """Numbers of the pairs of a section."""
    start = next((n for n, pair in enumerate(pairs) if pair == (2, name) and pairs[n - 1] == (0, "SECTION")), None)
    if start is None:
        return range(len(pairs))
    end = next((n for n in range(start, len(pairs)) if pairs[n] == (0, "ENDSEC")), len(pairs))
    return range(start + 1, max(end, start + 2))


def _place(pairs: Sequence[Pair], rng: Rng, codes: Callable[[int], bool] = lambda _: True) -> int | None:
    """A pair, mostly of an entity, whose code fits."""
    name = pick(rng, ("ENTITIES",) * 7 + ("BLOCKS", "BLOCKS", "TABLES", "HEADER"))
    if name == "BLOCKS" and len(_section(pairs, name)) < 200:
        name = "ENTITIES"  # blocks of layouts only
    found = [n for n in _section(pairs, name) if n < len(pairs) and codes(pairs[n][0])]
    return pick(rng, found) if found else None


def _numeric(code: int) -> bool:
    return 10 <= code < 80 or 90 <= code < 100 or 210 <= code < 240


def _coordinate(code: int) -> bool:
    return 10 <= code < 40 or 210 <= code < 240


def _entity(pairs: Sequence[Pair], rng: Rng) -> range:
    """Numbers of the pairs of one entity."""
    start = _place(pairs, rng, lambda code: code == 0)
    if start is None:
        return range(0)
    end = next((n for n in range(start + 1, len(pairs)) if pairs[n][0] == 0), len(pairs))
    return range(start, end)


def _with(pairs: Sequence[Pair], at: int | None, *new: Pair, drop: int = 1) -> list[Pair]:
    return list(pairs) if at is None else [*pairs[:at], *new, *pairs[at + drop :]]


def pair_number(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Something odd for a number."""
    at = _place(pairs, rng, _numeric)
    return _with(pairs, at, (pairs[at or 0][0], pick(rng, NUMBERS)))


def pair_digit(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """One digit of a number."""
    at = _place(pairs, rng, _numeric)
    code, value = pairs[at or 0]
    return _with(pairs, at, (code, change_digit(value.encode("utf-8", "replace"), rng).decode("utf-8", "replace")))


def pair_nudge(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """A coordinate moved by little, or to its opposite."""
    at = _place(pairs, rng, _coordinate)
    code, value = pairs[at or 0]
    moved = _real(value) * pick(rng, (1.0, -1.0)) + pick(rng, (0.0, 1e-9, 1e-4, 0.003, 0.01, 0.5))
    return _with(pairs, at, (code, repr(moved)))


def pair_swap(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Two values exchanged."""
    one, other = _place(pairs, rng, _coordinate), _place(pairs, rng, _coordinate)
    if one is None or other is None:
        return pairs
    out = list(pairs)
    out[one], out[other] = (pairs[one][0], pairs[other][1]), (pairs[other][0], pairs[one][1])
    return out


def pair_drop(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """One pair lost."""
    return _with(pairs, _place(pairs, rng))


def pair_repeat(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """One pair twice."""
    at = _place(pairs, rng)
    return _with(pairs, at, pairs[at or 0], pairs[at or 0])


def pair_code(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Another group code."""
    at = _place(pairs, rng, lambda code: code != 0)
    code, value = pairs[at or 0]
    return _with(pairs, at, (max(0, code + pick(rng, (1, -1, 10, -10, 30, 1000))), value))


def pair_flag(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Another whole number, for flags and counts."""
    at = _place(pairs, rng, lambda code: 60 <= code < 80 or 90 <= code < 100)
    return _with(pairs, at, (pairs[at or 0][0], str(pick(rng, (0, 1, 2, 4, 8, 16, 33, 64, 127, 255, -1, 999, 70000)))))


def pair_layer(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Another layer, or a name that no program allows."""
    at = _place(pairs, rng, lambda code: code in {2, 6, 7, 8})
    return _with(pairs, at, (pairs[at or 0][0], pick(rng, NAMES)))


def pair_text(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Something odd for a text."""
    at = _place(pairs, rng, lambda code: code in {1, 2, 3, 8})
    return _with(pairs, at, (pairs[at or 0][0], pick(rng, NAMES)))


def pair_handle(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """A handle used twice, or none."""
    at, other = (_place(pairs, rng, lambda code: code in {5, 330}) for _ in range(2))
    value = pick(rng, ("0", "FFFFFFFFFFFFFFFFFF", "XYZ", "", pairs[other or 0][1]))
    return _with(pairs, at, (pairs[at or 0][0], value))


def pair_height(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """A height, an elevation or a direction of extrusion where there was none."""
    at = _place(pairs, rng, _coordinate)
    if at is None:
        return pairs
    direction = pick(rng, ((0, 0, -1), (0, -1, 0), (0, 0, 0), (1, 1, 1), (math.nan, 0, 1), (1e-200, 0, 0)))
    turned = [(210 + 10 * n, repr(float(part))) for n, part in enumerate(direction)]
    new = pick(rng, ([(38, "2.5")], [(30, "1.0")], [(39, "0.5")], turned))
    return [*pairs[: at + 2], *new, *pairs[at + 2 :]]


def vertex(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """A vertex lost, or twice."""
    at = _place(pairs, rng, lambda code: code in {10, 11})
    return _with(pairs, at, *pairs[at or 0 : (at or 0) + 2] * pick(rng, (0, 2, 3)), drop=2)


def entity_drop(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """An entity lost."""
    span = _entity(pairs, rng)
    return [*pairs[: span.start], *pairs[span.stop :]] if span else pairs


def entity_repeat(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """An entity twice, handle and all."""
    span = _entity(pairs, rng)
    return [*pairs[: span.stop], *pairs[span.start : span.stop], *pairs[span.stop :]] if span else pairs


def entity_move(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """An entity elsewhere in the file."""
    span = _entity(pairs, rng)
    rest = [*pairs[: span.start], *pairs[span.stop :]]
    at = _place(rest, rng, lambda code: code == 0)
    return pairs if at is None else [*rest[:at], *pairs[span.start : span.stop], *rest[at:]]


def entity_kind(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """An entity that says to be of another type."""
    at = _place(pairs, rng, lambda code: code == 0)
    kinds = "LINE ARC CIRCLE POINT TEXT LWPOLYLINE SPLINE ELLIPSE HATCH INSERT SOLID 3DFACE VERTEX SEQEND POLYLINE MESH"
    return _with(pairs, at, (0, pick(rng, (*kinds.split(), "MLINE", "REGION", "DIMENSION", "ATTRIB", "XYZ", ""))))


def insert(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """An insert of another block, scale, angle or number."""
    starts = [n for n, pair in enumerate(pairs) if pair == (0, "INSERT")]
    if not starts:
        return entity_repeat(pairs, rng)
    at = pick(rng, starts)
    name = next((n for n in range(at, len(pairs)) if pairs[n][0] == 2), at)
    code = pick(rng, (2, 2, 41, 42, 43, 44, 45, 50, 70, 71))
    if code == 2:
        return _with(pairs, name, (2, pick(rng, ("PORTA", "PAR", "NADA", "*Model_Space", "*Paper_Space", "*U1", ""))))
    value = pick(rng, NUMBERS) if chance(rng, 0.4) else pick(rng, ("0", "-2", "1", "1000", "1e-9", "0.5", "300"))
    return [*pairs[: name + 1], (code, value), *pairs[name + 1 :]]


def header(pairs: list[Pair], rng: Rng) -> list[Pair]:
    """Another unit, version, code page or extent in the header."""
    names = ("$INSUNITS", "$INSUNITS", "$MEASUREMENT", "$ACADVER", "$DWGCODEPAGE", "$EXTMIN", "$HANDSEED", "$LUNITS")
    name = pick(rng, names)
    at = next((n for n, pair in enumerate(pairs) if pair == (9, name)), None)
    values = {
        "$ACADVER": ("AC1009", "AC1015", "AC1021", "AC1032", "AC1006", "AC9999", ""),
        "$DWGCODEPAGE": ("ANSI_1252", "UTF-8", "ANSI_936", "DOS850", "NONE", ""),
    }.get(name, ("0", "1", "2", "4", "5", "6", "13", "99", "-1", "x"))
    if at is None:
        start = _section(pairs, "HEADER").start
        return [*pairs[:start], (9, name), (70, pick(rng, values)), *pairs[start:]]
    return _with(pairs, at + 1, (pairs[min(at + 1, len(pairs) - 1)][0], pick(rng, values)))


PAIRS: tuple[Edit, ...] = (
    pair_number, pair_digit, pair_digit, pair_nudge, pair_nudge, pair_nudge, pair_swap, pair_swap, pair_drop,
    pair_repeat, pair_code, pair_flag, pair_layer, pair_text, pair_handle, pair_height, vertex, vertex, entity_drop,
    entity_repeat, entity_move, entity_kind, insert, header,
)  # fmt: skip
TEXT: tuple[Edit, ...] = (change_byte, change_digit, change_line, exchange_encoding, cut_tail, drop_bytes)

# --- GeoPackage -------------------------------------------------------------------------------------------------------


def _rows(base: sqlite3.Connection, query: str) -> list[tuple[Any, ...]]:
    return base.execute(query).fetchall()


def _table(base: sqlite3.Connection, rng: Rng) -> str:
    return str(pick(rng, [name for (name,) in _rows(base, "SELECT table_name FROM gpkg_contents")] or ["paredes"]))


def _row(base: sqlite3.Connection, rng: Rng) -> tuple[str, int, bytes]:
    table = _table(base, rng)
    fid, blob = pick(rng, _rows(base, f'SELECT fid, geom FROM "{table}"'))  # noqa: S608
    return table, fid, blob if isinstance(blob, bytes) else b""


def blob(base: sqlite3.Connection, rng: Rng) -> None:
    """A geometry whose bytes changed."""
    table, fid, data = _row(base, rng)
    # The header and the first counts are a small part: chosen more often than by chance.
    size = len(data) if chance(rng, 0.6) else min(len(data), 60)
    changed = pick(rng, BYTES)(data[:size], rng) + data[size:]
    base.execute(f'UPDATE "{table}" SET geom = ? WHERE fid = ?', (changed, fid))  # noqa: S608


def blob_double(base: sqlite3.Connection, rng: Rng) -> None:
    """A coordinate that is no place."""
    table, fid, data = _row(base, rng)
    envelope = (0, 32, 48, 48, 64)[min(4, (data[3] >> 1) & 7)] if len(data) > 3 else 0
    start = 8 + envelope + 9
    at = start + 8 * int(rng.integers(max(1, (len(data) - start) // 8)))
    changed = data[:at] + struct.pack("<d", pick(rng, DOUBLES)) + data[at + 8 :]
    base.execute(f'UPDATE "{table}" SET geom = ? WHERE fid = ?', (changed[: len(data)], fid))  # noqa: S608


def blob_kind(base: sqlite3.Connection, rng: Rng) -> None:
    """A geometry of another type, empty, or with heights and measures that are not there."""
    table, fid, data = _row(base, rng)
    envelope = (0, 32, 48, 48, 64)[min(4, (data[3] >> 1) & 7)] if len(data) > 3 else 0
    at = 8 + envelope + 1
    kind = pick(rng, (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 16, 17, 1002, 1003, 2002, 3002, 999, 0x80000002))
    changed = data[:at] + struct.pack("<I", kind) + (struct.pack("<I", 0) if chance(rng, 0.3) else data[at + 4 :])
    base.execute(f'UPDATE "{table}" SET geom = ? WHERE fid = ?', (changed, fid))  # noqa: S608


def geometry_value(base: sqlite3.Connection, rng: Rng) -> None:
    """No geometry, or something else in its place."""
    table, fid, _ = _row(base, rng)
    other = _row(base, rng)[2]
    value = pick(rng, (None, b"", b"GP", "LINESTRING (0 0, 1 0)", 7, 1.5, other, other))
    base.execute(f'UPDATE "{table}" SET geom = ? WHERE fid = ?', (value, fid))  # noqa: S608


def row(base: sqlite3.Connection, rng: Rng) -> None:
    """A row lost, twice, or of another id."""
    table, fid, _ = _row(base, rng)
    how = pick(rng, ("drop", "repeat", "repeat", "renumber", "all"))
    if how == "drop":
        base.execute(f'DELETE FROM "{table}" WHERE fid = ?', (fid,))  # noqa: S608
    elif how == "all":
        base.execute(f'DELETE FROM "{table}"')  # noqa: S608
    elif how == "renumber":
        number = pick(rng, (-1, 0, 2**31, 2**63 - 1, -(2**63), 1_000))
        base.execute(f'UPDATE "{table}" SET fid = ? WHERE fid = ?', (number, fid))  # noqa: S608
    else:
        columns = [str(column[1]) for column in _rows(base, f'PRAGMA table_info("{table}")') if column[1] != "fid"]
        names = ", ".join(f'"{name}"' for name in columns)
        copy = f'INSERT INTO "{table}" ({names}) SELECT {names} FROM "{table}" WHERE fid = ?'  # noqa: S608
        base.execute(copy, (fid,))


def cell(base: sqlite3.Connection, rng: Rng) -> None:
    """Something odd in a column of attributes."""
    table, fid, _ = _row(base, rng)
    value = pick(rng, (None, b"\xff\xfe", 7, 1e308, -0.0, *NAMES))
    base.execute(f'UPDATE "{table}" SET "{pick(rng, ("layer", "cota"))}" = ? WHERE fid = ?', (value, fid))  # noqa: S608


_REGISTER = (
    ("gpkg_contents", "table_name"), ("gpkg_contents", "data_type"), ("gpkg_contents", "srs_id"),
    ("gpkg_contents", "min_x"), ("gpkg_contents", "last_change"), ("gpkg_geometry_columns", "table_name"),
    ("gpkg_geometry_columns", "column_name"), ("gpkg_geometry_columns", "geometry_type_name"),
    ("gpkg_geometry_columns", "geometry_type_name"), ("gpkg_geometry_columns", "srs_id"),
    ("gpkg_geometry_columns", "z"), ("gpkg_geometry_columns", "m"), ("gpkg_spatial_ref_sys", "srs_id"),
    ("gpkg_spatial_ref_sys", "definition"), ("gpkg_spatial_ref_sys", "organization"),
    ("gpkg_spatial_ref_sys", "organization_coordsys_id"), ("gpkg_ogr_contents", "feature_count"),
)  # fmt: skip
_WORDS = (
    None, "", "features", "attributes", "tiles", "paredes", "PISOS", "geom", "fid", "POINT", "CURVEPOLYGON", "GEOMETRY",
    "linestring", "COMPOUNDCURVE", "MULTIPOLYGON", "EPSG", "NONE", 'GEOGCS["x"]', -1, 0, 1, 2, 4326, 31982, 99999,
    1e308, b"\xff", "2014",
)  # fmt: skip


def register(base: sqlite3.Connection, rng: Rng) -> None:
    """Another statement in the register of layers, geometries and reference systems."""
    table, column = pick(rng, _REGISTER)
    (number,) = pick(rng, _rows(base, f"SELECT rowid FROM {table}"))  # noqa: S608
    if chance(rng, 0.15):
        base.execute(f"DELETE FROM {table} WHERE rowid = ?", (number,))  # noqa: S608
    else:
        base.execute(f"UPDATE {table} SET {column} = ? WHERE rowid = ?", (pick(rng, _WORDS), number))  # noqa: S608


def schema(base: sqlite3.Connection, rng: Rng) -> None:
    """A table, column, view or trigger more or less."""
    table = _table(base, rng)
    base.execute(
        pick(
            rng,
            (
                f'ALTER TABLE "{table}" RENAME TO "outra"',
                f'ALTER TABLE "{table}" ADD COLUMN "camada" TEXT',
                f'ALTER TABLE "{table}" DROP COLUMN "layer"',
                f'ALTER TABLE "{table}" RENAME COLUMN "geom" TO "forma"',
                f'ALTER TABLE "{table}" RENAME COLUMN "cota" TO "PaperSpace"',
                f'CREATE VIEW "vista" AS SELECT * FROM "{table}"',  # noqa: S608
                f'CREATE TRIGGER "t" AFTER UPDATE ON "{table}" BEGIN DELETE FROM "{table}"; END',  # noqa: S608
                f'DROP TABLE "{table}"',
                "DROP TABLE gpkg_geometry_columns",
                "DROP TABLE IF EXISTS gpkg_extensions",
                "DROP TABLE IF EXISTS gpkg_ogr_contents",
                "PRAGMA application_id = 0",
                "PRAGMA user_version = 99999",
                "PRAGMA encoding = 'UTF-16'",
            ),
        )
    )


ROWS: tuple[Edit, ...] = (
    blob, blob, blob_double, blob_double, blob_kind, blob_kind, geometry_value, row, cell, register, register, schema
)  # fmt: skip


def database(data: bytes, rng: Rng, edits: Sequence[Edit]) -> bytes:
    """A GeoPackage after some statements; those that SQLite refuses change nothing."""
    base = sqlite3.connect(":memory:", isolation_level=None)
    try:
        base.deserialize(data)
        base.execute("PRAGMA foreign_keys = OFF")
        for (name,) in _rows(base, "SELECT name FROM sqlite_master WHERE type = 'trigger'"):
            base.execute(f'DROP TRIGGER "{name}"')
        for edit in edits:
            with contextlib.suppress(sqlite3.Error, IndexError, ValueError):
                edit(base, rng)
        return base.serialize()
    finally:
        base.close()


# --- GeoJSON ----------------------------------------------------------------------------------------------------------


def _nodes(tree: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of all values within a tree."""
    children = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    return [found for key, child in children for found in [(*path, key), *_nodes(child, (*path, key))]]


def _holder(tree: Any, path: tuple[Any, ...]) -> Any:
    for key in path[:-1]:
        tree = tree[key]
    return tree


_TYPES = "Point LineString Polygon MultiPoint MultiLineString MultiPolygon GeometryCollection Feature CircularString"


def tree_value(tree: Any, rng: Rng) -> None:
    """Another value somewhere, of any type."""
    path = pick(rng, _nodes(tree))
    deep: Any = []
    for _ in range(int(rng.integers(1, 200))):
        deep = [deep]
    values = (None, True, "", "x", [], {}, [[]], -1, 1e308, math.nan, math.inf, -0.0, 10**30, deep, *NAMES)
    _holder(tree, path)[path[-1]] = pick(rng, values)


def tree_type(tree: Any, rng: Rng) -> None:
    """Another type of geometry."""
    path = pick(rng, [path for path in _nodes(tree) if path[-1] == "type"] or [("type",)])
    _holder(tree, path)["type"] = pick(rng, (*_TYPES.split(), "linestring", None, 2))


def tree_place(tree: Any, rng: Rng) -> None:
    """A coordinate moved, dropped, or one more."""
    paths = [path for path in _nodes(tree) if "coordinates" in path[:-1] and not isinstance(_at(tree, path), list)]
    if not paths:
        return
    path = pick(rng, paths)
    place = _holder(tree, path)
    how = pick(rng, ("odd", "nudge", "nudge", "drop", "more"))
    if how == "odd":
        place[path[-1]] = pick(rng, DOUBLES)
    elif how == "nudge" and isinstance(place[path[-1]], int | float):
        place[path[-1]] += pick(rng, (1e-9, 1e-4, 0.003, 0.01, 0.5, 1.0))
    elif how == "drop" and isinstance(place, list):
        del place[path[-1]]
    elif isinstance(place, list):
        place.append(pick(rng, (0.0, 1.0, 2.5, None)))


def _at(tree: Any, path: tuple[Any, ...]) -> Any:
    return _holder(tree, path)[path[-1]]


def tree_member(tree: Any, rng: Rng) -> None:
    """A member lost, or twice: vertices, rings, features, properties."""
    path = pick(rng, _nodes(tree))
    holder = _holder(tree, path)
    if isinstance(holder, list) and chance(rng, 0.5):
        holder.insert(int(rng.integers(len(holder) + 1)), holder[path[-1]])
    else:
        del holder[path[-1]]


def tree_swap(tree: Any, rng: Rng) -> None:
    """Two values exchanged."""
    paths = _nodes(tree)
    one, other = pick(rng, paths), pick(rng, paths)
    if one[: len(other)] == other or other[: len(one)] == one:
        return
    here, there = _at(tree, one), _at(tree, other)
    _holder(tree, one)[one[-1]], _holder(tree, other)[other[-1]] = there, here


def repeat_key(data: bytes, rng: Rng) -> bytes:
    """A key of an object twice."""
    places = list(re.finditer(rb'"(?:type|layer|coordinates|crs|features|geometry)":', data))
    if not places:
        return data
    found = pick(rng, places)
    value = pick(rng, (b"null", b'"x"', b"[]", b"{}", b'"Point"', b"[[0,0],[1,1]]"))
    return data[: found.start()] + found[0] + value + b", " + data[found.start() :]


TREE: tuple[Edit, ...] = (tree_value, tree_type, tree_place, tree_place, tree_place, tree_member, tree_swap)


def json_tree(data: bytes, rng: Rng, edits: Sequence[Edit]) -> bytes:
    """GeoJSON after changes of its tree."""
    tree = json.loads(data)
    for edit in edits:
        with contextlib.suppress(IndexError, TypeError, KeyError, ValueError):
            edit(tree, rng)
    return json.dumps(tree, ensure_ascii=False).encode("utf-8", "replace")


# --- tables and TOML --------------------------------------------------------------------------------------------------


def table_cell(data: bytes, rng: Rng) -> bytes:
    """Something odd in a cell."""
    lines = data.split(b"\n")
    at = int(rng.integers(len(lines)))
    cells = lines[at].split(b",")
    value = pick(rng, (*NUMBERS, *NAMES, '"', '""', "1.234,5", "-3", "1e3", "12.34567890123", "required", "OCCL"))
    cells[int(rng.integers(len(cells)))] = value.encode()
    lines[at] = b",".join(cells)
    return b"\n".join(lines)


def table_column(data: bytes, rng: Rng) -> bytes:
    """A column lost, twice, or two exchanged."""
    rows = [line.split(b",") for line in data.split(b"\n")]
    width = len(rows[0])
    one, other = int(rng.integers(width)), int(rng.integers(width))
    how = pick(rng, ("drop", "repeat", "swap"))
    for cells in (cells for cells in rows if len(cells) == width):
        if how == "swap":
            cells[one], cells[other] = cells[other], cells[one]
        elif how == "repeat":
            cells.insert(other, cells[one])
        else:
            del cells[one]
    return b"\n".join(b",".join(cells) for cells in rows)


def table_signs(data: bytes, rng: Rng) -> bytes:
    """Another separator, decimal sign or ending of lines."""
    old, new = pick(
        rng, ((b",", b";"), (b",", b"\t"), (b".", b","), (b"\n", b"\r\n"), (b"\n", b"\r"), (b"\n", b"\n\n"))
    )
    return data.replace(old, new)


TABLE: tuple[Edit, ...] = (
    change_digit, change_digit, change_number, swap_numbers, table_cell, table_cell, table_column, table_signs,
    change_line, change_line, exchange_encoding, change_byte, cut_tail,
)  # fmt: skip


_VALUES = (
    '"2 mm"', '"0.5 mm @ scale"', '"10 %"', '"0 %"', '"-1 mm"', '"1e308 m"', '"nan mm"', '"1:0"', '"1:1e9"', '"1:20"',
    "0", "-1", "1e999", "nan", "true", "false", '""', "[]", "{}", '["*"]', '["PAREDE*"]', '"xz"', '"fit"', '"cm"',
    '"m"', '"us-ft"', '"pt-BR"', '"en"', '"note"', '"critical"', '"duplicate"', '"a.dxf"', '"pontos.csv"',
    '"et-doc-foparq-b"', '"explode"', '"skip"', '"check"', "[[0,0,0],[1,0,0],[0,0,1]]", "1979-05-27", '"a\\u0000b"',
    "[" * 300, '"<&>"', "5", "3",
)  # fmt: skip


def toml_value(data: bytes, rng: Rng) -> bytes:
    """Another value of a key."""
    places = list(re.finditer(rb"(?m)^([^#\n=\[]+=)([^#\n]+)", data))
    if not places:
        return data
    found = pick(rng, places)
    return data[: found.end(1)] + b" " + pick(rng, _VALUES).encode() + data[found.end() :]


def toml_swap(data: bytes, rng: Rng) -> bytes:
    """The values of two keys exchanged."""
    places = list(re.finditer(rb"(?m)^[^#\n=\[]+=([^#\n]+)", data))
    if len(places) < 2:
        return data
    one, other = sorted((pick(rng, places), pick(rng, places)), key=lambda found: found.start())
    if one.start() == other.start():
        return data
    middle = data[one.end(1) : other.start(1)]
    return data[: one.start(1)] + other[1] + middle + one[1] + data[other.end(1) :]


def toml_quantity(data: bytes, rng: Rng) -> bytes:
    """A quantity of another size."""
    places = list(re.finditer(rb'"([0-9.]+) (mm2|mm|%|m|cm)', data))
    if not places:
        return data
    found = pick(rng, places)
    number = pick(rng, ("0", "0.001", "0.5", "3", "100", "1000", "1e-12", "1e9", "-2", "nan", "33.3"))
    return data[: found.start(1)] + number.encode() + data[found.end(1) :]


TOML: tuple[Edit, ...] = (
    toml_value, toml_value, toml_swap, toml_quantity, toml_quantity, toml_quantity, change_digit, change_number,
    change_line, change_line, change_byte, exchange_encoding, cut_tail,
)  # fmt: skip


# --- whole inputs -----------------------------------------------------------------------------------------------------


def _chosen(rng: Rng, edits: Sequence[Edit]) -> list[Edit]:
    return [pick(rng, edits) for _ in range(pick(rng, (1, 1, 1, 2, 2, 3)))]


def _dxf(seed: Seed, rng: Rng, binary: bool) -> tuple[Files, list[Edit]]:  # noqa: FBT001
    data = seed.files[seed.main]
    edits = _chosen(rng, PAIRS)
    pairs = pairs_of(data)
    for edit in edits:
        pairs = edit(pairs, rng)
    data = binary_of(pairs) if binary else text_of(pairs)
    if chance(rng, 0.15):
        last = pick(rng, BYTES if binary else TEXT)
        edits, data = [*edits, last], last(data, rng)
    return {**seed.files, seed.main: data}, edits


def _gpkg(seed: Seed, rng: Rng) -> tuple[Files, list[Edit]]:
    data = seed.files[seed.main]
    if chance(rng, 0.15):
        edits = _chosen(rng, BYTES)
        for edit in edits:
            data = edit(data, rng)
    else:
        edits = _chosen(rng, ROWS)
        data = database(data, rng, edits)
    return {**seed.files, seed.main: data}, edits


def _shapefile(seed: Seed, rng: Rng) -> tuple[Files, list[Edit]]:
    files = dict(seed.files)
    edits = _chosen(rng, BYTES)
    for edit in edits:
        name = pick(rng, ("a.shp",) * 6 + ("a.dbf", "a.dbf", "a.shx", "a.prj", "a.cpg"))
        files[name] = edit(files[name], rng)
    if chance(rng, 0.05):
        del files[pick(rng, ("a.shx", "a.dbf", "a.prj", "a.cpg"))]
    return files, edits


def _geojson(seed: Seed, rng: Rng) -> tuple[Files, list[Edit]]:
    data = seed.files[seed.main]
    edits = _chosen(rng, TREE)
    data = json_tree(data, rng, edits)
    if chance(rng, 0.2):
        last = pick(rng, (change_digit, change_byte, drop_bytes, cut_tail, exchange_encoding, repeat_key, repeat_key))
        edits, data = [*edits, last], last(data, rng)
    return {**seed.files, seed.main: data}, edits


def _texts(seed: Seed, rng: Rng, names: Sequence[str], edits: Sequence[Edit]) -> tuple[Files, list[Edit]]:
    files = dict(seed.files)
    chosen = _chosen(rng, edits)
    for edit in chosen:
        name = pick(rng, names)
        files[name] = edit(files[name], rng)
    return files, chosen


def mutant(kind: str, seed: Seed, rng: Rng) -> tuple[Files, list[str]]:
    """Changed files of a seed, and the names of the changes."""
    if kind.startswith("dxf"):
        files, edits = _dxf(seed, rng, kind == "dxf-binary")
    elif kind == "gpkg":
        files, edits = _gpkg(seed, rng)
    elif kind == "shapefile":
        files, edits = _shapefile(seed, rng)
    elif kind == "geojson":
        files, edits = _geojson(seed, rng)
    elif kind == "tables":
        files, edits = _texts(seed, rng, ("pontos.csv", "distancias.csv", "feicoes.csv"), TABLE)
    else:
        files, edits = _texts(seed, rng, ("delivery.toml",) if kind == "manifest" else ("perfil.toml",), TOML)
    return files, [edit.__name__ for edit in edits]
