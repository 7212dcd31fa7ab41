# SPDX-License-Identifier: MIT
"""The railway station, end to end: what is found equals what was planted, and the statistics are the published ones.

Published: Campos, Tommaselli, Ivánová, Billen (2015), doi 10.3390/rs71013337, tables 8 and 9 and section 5.
"""

import json
import shutil
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import shapely

from foparq.audit import audit
from foparq.evaluate.quality import Element, ElementStatus
from foparq.report.record import AuditRecord

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"
NAMES = ("station-a", "station-a-draft", "station-a-tape")
TWINS = ("delivery.toml", "delivery-gpkg.toml")


@cache
def audited(name: str, manifest: str = "delivery.toml") -> AuditRecord:
    done = audit(FIXTURES / "deliveries" / name / manifest, language="en")
    assert done.log == ()
    return done.record


def truth(name: str) -> dict[str, Any]:
    read: dict[str, Any] = json.loads((FIXTURES / "truth" / f"{name}.json").read_text(encoding="utf-8"))
    return read


def element(record: AuditRecord, name: str) -> Element:
    return next(found for found in record.quality.elements if found.id == name)


def parameter(found: Element, name: str) -> float:
    return next(value for key, value, _ in found.parameters if key == name)


@pytest.mark.parametrize("manifest", TWINS)
@pytest.mark.parametrize("name", NAMES)
def test_the_verdict_is_the_expected_one(name: str, manifest: str) -> None:
    assert audited(name, manifest).quality.verdict == truth(name)["verdict"]


@pytest.mark.parametrize("manifest", TWINS)
@pytest.mark.parametrize("name", NAMES)
def test_exactly_the_planted_faults_are_found_kind_by_kind_and_place_by_place(name: str, manifest: str) -> None:
    table = audited(name, manifest).findings
    planted = truth(name)["faults"]["list"]
    assert Counter(table.name.tolist()) == Counter(fault["rule"] for fault in planted)
    used: set[int] = set()
    for fault in planted:
        x, _, z = fault["place"]
        rows = [n for n in range(len(table)) if table.name[n] == fault["rule"] and n not in used]
        row = min(rows, key=lambda n: abs(_middle(table.where[n])[0] - x) + abs(_middle(table.where[n])[2] - z))
        assert _middle(table.where[row]) == pytest.approx(fault["place"], abs=1e-6)
        assert table.size[row] == pytest.approx(fault["size"], abs=1e-6)
        assert table.layer[row] == fault["layer"]
        names = (
            {str(fault["handle"]), str(fault.get("other_handle"))}
            if manifest == "delivery.toml"
            else {str(fault["fid"]), str(fault.get("other_fid"))}
        )
        assert table.handle[row] in names
        used.add(row)


def _middle(shape: shapely.Geometry) -> list[float]:
    points = shapely.get_coordinates(shape, include_z=True)
    return [float(value) for value in (points.min(axis=0) + points.max(axis=0)) / 2]


@pytest.mark.parametrize("manifest", TWINS)
def test_the_rates_before_correction_are_the_published_ones(manifest: str) -> None:
    record = audited("station-a-draft", manifest)
    overlap, dangle, gap = (element(record, name) for name in ("Q3-overlap", "Q3-dangle", "Q3-gap"))
    assert {found.n for found in (overlap, dangle)} == {976}
    assert f"{overlap.value:.1%}" == "0.2%"
    assert f"{dangle.value:.1%}" == "6.6%"
    assert gap.value == 0
    faulty = element(record, "Q3")
    assert (faulty.n, faulty.value) == (976, pytest.approx(66 / 976))
    assert faulty.status is ElementStatus.PASS, "6.76 % is below the specification's 10 %"


@pytest.mark.parametrize("name", NAMES)
def test_checkpoint_statistics_are_those_of_table_8(name: str) -> None:
    published = {
        "X": ("0.0021", "0.0039", "0.0042"),
        "Y": ("0.0004", "0.0011", "0.0011"),
        "Z": ("0.0064", "0.0129", "0.0135"),
    }
    for axis, (mean, sd, rmse) in published.items():
        found = element(audited(name), f"Q1-{axis}")
        assert (f"{parameter(found, 'mean'):.4f}", f"{parameter(found, 'sd'):.4f}", f"{found.value:.4f}") == (
            mean,
            sd,
            rmse,
        )
        assert (found.n, found.limit, found.status) == (7, 0.015, ElementStatus.PASS)
        assert element(audited(name), f"Q6-{axis}").status is ElementStatus.PASS


@pytest.mark.parametrize("name", NAMES)
def test_distance_statistics_are_those_of_table_9(name: str) -> None:
    found = element(audited(name), "Q2")
    assert (found.n, found.limit) == (29, 0.010)
    assert f"{parameter(found, 'mean'):.4f}" == "0.0001"
    assert f"{parameter(found, 'sd'):.3f}" == "0.010"
    assert f"{found.value:.3f}" == "0.010"
    normality = element(audited(name), "Q7")
    assert f"{normality.value:.3f}" == "0.204"
    assert normality.status is ElementStatus.PASS


def test_a_coarse_tape_leaves_the_distances_undecided() -> None:
    found = element(audited("station-a-tape"), "Q2")
    assert found.status is ElementStatus.UNDECIDED
    assert any("survey" in reason.message for reason in found.why)
    open_ones = {
        one.id
        for one in audited("station-a-tape").quality.elements
        if one.required and one.status is not ElementStatus.PASS
    }
    assert open_ones == {"Q2"}, "nothing else stands in the way"


@pytest.mark.parametrize("manifest", TWINS)
@pytest.mark.parametrize("name", NAMES)
def test_five_of_142_features_are_omitted_and_none_is_added(name: str, manifest: str) -> None:
    record = audited(name, manifest)
    omission, commission = element(record, "Q5"), element(record, "Q4")
    assert (omission.n, f"{omission.value:.2%}", omission.status) == (142, "3.52%", ElementStatus.PASS)
    assert (commission.value, commission.status) == (0, ElementStatus.PASS)


def test_both_twins_give_the_same_findings() -> None:
    dxf, gpkg = (audited("station-a-draft", manifest).findings for manifest in TWINS)
    told = [
        sorted(zip(table.name, table.layer, [round(float(size), 6) for size in table.size], strict=True))
        for table in (dxf, gpkg)
    ]
    assert told[0] == told[1]


def test_without_a_plane_nothing_is_accepted_and_nothing_rejected(tmp_path: Path) -> None:
    copy = tmp_path / "station"
    shutil.copytree(FIXTURES / "deliveries" / "station-a", copy, ignore=shutil.ignore_patterns("audit"))
    manifest = copy / "delivery.toml"
    lines = manifest.read_text(encoding="utf-8").splitlines()
    manifest.write_text("\n".join(line for line in lines if not line.startswith("plane")), encoding="utf-8")
    record = audit(manifest).record
    assert record.quality.verdict == "undecided"
    assert {name: element(record, name).status for name in ("Q3", "Q4", "Q5")} == dict.fromkeys(
        ("Q3", "Q4", "Q5"), ElementStatus.UNDECIDED
    )
