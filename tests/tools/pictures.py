# SPDX-License-Identifier: MIT
"""Pictures of findings, to be judged by eye: a sheet of some of each rule, taken at random, with the linework around.

``python -m tests.tools.pictures FOLDER --scale 1:20 --each 10 --seed 1 --out sheet.html undershoot overshoot``

Each picture is a window of the drawing around a finding: its item red, the other item blue, the rest black, a ring as
wide as the finding is large around the place. Under it stand the file, the item and the sentence, so that the finding
can be looked up.
"""

import argparse
import html
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from foparq.model.items import Items, Role
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.reader import read_dxf

SAGITTA = 0.0005  #: metres, of arcs in the pictures
SIDE = 330  #: pixels of a picture
AROUND = 10.0  #: half the width of a window, in times the size of the finding


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="drawings, DXF")
    parser.add_argument("rule", nargs="+", help="name of a rule")
    parser.add_argument("--scale", default="1:50")
    parser.add_argument("--each", type=int, default=10, help="pictures of each rule")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("pictures.html"))
    given = parser.parse_args()
    paths = sorted(path for path in given.folder.iterdir() if path.suffix.lower() == ".dxf")
    found = [(path, row) for path in paths for row in _findings(path, given.scale)]
    chance = np.random.default_rng(given.seed)
    parts = []
    for rule in given.rule:
        own = [(path, row) for path, row in found if row["name"] == rule]
        taken = [own[n] for n in chance.permutation(len(own))[: given.each]]
        parts.append(f"<h2>{rule}: {len(taken)} of {len(own)}</h2>")
        parts.extend(_picture(n, path, row) for n, (path, row) in enumerate(taken, 1))
    given.out.write_text(_PAGE.format("\n".join(parts)), "utf-8")


_PAGE = """<!doctype html><meta charset="utf-8"><style>body{{font:11px sans-serif;width:1400px}}h2{{clear:both}}
figure{{float:left;margin:4px;width:340px;height:430px}}svg{{border:1px solid #999}}</style>{}"""


def _findings(path: Path, scale: str) -> Iterator[dict[str, Any]]:
    foparq = str(Path(sys.executable).with_name("foparq"))
    command = [foparq, "check", str(path), "--scale", scale, "--format", "jsonl", "--lang", "en"]
    told = subprocess.run(command, capture_output=True, text=True, check=False)
    if told.returncode > 1:
        sys.exit(told.stderr)
    return (json.loads(line) for line in told.stdout.splitlines())


def _picture(n: int, path: Path, row: dict[str, Any]) -> str:
    items = read_dxf(path, limits=LimitsSpec(), sagitta=SAGITTA, unit=None, blocks="explode").items
    x, y = row["where"][:2]
    size = row["size"] or row["limit"] or SAGITTA
    half = AROUND * size
    window = shapely.box(x - half, y - half, x + half, y + half)
    strokes = []
    for geometry, colour, width in _shown(items, row, window):
        for part in shapely.get_parts(shapely.intersection(shapely.force_2d(geometry), window)):
            at = shapely.get_coordinates(part)
            pixels = (np.column_stack([at[:, 0] - x, y - at[:, 1]]) / half + 1) * SIDE / 2
            points = " ".join(f"{a:.1f},{b:.1f}" for a, b in pixels)
            strokes.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="{width}"/>')
    ring = f'<circle cx="{SIDE / 2}" cy="{SIDE / 2}" r="{size / half * SIDE / 2:.1f}" fill="none" stroke="#0a0"/>'
    told = html.escape(f"{n}. {path.stem} {row['layer']}: {row['message']}")
    return f'<figure><svg width="{SIDE}" height="{SIDE}">{"".join(strokes)}{ring}</svg><br>{told}</figure>'


def _shown(items: Items, row: dict[str, Any], window: shapely.Geometry) -> Iterator[tuple[Any, str, float]]:
    near = np.flatnonzero((items.role == Role.LINE) & items.visible & shapely.intersects(items.geometry, window))
    for n in near:
        mine, other = items.item[n] == row["item"], items.item[n] == row["other"]
        yield items.geometry[n], "#d00" if mine else "#00d" if other else "#000", 2.0 if mine or other else 0.8


if __name__ == "__main__":
    main()
