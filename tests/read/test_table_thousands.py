# SPDX-License-Identifier: MIT
"""12.345 is twelve and a bit, or twelve thousand: read only where something proves which."""

from pathlib import Path

import ezdxf
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foparq.errors import UnreadableError
from foparq.model.delivery import Delivery, SourceStatus
from foparq.profile.load import load_profile
from foparq.profile.manifest import Manifest, SurveySection
from foparq.read.delivery import read_delivery
from foparq.read.table.extent import Extent
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list
from foparq.report.words import LANGUAGES, Words

METRES = SurveySection(path="t.csv")
MILLIMETRES = SurveySection(path="t.csv", unit="mm")
HOUSE = Extent((40.037, 12.2046, 2.0158), (54.063, 12.2046, 9.0498))  #: 14.026 m by 7.034 m
AT_ORIGIN = Extent((0.0, 0.0, 0.0), (14.0, 0.0, 7.0))
POINTS = [(40.037, 12.205, 2.016), (54.063, 12.205, 2.016), (54.063, 12.205, 9.050), (46.261, 12.205, 5.034)]


def written(folder: Path, text: str) -> Path:
    path = folder / "t.csv"
    path.write_text(text, encoding="utf-8")
    return path


def checkpoints(points: list[tuple[float, ...]], number: str = "{:.3f}", error: float = 0.003) -> str:
    """A table of surveyed and delivered coordinates, separated by semicolons."""
    rows = [
        ";".join([f"P{n}", *(number.format(v + error * (-1) ** n) for v in point), *map(number.format, point)])
        for n, point in enumerate(points)
    ]
    return "id;x;y;z;xd;yd;zd\n" + "\n".join(rows) + "\n"


def distances(lengths: list[str]) -> str:
    return "id;measured\n" + "".join(f"D{n};{length}\n" for n, length in enumerate(lengths))


def fault(read: object, *args: object) -> UnreadableError:
    with pytest.raises(UnreadableError) as caught:
        read(*args)  # type: ignore[operator]
    assert all(Words(language).error(caught.value) for language in LANGUAGES)
    return caught.value


def test_both_readings_are_shown(tmp_path: Path) -> None:
    path = written(tmp_path, distances(["812", "40,037", "2,016"]))
    error = fault(read_distances, path, MILLIMETRES)
    assert error.message == "table.thousands"
    assert (error.fields["line"], error.fields["key"], error.fields["value"]) == (3, "measured", "40,037")
    for language in LANGUAGES:
        said = Words(language).error(error)
        assert "40,0370 mm" in said
        assert "40037 mm" in said


@pytest.mark.parametrize(
    "proof",
    ["0,812", "1234,5", "1234,567", "2,5", "2,0161", "0,000", "-0,812", "1,2e3", "012,345", "\u22120,512", ",512"],
)
def test_one_number_of_the_table_proves_all(tmp_path: Path, proof: str) -> None:
    text = f"id;x;y;z;xd;yd;zd\nP1;40,037;12,205;2,016;40,040;12,205;2,019\nP2;1;1;1;{proof};1;1\n"
    points = read_checkpoints(written(tmp_path, text), METRES)
    assert points.surveyed[0].tolist() == [40.037, 12.205, 2.016]
    assert points.delivered[0].tolist() == [40.04, 12.205, 2.019]


@pytest.mark.parametrize("neutral", ["812", "-7", "1500", "", "1e3"])
def test_a_number_without_a_sign_proves_nothing(tmp_path: Path, neutral: str) -> None:
    text = f"id;measured;delivered\nD1;40,037;40,040\nD2;5;{neutral}\n"
    assert fault(read_distances, written(tmp_path, text), METRES).message == "table.thousands"


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    st.lists(st.tuples(st.integers(1, 999), st.integers(0, 999)), min_size=1, max_size=8),
    st.sampled_from(".,"),
    st.sampled_from(["m", "mm", "cm", "ft"]),
)
def test_an_ambiguous_column_is_never_read(
    tmp_path_factory: pytest.TempPathFactory, numbers: list[tuple[int, int]], sign: str, unit: str
) -> None:
    path = written(tmp_path_factory.mktemp("t"), distances([f"{a}{sign}{b:03d}" for a, b in numbers]))
    section = SurveySection(path="t.csv", unit=unit)
    assert fault(read_distances, path, section).message == "table.thousands"


