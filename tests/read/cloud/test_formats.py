# SPDX-License-Identifier: MIT
"""PLY, LAS and LAZ as references: what is in them, and files that are damaged."""

import struct
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.read.cloud.files import POINTS, las, ply, read, refused

from foparq.profile.load import load_profile
from foparq.read.cloud.take import read_raw_cloud
from foparq.read.guard.parent import guarded

VLR_COUNT, POINT_COUNT, POINT_COUNT_14, EVLR_COUNT_14 = 100, 107, 247, 243


@pytest.mark.parametrize("kind", ["<f8", ">f8"])
@pytest.mark.parametrize("faces", [0, 2])
def test_vertices_of_a_ply_with_faces_and_without(kind: str, faces: int, tmp_path: Path) -> None:
    cloud = read(tmp_path, ply(POINTS, kind, faces))
    assert cloud.points.tolist() == POINTS.tolist()


def test_single_precision_is_widened_exactly(tmp_path: Path) -> None:
    assert read(tmp_path, ply(POINTS, "<f4")).points.tolist() == POINTS.astype(np.float32).astype(float).tolist()


def test_a_ply_in_text(tmp_path: Path) -> None:
    head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
    rows = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in POINTS.tolist())
    assert read(tmp_path, head + rows).points.tolist() == POINTS.tolist()


def test_points_of_a_ply_without_coordinates_are_counted(tmp_path: Path) -> None:
    holed = POINTS.copy()
    holed[1, 2] = np.nan
    cloud = read(tmp_path, ply(holed))
    assert (cloud.points.tolist(), cloud.empty) == (POINTS[[0, 2]].tolist(), 1)


def test_a_ply_that_is_damaged(tmp_path: Path) -> None:
    sound = ply(POINTS)
    assert refused(tmp_path, sound[:-1]).message == "mesh.cut-off"
    assert refused(tmp_path, sound.replace(b"vertex 3", b"vertex 1000000000000")).message == "mesh.cut-off"
    assert refused(tmp_path, sound.replace(b"vertex 3", b"vertex 0")[: sound.index(b"end_header") + 11]).message == (
        "cloud.no-points"
    )
    assert refused(tmp_path, sound, points=2).message == "cloud.too-many-points"


@pytest.mark.parametrize("name", ["nuvem.las", "nuvem.laz"])
@pytest.mark.parametrize("version", ["1.2", "1.4"])
def test_coordinates_of_las(name: str, version: str, tmp_path: Path) -> None:
    cloud = read(tmp_path, las(tmp_path / name, POINTS, version), name)
    assert cloud.points == pytest.approx(POINTS, abs=6e-5)  # half of the step in which they are written, and more
    assert cloud.version == f"LAS {version}"


@pytest.mark.parametrize("name", ["nuvem.las", "nuvem.laz"])
def test_las_that_is_cut_off(name: str, tmp_path: Path) -> None:
    sound = las(tmp_path / name, np.tile(POINTS, (50, 1)))
    for cut in (4, 100, 230, len(sound) // 2, len(sound) - 9):
        assert refused(tmp_path, sound[:cut], name).message in {"cloud.cut-off", "cloud.las-broken"}, cut


@pytest.mark.parametrize("name", ["nuvem.las", "nuvem.laz"])
def test_what_a_las_header_claims_is_not_believed(name: str, tmp_path: Path) -> None:
    sound = las(tmp_path / name, POINTS)

    def claims(at: int, form: str, value: int) -> bytes:
        size = struct.calcsize(form)
        return sound[:at] + struct.pack(form, value) + sound[at + size :]

    assert refused(tmp_path, claims(VLR_COUNT, "<I", 2**32 - 1), name).message == "cloud.las-broken"
    many = refused(tmp_path, claims(POINT_COUNT, "<I", 2**32 - 1), name).message
    assert many == ("cloud.cut-off" if name.endswith("las") else "cloud.too-many-points")
    sound = las(tmp_path / name, POINTS, "1.4")
    many = refused(tmp_path, claims(POINT_COUNT_14, "<Q", 10**12), name).message
    assert many == ("cloud.cut-off" if name.endswith("las") else "cloud.too-many-points")
    assert refused(tmp_path, claims(EVLR_COUNT_14, "<I", 2**32 - 1), name).message == "cloud.las-broken"


def test_las_without_the_extra_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = las(tmp_path / "nuvem.las", POINTS)
    monkeypatch.setitem(sys.modules, "laspy", None)
    error = refused(tmp_path, sound)
    assert error.message == "cloud.las-extra"
    assert "clouds" in str(error.fields["example"])


def test_a_cloud_is_read_in_a_child_within_bounds(tmp_path: Path) -> None:
    path = tmp_path / "nuvem.laz"
    las(path, POINTS)
    cloud = guarded(read_raw_cloud, path, load_profile("et-doc-foparq-a"), file=path.name, seconds=60, memory=2 * 10**9)
    assert cloud.points == pytest.approx(POINTS, abs=6e-5)
