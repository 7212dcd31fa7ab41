# SPDX-License-Identifier: MIT
"""Tables, manifests and the generator of the generated deliveries, recomputed without foparq."""

import csv
import json
import math
import os
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pyogrio
import pytest
import shapely
from scipy.stats import norm

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"
NAMES = ("station-a", "station-a-draft", "station-a-tape")
FORMATS = ("dxf", "gpkg")


def truth(name: str) -> Any:
    return json.loads((FIXTURES / "truth" / f"{name}.json").read_text("utf-8"))


def table(name: str, file: str) -> list[dict[str, str]]:
    with (FIXTURES / "deliveries" / name / file).open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.parametrize("name", NAMES)
def test_checkpoints_print_as_table_8(name: str) -> None:
    rows = table(name, "pontos.csv")
    surveyed, delivered = (
        np.array([[float(row[c]) for c in axes] for row in rows]) for axes in (("x", "y", "z"), ("xd", "yd", "zd"))
    )
    differences = delivered - surveyed
    mean, sd = differences.mean(axis=0), differences.std(axis=0, ddof=1)
    rmse = np.sqrt((differences**2).mean(axis=0))
    assert len(rows) == 7
    assert [f"{value:.4f}" for value in mean] == ["0.0021", "0.0004", "0.0064"]
    assert [f"{value:.4f}" for value in sd] == ["0.0039", "0.0011", "0.0129"]
    assert [f"{value:.4f}" for value in rmse] == ["0.0042", "0.0011", "0.0135"]
    known = truth(name)["checkpoints"]["axes"]
    for n, axis in enumerate("XYZ"):
        assert [known[axis][word] for word in ("mean", "sd", "rmse")] == pytest.approx(
            [mean[n], sd[n], rmse[n]], abs=1e-8
        )
        assert abs(mean[n] / sd[n] * math.sqrt(7)) < 2.447


@pytest.mark.parametrize("name", NAMES)
def test_distances_print_as_table_9(name: str) -> None:
    rows = table(name, "distancias.csv")
    differences = np.array([float(row["delivered"]) - float(row["measured"]) for row in rows])
    assert len(rows) == 29
    assert all(0.5 <= float(row["delivered"]) <= 3.0 for row in rows)
    rmse = math.sqrt((differences**2).mean())
    assert [f"{differences.mean():.4f}", f"{differences.std(ddof=1):.3f}", f"{rmse:.3f}"] == [
        "0.0001",
        "0.010",
        "0.010",
    ]
    assert f"{1000 * rmse:.1f}" == "9.8"
    # Each coordinate is rounded by at most 0.05 mm.
    assert rmse + 1e-4 < 0.010
    known = truth(name)["distances"]
    assert [known["mean"], known["sd"], known["rmse"]] == pytest.approx(
        [differences.mean(), differences.std(ddof=1), rmse], abs=1e-8
    )
    n = len(rows)
    ordered = norm.cdf(np.sort((differences - differences.mean()) / differences.std(ddof=1)))
    weights = 2 * np.arange(1, n + 1) - 1
    a2 = -n - np.mean(weights * (np.log(ordered) + np.log(1.0 - ordered[::-1])))
    adjusted = a2 * (1 + 0.75 / n + 2.25 / n**2)
    assert 0.34 < adjusted < 0.6
    p = math.exp(0.9177 - 4.279 * adjusted - 1.38 * adjusted**2)
    assert f"{p:.3f}" == "0.204"
    assert known["p"] == pytest.approx(p, abs=1e-4)


def test_deliveries_differ_only_where_they_should() -> None:
    folder = FIXTURES / "deliveries"
    for file in ("pontos.csv", "distancias.csv", "feicoes.csv"):
        assert len({(folder / name / file).read_bytes() for name in NAMES}) == 1
    for file in ("fachada.dxf", "fachada.gpkg"):
        assert (folder / "station-a" / file).read_bytes() == (folder / "station-a-tape" / file).read_bytes()
    sds = {
        name: tomllib.loads((folder / name / "delivery.toml").read_text("utf-8"))["distances"]["survey_sd"]
        for name in NAMES
    }
    assert sds == {"station-a": "3 mm", "station-a-draft": "3 mm", "station-a-tape": "10 mm"}


@pytest.mark.parametrize("name", NAMES)
def test_both_manifests_say_the_same_of_two_drawings(name: str) -> None:
    folder = FIXTURES / "deliveries" / name
    first, second = (
        tomllib.loads((folder / file).read_text("utf-8")) for file in ("delivery.toml", "delivery-gpkg.toml")
    )
    assert (first["drawing"][0].pop("path"), second["drawing"][0].pop("path")) == ("fachada.dxf", "fachada.gpkg")
    assert first == second
    assert first["drawing"][0]["unit"] == "m"
    assert (first["drawing"][0]["plane"], first["delivery"]["scale"], first["delivery"]["crs"]) == (
        "xz",
        "1:50",
        "local",
    )
    for section in ("features", "checkpoints", "distances"):
        assert (folder / first[section]["path"]).is_file()