box = st.tuples(
    st.tuples(*[st.floats(-90, 90)] * 3), st.tuples(st.floats(4, 60), st.floats(0, 8), st.floats(3, 20))
).map(lambda b: Extent(b[0], tuple(np.add(b[0], b[1]).tolist())))
places = st.lists(st.tuples(*[st.floats(0, 1)] * 3), min_size=4, max_size=12)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(box, places)
def test_metres_with_millimetres_are_read_beside_their_drawing(
    tmp_path_factory: pytest.TempPathFactory, extent: Extent, where: list[tuple[float, float, float]]
) -> None:
    low, high = np.array(extent.low), np.array(extent.high)
    corners = np.array([[0, 0, 0], [1, 1, 1], *where])
    points = [tuple(point) for point in (low + corners * (high - low)).round(3).tolist()]
    path = written(tmp_path_factory.mktemp("t"), checkpoints(points).replace(".", ","))
    np.testing.assert_array_equal(read_checkpoints(path, METRES, [extent]).delivered, points)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(box, places, st.sampled_from(".,"))
def test_whole_millimetres_in_thousands_are_refused_beside_their_drawing(
    tmp_path_factory: pytest.TempPathFactory, extent: Extent, where: list[tuple[float, float, float]], sign: str
) -> None:
    low, high = np.array(extent.low), np.array(extent.high)
    millimetres = (1000 * (low + np.array([[0, 0, 0], [1, 1, 1], *where]) * (high - low))).round().astype(int).tolist()
    text = "id;x;y;z\n" + "".join(
        f"P{n};" + ";".join(f"{value:,}".replace(",", sign) for value in point) + "\n"
        for n, point in enumerate(millimetres)
    )
    error = fault(read_checkpoints, written(tmp_path_factory.mktemp("t"), text), MILLIMETRES, [extent])
    assert error.message == "table.thousands"


@pytest.mark.parametrize("extent", [HOUSE, AT_ORIGIN])
@pytest.mark.parametrize("sign", [".", ","])
def test_lengths_are_held_against_the_diagonal(tmp_path: Path, extent: Extent, sign: str) -> None:
    path = written(tmp_path, distances([f"2{sign}035", f"3{sign}414", f"8{sign}741"]))
    assert read_distances(path, METRES, [extent]).measured.tolist() == [2.035, 3.414, 8.741]
    assert fault(read_distances, path, MILLIMETRES, [extent]).message == "table.thousands"


def test_a_length_may_be_the_diagonal_itself(tmp_path: Path) -> None:
    triangle = Extent((1.0, 2.0, 2.0), (4.0, 2.0, 6.0))  # 3 m by 4 m
    read = read_distances(written(tmp_path, distances(["5.000"])), METRES, [triangle])
    assert read.measured.tolist() == [5.0]
    path = written(tmp_path, distances(["5.001"]))
    assert fault(read_distances, path, METRES, [triangle]).message == "table.thousands"


def test_lengths_beyond_every_drawing_prove_nothing(tmp_path: Path) -> None:
    path = written(tmp_path, distances(["242.035", "243.414", "248.741"]))
    assert fault(read_distances, path, METRES, [HOUSE]).message == "table.thousands"


def test_points_of_another_place_prove_nothing(tmp_path: Path) -> None:
    far = [tuple(v + 500 for v in point) for point in POINTS]
    assert fault(read_checkpoints, written(tmp_path, checkpoints(far)), METRES, [HOUSE]).message == "table.thousands"


