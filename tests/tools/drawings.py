# SPDX-License-Identifier: MIT
"""Drawings that are large, or slow by nature."""

import json
import sqlite3
from pathlib import Path

import numpy as np
import pyogrio.raw
import shapely
from inputs import block, drawing, insert, line, polyline, write_dxf

# --- geometry -----------------------------------------------------------------------------------------------------


@drawing()
def many_layers(path: Path) -> None:
    """10,000 layers with one line each."""
    names = [f"CAMADA_{n}" for n in range(10_000)]
    lines = "".join(line(n % 100, n // 100, n % 100 + 0.5, n // 100, layer=name) for n, name in enumerate(names))
    write_dxf(path, layers=names, entities=lines)


@drawing()
def fine_polyline(path: Path) -> None:
    """100,000 vertices within one millimetre."""
    points = np.random.default_rng(1).random((100_000, 2)) * 0.001
    write_dxf(path, entities=polyline(points))


@drawing()
def equal_lines(path: Path) -> None:
    """50,000 equal lines."""
    write_dxf(path, entities=line(0, 0, 1, 0) * 50_000)


@drawing()
def nested_rectangles(path: Path) -> None:
    """2,000 rectangles, each within the one before."""
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)
    write_dxf(path, entities="".join(polyline(corners * (1 + n / 100), closed=True) for n in range(2_000)))


@drawing()
def star(path: Path) -> None:
    """A closed star of 15,000 vertices, each edge crossing nearly all others."""
    n = 15_001
    turn = np.arange(n) * (n // 2) % n * (2 * np.pi / n)
    write_dxf(path, entities=polyline(10 * np.stack([np.cos(turn), np.sin(turn)], axis=1), closed=True))


@drawing()
def overlap_chain(path: Path) -> None:
    """10,000 lines on one line, each overlapping the next."""
    write_dxf(path, entities="".join(line(n, 0, n + 1.5, 0) for n in range(10_000)))


@drawing()
def scribble(path: Path) -> None:
    """A random walk of 50,000 steps in a square of 20 steps."""
    steps = np.random.default_rng(2).normal(size=(50_000, 2)).cumsum(axis=0)
    write_dxf(path, entities=polyline(np.abs(np.mod(steps, 40) - 20)))


@drawing()
def spiral(path: Path) -> None:
    """A spiral of 100,000 vertices whose turns lie 1 mm apart."""
    turn = np.linspace(0, 2 * np.pi * 1_000, 100_000)
    radius = turn / (2 * np.pi) * 0.001
    write_dxf(path, entities=polyline(np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)))


# --- structure ----------------------------------------------------------------------------------------------------


@drawing()
def layer_table(path: Path) -> None:
    """300,000 layers in the table, one line."""
    write_dxf(path, layers=[f"CAMADA_{n}" for n in range(300_000)], entities=line(0, 0, 1, 0))


@drawing(seconds=60)
def many_inserts(path: Path) -> None:
    """60,000 inserts of a block of 30 lines."""
    lines = "".join(line(0, n / 100, 0.5, n / 100) for n in range(30))
    inserts = "".join(insert("GRADE", float(n % 250), float(n // 250)) for n in range(60_000))
    write_dxf(path, blocks=block("GRADE", lines), entities=inserts)


@drawing()
def block_chain(path: Path) -> None:
    """20,000 blocks, each inserting the next."""
    n = 20_000
    blocks = [block(f"B{i}", insert(f"B{i + 1}", 0.0, 0.0)) for i in range(n)]
    write_dxf(path, blocks="".join(blocks) + block(f"B{n}", line(0, 0, 1, 0)), entities=insert("B0", 0.0, 0.0))


@drawing()
def many_attributes(path: Path) -> None:
    """200,000 attributes on one insert."""
    attribute = (
        "  0\nATTRIB\n100\nAcDbEntity\n  8\n0\n100\nAcDbText\n 10\n0.0\n 20\n0.0\n 40\n0.1\n  1\nX\n"
        "100\nAcDbAttribute\n  2\nTAG\n 70\n0\n"
    )
    held = insert("PORTA", 0.0, 0.0, more="").replace("100\nAcDbBlockReference\n", "100\nAcDbBlockReference\n 66\n1\n")
    end = "  0\nSEQEND\n100\nAcDbEntity\n  8\n0\n"
    write_dxf(path, blocks=block("PORTA", line(0, 0, 1, 0)), entities=held + attribute * 200_000 + end)


@drawing()
def many_sections(path: Path) -> None:
    """300,000 sections."""
    write_dxf(path, entities=line(0, 0, 1, 0))
    text = path.read_text(encoding="utf-8")
    extra = "".join(f"  0\nSECTION\n  2\nX{n}\n  0\nENDSEC\n" for n in range(300_000))
    end = text.rindex("  0\nEOF")
    path.write_text(text[:end] + extra + text[end:], encoding="utf-8")


# --- lettering ----------------------------------------------------------------------------------------------------

_LETTERS = {
    "braces": "{" * 200_000,
    "stacks": r"\S1" * 70_000,
    "tildes": "~" * 200_000 + "x",
    "brackets": "(" * 200_000,
    "blanks": "1" + " " * 200_000 + "x",
    "digits": "1" * 200_000 + "x",
    "escapes": r"\M+1" * 50_000 + r"\U+" * 60_000,
}


@drawing()
def mtext(path: Path) -> None:
    """MTEXT of 200,000 characters, in every manner that could stall a pattern."""
    texts = "".join(
        f"  0\nMTEXT\n100\nAcDbEntity\n  8\n0\n100\nAcDbMText\n 10\n0.0\n 20\n0.0\n 40\n0.1\n  1\n{text}\n"
        for text in _LETTERS.values()
    )
    write_dxf(path, entities=texts + line(0, 0, 1, 0))


@drawing()
def dimension_texts(path: Path) -> None:
    """Dimensions lettered with 200,000 characters."""
    texts = "".join(
        "  0\nDIMENSION\n100\nAcDbEntity\n  8\n0\n100\nAcDbDimension\n"
        f" 10\n0.0\n 20\n1.0\n 11\n0.5\n 21\n1.0\n 70\n32\n  1\n{text}\n 42\n1.0\n  3\nStandard\n"
        "100\nAcDbAlignedDimension\n 13\n0.0\n 23\n0.0\n 14\n1.0\n 24\n0.0\n100\nAcDbRotatedDimension\n"
        for text in _LETTERS.values()
    )
    write_dxf(path, entities=texts + line(0, 0, 1, 0))


# --- other formats ------------------------------------------------------------------------------------------------


@drawing(suffix=".geojson")
def geojson_properties(path: Path) -> None:
    """One feature with 200,000 properties."""
    properties = {f"p{n}": n for n in range(200_000)}
    feature = {
        "type": "Feature", "properties": properties,
        "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 0]]},
    }  # fmt: skip
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}), encoding="utf-8")


@drawing(suffix=".geojson")
def geojson_deep(path: Path) -> None:
    """100,000 brackets within each other."""
    path.write_text('{"type":"FeatureCollection","features":' + "[" * 100_000 + "]" * 100_000 + "}", encoding="utf-8")


def lines_gpkg(path: Path, **columns: list[object]) -> None:
    """GeoPackage of one table with a line."""
    wkb = np.array([shapely.to_wkb(shapely.LineString([(0, 0), (1, 0)]))], dtype=object)
    values = [np.array(column, dtype=object) for column in columns.values()]
    pyogrio.raw.write(
        path, wkb, values, list(columns), geometry_type="LineString", driver="GPKG", crs="EPSG:31982", layer="paredes"
    )


@drawing(suffix=".gpkg")
def text_cell(path: Path) -> None:
    """A cell of 300 MB in the column that names the layer."""
    lines_gpkg(path, layer=["x"])
    with sqlite3.connect(path) as connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            connection.execute(f'DROP TRIGGER "{name}"')
        connection.execute("UPDATE paredes SET layer = CAST(? AS TEXT)", (b"x" * 300_000_000,))
    connection.close()


@drawing(suffix=".gpkg")
def geometry_cell(path: Path) -> None:
    """A geometry of 300 MB."""
    lines_gpkg(path, layer=["x"])
    with sqlite3.connect(path) as connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            connection.execute(f'DROP TRIGGER "{name}"')
        head = (
            b"GP\x00\x01" + (31982).to_bytes(4, "little") + b"\x01\x02\x00\x00\x00" + (18_750_000).to_bytes(4, "little")
        )
        connection.execute("UPDATE paredes SET geom = ?", (head + b"\x00" * 300_000_000,))
    connection.close()