# --- the generator -----------------------------------------------------------------------------------------------


def delivered_files() -> set[str]:
    """Files of the deliveries; ``audit/`` is where an audit writes."""
    every = (FIXTURES / "deliveries").rglob("*")
    return {
        path.relative_to(FIXTURES).as_posix() for path in every if path.is_file() and "audit" not in path.parts[-2:]
    }


def test_manifest_describes_every_file_and_nothing_else() -> None:
    described = tomllib.loads((FIXTURES / "MANIFEST.toml").read_text("utf-8"))["file"]
    paths = [row["path"] for row in described]
    assert len(paths) == len(set(paths))
    assert set(paths) == delivered_files()
    assert all(row.keys() == {"path", "what", "fault"} and all(row.values()) for row in described)
    assert {row["path"] for row in described if "undershoots" in row["fault"]} == {
        f"deliveries/station-a-draft/fachada.{kind}" for kind in FORMATS
    }


def test_generated_files_stay_small() -> None:
    station = [file for file in delivered_files() if file.startswith("deliveries/station")]
    written = [*station, "MANIFEST.toml", *(f"truth/{name}.json" for name in NAMES)]
    assert sum((FIXTURES / file).stat().st_size for file in written) < 2 * 1024**2


def test_generator_knows_nothing_of_the_code_under_test() -> None:
    for path in [FIXTURES / "generate.py", *(FIXTURES / "generator").rglob("*.py")]:
        assert not any(
            line.strip().startswith(("import foparq", "from foparq")) for line in path.read_text("utf-8").splitlines()
        )


def test_generator_writes_the_same_bytes_twice_and_what_is_committed(tmp_path: Path) -> None:
    runs = [
        subprocess.Popen(
            [sys.executable, str(FIXTURES / "generate.py"), "--out", str(tmp_path / seed)],
            env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONDONTWRITEBYTECODE": "1"},
        )
        for seed in ("1", "2")
    ]
    assert [run.wait() for run in runs] == [0, 0]
    files = {
        seed: {p.relative_to(tmp_path / seed): p for p in (tmp_path / seed).rglob("*") if p.is_file()}
        for seed in ("1", "2")
    }
    assert files["1"].keys() == files["2"].keys()
    for name, path in files["1"].items():
        assert path.read_bytes() == files["2"][name].read_bytes(), name
        if name.suffix in {".toml", ".csv", ".json", ".ply"}:
            assert path.read_bytes() == (FIXTURES / name).read_bytes(), f"{name}: run python fixtures/generate.py"
    # Other versions of ezdxf and GDAL may write other bytes: the content has to be the same.
    for name in NAMES:
        folders = [root / "deliveries" / name for root in (FIXTURES, tmp_path / "1")]
        ours, fresh = (dxf_tags(folder / "fachada.dxf") for folder in folders)
        assert ours[0] == fresh[0]
        assert np.allclose(ours[1], fresh[1], rtol=0, atol=1e-9)
        ours, fresh = (gpkg_rows(folder / "fachada.gpkg") for folder in folders)
        assert ours[0] == fresh[0]
        assert np.allclose(ours[1], fresh[1], rtol=0, atol=1e-9)


def dxf_tags(path: Path) -> tuple[list[str], np.ndarray]:
    """Words and numbers of everything that is drawn."""
    lines = path.read_text("utf-8").splitlines()
    tags = list(zip(lines[::2], lines[1::2], strict=False))
    begin, end = tags.index(("  2", "BLOCKS")), tags.index(("  2", "OBJECTS"))
    real = [tag for tag in tags[begin:end] if 10 <= int(tag[0]) <= 59]
    words = [value for code, value in tags[begin:end] if not 10 <= int(code) <= 59]
    return words, np.array([float(value) for _, value in real])


def gpkg_rows(path: Path) -> tuple[list[tuple[str, int, int]], np.ndarray]:
    """Tables, feature ids and numbers of vertices, and the vertices."""
    rows, vertices = [], []
    for layer, _ in pyogrio.list_layers(path):
        _, fids, geometry, _ = pyogrio.raw.read(path, layer=layer, return_fids=True)
        lines = shapely.from_wkb(geometry)
        counts = shapely.get_num_coordinates(lines)
        rows += [(layer, int(fid), int(count)) for fid, count in zip(fids, counts, strict=True)]
        vertices.append(shapely.get_coordinates(lines, include_z=True))
    return rows, np.concatenate(vertices)