def test_points_that_would_lie_in_one_spot_prove_nothing(tmp_path: Path) -> None:
    # 510 to 524 m in millimetres, 500 m off the drawing: as decimals they lie within 14 mm of each other in it.
    rows = "".join(f"P{n};{x};512,{n}05;50{n},016\n" for n, x in enumerate(["510,037", "524,063", "517,004"]))
    path = written(tmp_path, "id;x;y;z\n" + rows)
    for extent in (AT_ORIGIN, Extent((0.0, 0.0, 0.0), (14.0, 0.3, 7.0)), Extent((0.0, 0.0, 0.0), (14.0, 0.01, 7.0))):
        assert fault(read_checkpoints, path, MILLIMETRES, [extent]).message == "table.thousands"


def test_one_gross_error_does_not_make_a_table_ambiguous(tmp_path: Path) -> None:
    path = written(tmp_path, checkpoints([*POINTS, (340.037, 12.205, 2.016)]))
    assert len(read_checkpoints(path, METRES, [HOUSE]).id) == 5


def test_a_flat_drawing_proves_by_the_axis_it_shares(tmp_path: Path) -> None:
    # Drawn in x and y of the file, while the table gives depth as y and height as z.
    flat = Extent((40.0, 2.0, 0.0), (54.0, 9.0, 0.0))
    assert len(read_checkpoints(written(tmp_path, checkpoints(POINTS)), METRES, [flat]).id) == 4


@pytest.mark.parametrize("count", ["1.000", "12,000"])
def test_a_count_is_not_read_in_two_ways_either(tmp_path: Path, count: str) -> None:
    with pytest.raises(UnreadableError, match=r"table\.not-a-count"):
        read_feature_list(written(tmp_path, f"id;class;count\nA;tile;{count}\n"))
    assert read_feature_list(written(tmp_path, "id;class;count\nA;tile;1.00\n")).count.tolist() == [1]


def delivered(folder: Path, table: str, unit: str | None, *, stray: bool = False) -> Delivery:
    document = ezdxf.new("R2018", units=6 if unit else 0)
    corners = [(40.037, 12.2046, 2.0158), (54.063, 12.2046, 2.0158), (54.063, 12.2046, 9.0498)]
    space = document.modelspace()
    for _ in range(30):
        space.add_polyline3d(corners)
    if stray:
        space.add_line((4e4, 0, 0), (4e4, 1, 0))
    document.saveas(folder / "f.dxf")
    (folder / "p.csv").write_text(table, encoding="utf-8")
    manifest = Manifest.model_validate(
        {"drawing": [{"path": "f.dxf", "plane": "xz", "unit": unit}], "checkpoints": {"path": "p.csv"}}
    )
    delivery, crashes = read_delivery(folder, manifest, "", profile=load_profile("et-doc-foparq-a"), scale=50)
    assert crashes == ()
    return delivery


@pytest.mark.parametrize(("unit", "stray", "status"), [
    ("m", False, SourceStatus.READ), ("m", True, SourceStatus.READ), (None, False, SourceStatus.REFUSED),
])  # fmt: skip
def test_the_drawings_of_a_delivery_prove_its_tables(
    tmp_path: Path,
    unit: str | None,
    stray: bool,  # noqa: FBT001
    status: SourceStatus,
) -> None:
    delivery = delivered(tmp_path, checkpoints(POINTS), unit, stray=stray)
    source = next(source for source in delivery.sources if source.role == "checkpoints")
    assert source.status is status
    assert (delivery.checkpoints is None) == (status is SourceStatus.REFUSED)


@pytest.mark.parametrize("cell", ["#N/D", ""])
def test_the_number_that_an_error_shows_as_an_example_is_in_no_doubt(tmp_path: Path, cell: str) -> None:
    lengths = ["1,001", "2,002", cell]
    with pytest.raises(UnreadableError) as told:
        read_distances(written(tmp_path, distances(lengths)), METRES, extents=())
    shown = str(told.value.fields["example"]).replace(".", ",")
    assert read_distances(written(tmp_path, distances([*lengths[:2], shown])), METRES, extents=())
