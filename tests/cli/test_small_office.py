# SPDX-License-Identifier: MIT
"""A delivery in Portuguese as a small office sends it: accepted after ``init``; twelve faults, each told where it is.

A facade drawn in space, windows in blocks with sills under them, hatches, dimensions, axes, a title block; the list
names its classes in Portuguese. The faults are strokes of stairs before the wall, at places worked out here.
"""

import json
import re
from pathlib import Path
from typing import NamedTuple

import ezdxf
import numpy as np
import pytest
from ezdxf.math import OCS
from tests.cli.conftest import Command
from tests.tools import office_files
from tests.tools.offices import Office, office

CLASSES = {"window": "janela", "door": "porta", "cornice": "cornija", "panel": "almofada"}
STAIRS = "ESCADA"


class Planted(NamedTuple):
    """A finding that must be told: rule, place on the sheet in metres, and what its sentence must say."""

    rule: str
    at: tuple[float, float]
    says: str


#: lines on the sheet (right, up) below the wall's lower edge, and what is wrong with them
FAULTS: list[tuple[list[tuple[float, float]], Planted]] = [
    ([(0.10, -0.4), (0.10, -0.004)], Planted("undershoot", (0.10, -0.004), "4 mm ")),
    ([(0.25, -0.4), (0.25, -0.002)], Planted("undershoot", (0.25, -0.002), "2 mm ")),
    ([(0.40, -0.4), (0.45, -0.006)], Planted("undershoot", (0.45, -0.006), "6 mm ")),
    ([(0.60, -0.4), (0.60, 0.003)], Planted("overshoot", (0.60, 0.003), "3 mm ")),
    ([(0.75, -0.4), (0.75, 0.005)], Planted("overshoot", (0.75, 0.005), "5 mm ")),
    ([(0.90, -0.4), (0.90, 0.007)], Planted("overshoot", (0.90, 0.007), "7 mm ")),
    ([(1.05, -0.4), (1.05, 0.0)], Planted("duplicate", (1.05, -0.2), STAIRS)),
    ([(1.20, -0.4), (1.20, 0.0)], Planted("duplicate", (1.20, -0.2), STAIRS)),
    ([(1.35, -0.4), (1.35, 0.0)], Planted("line-overlap", (1.35, -0.2), STAIRS)),
    ([(1.50, -0.2), (1.50, -0.2)], Planted("zero-length", (1.50, -0.2), STAIRS)),
    ([(1.70, -0.4), (1.90, -0.2), (1.90, -0.4), (1.70, -0.2), (1.70, -0.4)],
     Planted("self-intersection", (1.80, -0.3), STAIRS)),
    ([(2.05, -0.4), (2.05, -0.003)], Planted("undershoot", (2.05, -0.003), "3 mm ")),
]  # fmt: skip
#: what makes a duplicate or an overlap of a line above
TWICE = [[(1.05, 0.0), (1.05, -0.4)], [(1.20, -0.4), (1.20, 0.0)], [(1.35, -0.3), (1.35, -0.1)]]


def delivery(folder: Path, seed: int, *, planted: bool) -> Office:
    """Write the delivery without its manifest."""
    made = office(
        seed, plane="xz", unit="m", format="dxf", version="R2013", blocks="own", title=True, lettering="cm", axes=True,
        english=False, scale=50, table_unit="m", digits=4,
    )  # fmt: skip
    office_files.write(made, folder)
    (folder / "delivery.toml").unlink()
    features = folder / "feicoes.csv"
    text = features.read_bytes().decode(made.style.encoding)
    for english, own in CLASSES.items():
        text = re.sub(rf"\b{english}\b", own, text)
    features.write_bytes(text.encode(made.style.encoding))
    draw_more(made, folder / "fachada.dxf", planted=planted)
    return made


def draw_more(made: Office, path: Path, *, planted: bool) -> None:
    """Sills whose upper edge is the lower edge of the window, hatches, and the stairs."""
    document = ezdxf.readfile(path)
    model = document.modelspace()
    to_plane = OCS((0, -1, 0))
    for part in made.facade.parts:
        if part.kind != "window":
            continue
        (a, low, depth), (b, *_) = part.ring[:2]
        sill = [(a, low, depth), (b, low, depth), (b, low - 0.1, depth), (a, low - 0.1, depth)]
        model.add_polyline3d(made.place(np.array(sill)), close=True, dxfattribs={"layer": "PEITORIL"})
        hatch = model.add_hatch(dxfattribs={"layer": "HACHURA", "extrusion": (0, -1, 0)})
        flat = [to_plane.from_wcs(tuple(spot)) for spot in made.place(np.array(sill))]
        hatch.dxf.elevation = (0, 0, flat[0].z)
        hatch.paths.add_polyline_path([spot.vec2 for spot in flat], is_closed=True)
    if planted:
        for line in [*(line for line, _ in FAULTS), *TWICE]:
            spots = made.place(np.array([(u, v, 0.0) for u, v in line]))
            if len(line) == 2:
                model.add_line(*spots, dxfattribs={"layer": STAIRS})
            else:
                model.add_polyline3d(spots, dxfattribs={"layer": STAIRS})
    document.saveas(path)


def completed(foparq: Command, made: Office, folder: Path) -> None:
    """``init``, and what it asks for: the scale, what it proposes in comments, the quality of the survey."""
    code, _, err = foparq("init", folder, "--lang", "pt")
    assert (code, err) == (0, "")
    text = (folder / "delivery.toml").read_text("utf-8").replace('# scale = "1:50"', 'scale = "1:50"')
    text = re.sub(r"^# (unit|facade|classes|survey_sd) = ", r"\1 = ", text, flags=re.MULTILINE)
    points, lengths = (f'survey_sd = "{sd * 1000:.4f} mm"' for sd in (made.survey_sd, made.distance_sd))
    text = text.replace('survey_sd = "3 mm"', points, 1).replace('survey_sd = "3 mm"', lengths, 1)
    (folder / "delivery.toml").write_text(text, encoding="utf-8")


@pytest.mark.parametrize("seed", [5, 11, 12])
def test_faultless_it_is_accepted_at_the_first_audit(foparq: Command, tmp_path: Path, seed: int) -> None:
    made = delivery(tmp_path / "entrega", seed, planted=False)
    completed(foparq, made, tmp_path / "entrega")
    code, out, err = foparq("audit", tmp_path / "entrega")
    assert (code, err) == (0, ""), out
    told = json.loads((tmp_path / "entrega" / "audit" / "audit.json").read_text("utf-8"))
    assert told["verdict"] == "accepted"
    assert "Falhas: 0;" in out


@pytest.mark.parametrize("seed", [5, 11])
def test_twelve_faults_are_told_where_they_are(foparq: Command, tmp_path: Path, seed: int) -> None:
    made = delivery(tmp_path / "entrega", seed, planted=True)
    completed(foparq, made, tmp_path / "entrega")
    foparq("audit", tmp_path / "entrega")
    lines = (tmp_path / "entrega" / "audit" / "findings.jsonl").read_text("utf-8").splitlines()
    faults = [row for row in map(json.loads, lines) if row["severity"] != "note"]
    assert len(faults) == len(FAULTS)
    for _, planted in FAULTS:
        at = made.place(np.array([(*planted.at, 0.0)]))[0]
        near = [
            row for row in faults if row["name"] == planted.rule and np.linalg.norm(np.array(row["where"]) - at) < 2e-3
        ]
        assert len(near) == 1, planted
        assert planted.says in near[0]["message"]
        assert near[0]["layer"] == STAIRS
