# SPDX-License-Identifier: MIT
"""Point symbols in files: no linework for any rule, named in every report, and nothing hides behind them."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pyogrio
import pytest
import shapely
import shapely.affinity
from ezdxf.document import Drawing as Document
from tests.check.windows import drawing
from tests.read.cad_exports import APART, WHOLE, export

from foparq.audit import Audit, check_files
from foparq.check.bounds import Broken, Budget
from foparq.check.drawn.symbols import with_symbols
from foparq.check.run import check_part
from foparq.cli.main import run
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Verdict
from foparq.evaluate.tally import tally
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, Status
from foparq.model.delivery import Delivery
from foparq.model.items import Holder
from foparq.profile.adjust import with_settings
from foparq.profile.load import load_profile
from foparq.read.delivery import read_loose
from foparq.report.files import write_reports

PROFILE = load_profile("et-doc-foparq-b")
FAULTS_AND_INVALID = ("invalid-geometry", "undershoot", "duplicate")
FAULTS = ("overshoot", "undershoot", "duplicate", "line-overlap", "self-intersection")


def document() -> Document:
    """A frame of 10 m by 6 m, and a post that stops 5 mm short of its sill."""
    made = ezdxf.new("R2010", units=6)
    for name in ("PAREDE", "PONTOS"):
        made.layers.add(name)
    corners = [(0, 0), (10, 0), (10, 6), (0, 6)]
    space = made.modelspace()
    for n, corner in enumerate(corners):
        space.add_line(corner, corners[(n + 1) % 4], dxfattribs={"layer": "PAREDE"})
    space.add_line((3, 0.005), (3, 6), dxfattribs={"layer": "PAREDE"})
    block = made.blocks.new("CRUZ")
    for arm in ((0.05, 0), (0, 0.05)):
        block.add_line((-arm[0], -arm[1]), arm)
    return made


def insert(made: Document, *places: tuple[float, float], block: str = "CRUZ", **more: Any) -> None:
    for place in places:
        made.modelspace().add_blockref(block, place, dxfattribs={"layer": "PONTOS", **more})


def saved(made: Document, path: Path) -> Path:
    made.saveas(path)
    return path


def check(path: Path, *settings: str, scale: float = 50.0, language: str = "en") -> Audit:
    profile = with_settings(PROFILE, settings)
    return check_files([path], profile=profile, scale=scale, unit="m", plane=None, areas=(), language=language)


def ran(done: Audit, name: str) -> Outcome:
    return next(outcome for outcome in done.record.outcomes if outcome.name == name)


def places(done: Audit, *names: str) -> list[list[float]]:
    findings = done.record.findings
    return sorted(np.round(findings.place[np.isin(findings.name, names)], 6).tolist())


#: on corners, in the open, over the gap of the post, an arm 4 mm from the sill and one 4 mm beyond it
SIGNS = [(0.0, 0.0), (10.0, 6.0), (5.0, 3.0), (3.0, 0.005), (6.0, 0.054), (7.0, 0.046)]


def test_strokes_of_a_symbol_are_neither_accused_nor_met(tmp_path: Path) -> None:
    made = document()
    insert(made, *SIGNS)
    path = saved(made, tmp_path / "a.dxf")
    done, all_linework = check(path), check(path, "linework.symbol=0 mm")
    assert places(done, *FAULTS) == [[3.0, 0.005, 0.0]], "the post that the cross lies on"
    assert places(all_linework, *FAULTS) == [[6.0, 0.004, 0.0], [7.0, -0.004, 0.0]], "arms, and the post is met"
    assert set(done.record.findings.layer) == {"PAREDE"}
    assert [ran(one, "undershoot").checked for one in (done, all_linework)] == [5, 17]
    assert ran(done, "invalid-geometry").checked == 5, "sound strokes thin out no rate"


@pytest.mark.parametrize("options", [WHOLE, APART], ids=["whole", "apart"])
def test_a_cad_export_has_the_same_symbols(tmp_path: Path, options: dict[str, str]) -> None:
    """Inserts are known by their handles; blocks are told apart by their form."""
    made = document()
    insert(made, *SIGNS)
    path = saved(made, tmp_path / "a.dxf")
    moved = export(path, tmp_path / "a.gpkg", options)
    one, two = check(path), check(moved)
    assert places(two, *FAULTS) == places(one, *FAULTS) == [[3.0, 0.005, 0.0]]
    assert [done.record.delivery.drawings[0].symbols.inserts for done in (one, two)] == [6, 6]


def test_features_of_several_lines_are_inserts_of_a_block_without_a_name(tmp_path: Path) -> None:
    """In a GeoPackage that no CAD program made: by their form, not by the layer they share."""
    arms = [[(-0.05, 0), (0.05, 0)], [(0, -0.05), (0, 0.05)]]
    crosses = [shapely.multilinestrings(np.array(arms) + np.array([x, 3.0])) for x in range(6)]
    posts = [shapely.MultiLineString([[(x, 0), (x, 0.05)], [(x, 0.05), (x + 0.05, 0.05)]]) for x in range(6)]
    lines = np.array([*crosses, *posts, shapely.MultiLineString([[(-5, 0), (9, 0)], [(-5, 7), (9, 7)]])])
    path = tmp_path / "a.gpkg"
    pyogrio.raw.write(
        path, shapely.to_wkb(lines), [np.arange(len(lines))], ["n"], driver="GPKG", layer="TUDO",
        geometry_type="MultiLineString", crs='LOCAL_CS["Undefined Cartesian SRS"]',
    )  # fmt: skip
    (block,) = check(path).record.delivery.drawings[0].symbols.blocks
    assert (block.name, block.inserts, block.layers) == ("", 6, (("TUDO", 6),)), "posts stand on the wall"


def test_a_symbol_is_small_on_the_sheet(tmp_path: Path) -> None:
    """100 mm: 2 mm at 1:50, 4 mm at 1:25."""
    made = document()
    insert(made, *SIGNS)
    path = saved(made, tmp_path / "a.dxf")
    assert check(path).record.delivery.drawings[0].symbols.inserts == 6
    assert check(path, scale=25.0).record.delivery.drawings[0].symbols.inserts == 0
    assert check(path, "linework.symbol_times=7").record.delivery.drawings[0].symbols.inserts == 1, "stands alone"


def skipped(done: Audit) -> list[tuple[str, str, str, int]]:
    (source,) = [source for source in done.record.delivery.sources if source.role == "drawing"]
    return [(part.reason.value, part.name, part.layer, part.count) for part in source.skipped]


def test_symbols_are_listed_everywhere(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = document()
    made.layers.add("NIVEIS")
    made.blocks.new("ALVO").add_circle((0, 0), 0.04, dxfattribs={"layer": "NIVEIS"})
    insert(made, *SIGNS)
    insert(made, (8, 4), block="ALVO")
    path = saved(made, tmp_path / "a.dxf")
    for language, words in (("en", "point symbols"), ("pt-BR", "símbolos pontuais")):
        done = check(path, language=language)
        assert skipped(done) == [("point-symbol", "ALVO", "NIVEIS", 1), ("point-symbol", "CRUZ", "PONTOS", 6)]
        written = write_reports(done.record, done.log, tmp_path / language)
        page, data = (
            next(p for p in written.paths if p.name == name).read_text("utf-8")
            for name in ("report.html", "audit.json")
        )
        (remark,) = json.loads(data)["remarks"]
        (source,) = [source for source in json.loads(data)["inputs"] if source["role"] == "drawing"]
        assert {(one["reason"], one["name"], one["count"]) for one in source["skipped"]} == {
            ("point-symbol", "ALVO", 1), ("point-symbol", "CRUZ", 6)
        }  # fmt: skip
        run(["check", str(path), "--scale", "1:50", "--unit", "m", "--lang", language])
        shown = " ".join(capsys.readouterr().out.split())
        for text in (page, remark["text"], shown):
            assert words in text
            assert "CRUZ × 6 (PONTOS)" in text
            assert "ALVO × 1 (NIVEIS)" in text


def test_a_symbol_alone_is_nothing_to_check(tmp_path: Path) -> None:
    made = ezdxf.new("R2010", units=6)
    made.blocks.new("CRUZ").add_line((0, 0), (0.1, 0))
    insert(made, (3, 3), (13, 9))
    done = check(saved(made, tmp_path / "a.dxf"))
    assert done.record.quality.verdict is Verdict.UNDECIDED
    assert ran(done, "undershoot").because is Because.NOTHING


@pytest.mark.parametrize(("crosses", "verdict"), [(190, Verdict.ACCEPTED), (191, Verdict.UNDECIDED)])
def test_most_of_the_linework_is_never_a_symbol_in_silence(tmp_path: Path, crosses: int, verdict: Verdict) -> None:
    """Lines of 38 m in all, and 200 mm in each cross: half may be symbols."""
    made = document()
    made.modelspace().delete_entity(made.modelspace()[4])
    made.modelspace().add_line((3, 0), (3, 6), dxfattribs={"layer": "PAREDE"})
    insert(made, *((4 + n % 20 / 4, 1 + n // 20 / 4) for n in range(crosses)))
    done = check(saved(made, tmp_path / "a.dxf"))
    assert places(done, *FAULTS) == []
    assert done.record.quality.verdict is verdict
    said = {reason.message for reason in (*done.record.quality.why, *done.record.quality.remarks)}
    assert "verdict.symbols" in said
    assert ("files.symbols-most" in said) == (verdict is Verdict.UNDECIDED)


@pytest.mark.parametrize("because", [Because.LIMIT, Because.CRASHED])
def test_a_search_that_breaks_off_leaves_the_rules_open(tmp_path: Path, because: Because) -> None:
    made = document()
    insert(made, *SIGNS)
    path = saved(made, tmp_path / "a.dxf")

    def broken(function: object, args: tuple[Any, ...], budget: Budget) -> Iterator[object]:  # noqa: ARG001 - protocol
        yield Broken(because, "trace" if because is Because.CRASHED else "")

    delivery, _ = read_loose([path], profile=PROFILE, scale=50.0, unit="m", plane=None)
    delivery, log = with_symbols(delivery, PROFILE, 50.0, broken)
    assert bool(log) == (because is Because.CRASHED)
    outcomes = check_part(delivery.drawings[0], PROFILE, 50.0).outcomes
    assert {outcome.because for outcome in outcomes if outcome.name in FAULTS} == {because}
    assert {outcome.status for outcome in outcomes if outcome.name in FAULTS} == {Status.NOT_RUN}
    assert next(outcome for outcome in outcomes if outcome.name == "invalid-geometry").status is Status.CLEAN


def test_an_invalid_shape_in_a_symbol_is_told_and_counts() -> None:
    """An area whose hole is all of it, in each of four crosses."""
    square = "0 0, 0.02 0, 0.02 0.02, 0 0.02, 0 0"
    shapes, holders = ["LINESTRING (0 0, 9 0)"], [""]
    for n in range(4):
        for shape in ("LINESTRING (-0.05 0, 0.05 0)", f"POLYGON (({square}), ({square}))"):
            shapes.append(shapely.affinity.translate(shapely.from_wkt(shape), n, 1).wkt)
            holders.append(str(Holder(f"I{n}", "PONTOS", "CRUZ")))
    part = drawing(shapes, holders=holders, classes={})
    delivery, _ = with_symbols(Delivery(title="", sources=(), parts=(part,)), PROFILE, 50.0)
    (part,) = delivery.drawings
    assert len(part.symbols.rows) == 8
    outcomes = check_part(part, PROFILE, 50.0).outcomes
    done = {outcome.name: outcome for outcome in outcomes}
    assert (done["invalid-geometry"].found, done["invalid-geometry"].checked) == (4, 5)
    assert (done["undershoot"].found, done["undershoot"].checked) == (0, 1)
    counted = tally(Evidence(delivery=delivery, outcomes=outcomes, counts=None, scale=50.0), FAULTS_AND_INVALID)
    assert (counted.faulty, counted.checked) == (4, 5)
