# SPDX-License-Identifier: MIT
"""Small clouds of points in every format."""

from pathlib import Path

import laspy
import numpy as np
import pytest

from foparq.columns import Coordinates
from foparq.errors import InputError
from foparq.model.cloud import RawCloud
from foparq.profile.schema import LimitsSpec
from foparq.read.cloud.reader import read_cloud
from foparq.report.words import LANGUAGES, Words

#: a metre, half a millimetre, and a coordinate of a national grid
POINTS = np.array([[1.0, -0.0005, 7456789.123], [0.25, 3.0, 7456790.0], [-2.5, 1e-3, 7456788.5]])


def read(folder: Path, data: bytes | str, name: str = "cloud", **bounds: int) -> RawCloud:
    """The cloud of some bytes, as a file of a name that says nothing."""
    path = folder / name
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    return read_cloud(path, limits=LimitsSpec(**bounds))


def refused(folder: Path, data: bytes | str, name: str = "cloud", **bounds: int) -> InputError:
    """The error of a file that is not read; it has its sentence in both languages."""
    with pytest.raises(InputError) as caught:
        read(folder, data, name, **bounds)
    for language in LANGUAGES:
        assert Words(language).error(caught.value)
    return caught.value


def las(path: Path, points: Coordinates, version: str = "1.2") -> bytes:
    """LAS or LAZ, as the name says; coordinates to a tenth of a millimetre."""
    header = laspy.LasHeader(point_format=6 if version == "1.4" else 3, version=version)
    header.scales, header.offsets = np.full(3, 1e-4), np.floor(points.min(axis=0))
    made = laspy.LasData(header)
    made.x, made.y, made.z = points.T
    made.write(path)
    return path.read_bytes()


def ply(points: Coordinates, kind: str = "<f8", faces: int = 0) -> bytes:
    """Vertices and triangles, binary; ``kind`` is ``<f8``, ``<f4`` or ``>f8``."""
    order = "little" if kind[0] == "<" else "big"
    name = "double" if kind[-1] == "8" else "float"
    head = f"ply\nformat binary_{order}_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property {name} {axis}\n" for axis in "xyz") + "property uchar red\n"
    head += f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n" if faces else "end_header\n"
    rows = np.zeros(len(points), dtype=[("p", kind, 3), ("red", "u1")])
    rows["p"] = points
    corners = np.zeros(faces, dtype=[("n", "u1"), ("v", kind[0] + "i4", 3)])
    corners["n"], corners["v"] = 3, [0, 1, 2]
    return head.encode() + rows.tobytes() + corners.tobytes()
