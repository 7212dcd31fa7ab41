# SPDX-License-Identifier: MIT
"""Meshes in the page: what it holds of them, what it tells, and that names stay names."""

import hashlib
import re
import tomllib
from base64 import b64decode, b64encode
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import shapely
from tests.mesh.files import mesh
from tests.mesh.made import GEOREFERENCED, box, sphere
from tests.report.mesh_records import UNKNOWN, data_of, findings_at, mesh_of, point, record_of

from foparq.model.drawing import Drawing
from foparq.model.mesh import MeshReading
from foparq.report.page.page import page
from foparq.report.record import AuditRecord
from foparq.resources import shipped

VENDOR = Path(str(shipped("templates"))) / "page" / "vendor"
BUNDLE = "three.js 0.187.0"


class Tags(HTMLParser):
    """Every tag with its attributes, and the text of scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag == "script":
            self.scripts.append("")

    def handle_endtag(self, tag: str) -> None:
        self.tags.append((f"/{tag}", {}))

    def handle_data(self, data: str) -> None:
        if self.tags and self.tags[-1][0] == "script":
            self.scripts[-1] += data


def test_the_bundle_is_what_its_file_says_and_bears_its_licence() -> None:
    told = tomllib.loads((VENDOR / "three.toml").read_text(encoding="utf-8"))
    bundle = (VENDOR / told["file"]).read_bytes()
    assert hashlib.sha256(bundle).hexdigest() == told["sha256"]
    licence = (VENDOR / told["licence_file"]).read_text(encoding="utf-8")
    assert licence.startswith("The MIT License")
    assert licence.strip() in bundle.decode("utf-8"), "the licence goes with every copy"
    recipe = (VENDOR / told["recipe"]).read_text(encoding="utf-8")
    assert f"three@{told['version']}" in recipe
    assert told["bundler"].replace(" ", "@") in recipe


def test_it_stands_in_the_page_of_meshes_only(rejected: AuditRecord) -> None:
    assert BUNDLE not in page(rejected)
    assert page(record_of(rejected, [mesh_of(box(2))])).count(BUNDLE) == 1
    assert BUNDLE not in page(record_of(rejected, [mesh_of(mesh([], []))])), "there is nothing to turn"


def test_only_shipped_scripts_run_and_the_network_is_closed(rejected: AuditRecord) -> None:
    read = Tags(page(record_of(rejected, [mesh_of(box(2))], findings_at([point(0, 0, 0)]))))
    policy = next(attrs["content"] or "" for tag, attrs in read.tags if attrs.get("http-equiv"))
    rules = {name: rest for name, _, rest in (rule.strip().partition(" ") for rule in policy.split(";"))}
    hashes = [f"'sha256-{b64encode(hashlib.sha256(s.encode()).digest()).decode()}'" for s in read.scripts]
    assert len(hashes) == 3
    assert sorted(rules["script-src"].split()) == sorted(hashes)
    assert rules["default-src"] == "'none'"
    assert set(rules) == {"default-src", "style-src", "script-src", "img-src", "base-uri", "form-action"}
    assert rules["img-src"] == "data:"
    assert "unsafe" not in policy
    for tag, attrs in read.tags:
        assert not any(name.startswith("on") for name in attrs), tag
        assert (attrs.get("src") or "").startswith(("", "data:"))
        assert re.match(r"#|data:image/png;base64,|$", attrs.get("href") or ""), attrs


def test_hostile_names_are_text(rejected: AuditRecord, hostile: str) -> None:
    path = f"{hostile}\"'--> .ply"
    part = mesh_of(box(2), path=path, groups=(hostile,))
    text = page(record_of(rejected, [part], findings_at([point(0, 0, 0)], path=path, layer=hostile)))
    read = Tags(text)
    assert all("onerror" not in attrs for _, attrs in read.tags)
    assert "img" not in {tag for tag, _ in read.tags}
    assert len(read.scripts) == 3
    assert hostile not in text
    for name, value in data_of(text).items():
        assert re.fullmatch(r"[xyz]|yes|[\d.e+-]*|[\d ]+|[A-Za-z0-9+/]+=*", value), name


def test_findings_are_drawn_at_their_own_coordinates(rejected: AuditRecord) -> None:
    """Of a mesh at map coordinates whose surface is simplified: to what single precision holds of its own frame."""
    surface = sphere(6)
    surface = surface._replace(points=surface.points + GEOREFERENCED)
    rng = np.random.default_rng(4)
    at = rng.uniform(-1, 1, (3, 6, 3)) + GEOREFERENCED
    ring = shapely.Polygon([*at[0][:3], at[0][0]])
    where = [ring, shapely.LineString(at[1]), shapely.Point(at[2][0])]
    data = data_of(page(record_of(rejected, [mesh_of(surface)], findings_at(where))))
    low, size = surface.points.min(axis=0), float(np.ptp(surface.points, axis=0).max())

    def held(name: str) -> np.ndarray:
        values: np.ndarray = np.frombuffer(b64decode(data[name]), dtype="<f4").reshape(-1, 3)
        return low + values.astype(float) * size

    slack = size * 2.0**-24 + 2e-9
    assert np.abs(held("points") - at[2][:1]).max() <= slack
    assert np.abs(held("faces") - at[0][:3]).max() <= slack
    along = np.stack([at[1][:-1], at[1][1:]], axis=1).reshape(-1, 3)
    around = np.stack([at[0][:3], at[0][[1, 2, 0]]], axis=1).reshape(-1, 3)
    found = held("lines")
    for expected in (*along, *around):
        assert np.abs(found - expected).max(axis=1).min() <= slack
    assert len(found) == len(along) + len(around)
    assert data["lines-count"].split() == ["0", str(len(found) // 2), "0", "0"]
    marks = np.frombuffer(b64decode(data["marks"]), dtype="<f4").reshape(-1, 6)
    assert sorted(marks[:, 0].tolist()) == [1, 2, 3]


def test_what_is_too_much_to_draw_is_told(rejected: AuditRecord, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foparq.report.page.meshes.defects.FINDINGS", 3)
    grave = findings_at([point(0, 0, 0)], "critical", rule="MSH022")
    light = findings_at([point(n, 0, 0) for n in range(4)], "minor")
    text = page(record_of(rejected, [mesh_of(box(2))], light, grave))
    assert "Drawn are the first 3 of 5 findings with a place, the gravest first." in text
    assert "São desenhados os primeiros 3 de 5 apontamentos com lugar, a começar pelos mais graves." in text
    assert data_of(text)["points-count"] == "1 0 2 0"
    monkeypatch.setattr("foparq.report.page.meshes.defects.PIECES", 5)
    long = shapely.LineString([(n / 10, 0, 0) for n in range(9)])
    text = page(record_of(rejected, [mesh_of(box(2))], findings_at([long])))
    assert data_of(text)["lines-count"] == "0 5 0 0"
    assert "Findings whose outline is drawn in part only, for its size: 1." in text


def test_what_is_not_shown_is_told(rejected: AuditRecord, monkeypatch: pytest.MonkeyPatch) -> None:
    good = box(2)
    spoilt = mesh([*good.points.tolist(), (np.nan, 0, 0)], [*good.lists(), [0, 1, 26], [0, 1]])
    text = page(record_of(rejected, [mesh_of(spoilt)]))
    assert "Faces that cannot be drawn, because a corner has no place or there are fewer than three: 2." in text
    assert "The mesh holds nothing that can be drawn." in page(record_of(rejected, [mesh_of(mesh([], []))]))
    monkeypatch.setattr("foparq.report.page.meshes.figure.SHOWN", 2)
    parts = [mesh_of(box(1), path=f"{n}.ply") for n in range(3)]
    text = page(record_of(rejected, parts, findings_at([point(0, 0, 0)], path="2.ply")))
    assert "Only the first 2 of 3 meshes are shown." in text
    assert 'class="to-mark"' not in text, "a row leads to no mesh that is not shown"


def test_a_simplified_surface_says_so_with_its_cell(rejected: AuditRecord, monkeypatch: pytest.MonkeyPatch) -> None:
    text = page(record_of(rejected, [mesh_of(sphere(3))]))
    assert "Every face that can be drawn is shown" in text
    monkeypatch.setattr("foparq.report.page.meshes.figure.TRIANGLES", 500)
    monkeypatch.setattr("foparq.report.page.meshes.figure._FEWEST", 500)
    text = page(record_of(rejected, [mesh_of(sphere(3))]))
    told = re.search(r"to (\d+) triangles for 1,280 faces: .*? none stands farther than ([\d.]+) (mm|m) along", text)
    assert told
    assert int(told[1]) <= 500
    assert float(told[2]) * (0.001 if told[3] == "mm" else 1) == pytest.approx(
        2 * float(data_of(text)["cell"]), rel=0.01
    )
    assert "A superfície é simplificada" in text


def test_up_is_as_stated_else_of_the_format_else_z(rejected: AuditRecord) -> None:
    gltf = MeshReading(version="glTF 2.0", up="y")
    for part, axis, told in (
        (mesh_of(box(1)), "z", "because nobody states another axis"),
        (mesh_of(box(1), reading=gltf), "y", "as the format has it"),
        (mesh_of(box(1), reading=gltf, up="x"), "x", "as stated"),
    ):
        text = page(record_of(rejected, [part]))
        assert data_of(text)["up"] == axis
        assert f"Up is {axis}, {told}" in text


def test_scale_bars_are_metres_or_units_of_the_file(rejected: AuditRecord) -> None:
    """A cube of three units is 640 of 680 pixels: a fifth of its picture is 0.64 units."""
    for unit, lettering in ((None, "50 cm"), (UNKNOWN, "0.5 drawing units")):
        part = mesh_of(box(2, (3.0, 3.0, 3.0)), **({} if unit is None else {"unit": unit}))
        text = page(record_of(rejected, [part]))
        english = text[text.index('<main lang="en">') :]
        bars = re.findall(r'class="plate-bar"><path d="M80 \d+v50h([\d.]+)v-50"/><text [^>]*>([^<]*)<', english)
        bars = bars[:6]
        assert {name for _, name in bars} == {lettering}
        assert all(float(length) / 10 == pytest.approx(0.5 * 640 / 3, abs=0.1) for length, _ in bars)
        assert float(data_of(text)["metres"]) == (3.0 if unit is None else 0.0)


def test_rows_lead_to_their_mesh_and_drawings_stay(rejected: AuditRecord, drawing: Drawing) -> None:
    part = mesh_of(box(2))
    record = record_of(rejected, [part], rejected.findings, findings_at([point(0, 0, 0), None]))
    record = replace(record, delivery=replace(record.delivery, parts=(drawing, part)))
    read = Tags(page(record))
    ids = {attrs["id"] for _, attrs in read.tags if attrs.get("id")}
    links = [attrs for tag, attrs in read.tags if attrs.get("class") == "to-mark"]
    assert all((link["href"] or "")[1:] in ids for link in links)
    assert sum("data-solid" in link for link in links) == 2, "one with a place, in two languages"
    assert sum("data-solid" not in link for link in links) == 2 * np.sum(~shapely.is_empty(rejected.findings.sheet))


@pytest.mark.parametrize(("subdivisions", "most"), [(6, 3_000_000), (7, 4_000_000)])
def test_a_page_stays_small(rejected: AuditRecord, subdivisions: int, most: int) -> None:
    """81,920 faces are shown whole, 327,680 simplified; their surface is rough, as scanned ones are."""
    surface = sphere(subdivisions)
    rough = surface.points * (1 + np.random.default_rng(1).normal(0, 0.003, (len(surface.points), 1)))
    text = page(record_of(rejected, [mesh_of(surface._replace(points=rough))]))
    assert len(text.encode()) < most


def test_the_same_mesh_gives_the_same_bytes(rejected: AuditRecord) -> None:
    record = record_of(rejected, [mesh_of(sphere(4))], findings_at([point(1, 0, 0), point(0, 1, 0)]))
    assert page(record) == page(record)
