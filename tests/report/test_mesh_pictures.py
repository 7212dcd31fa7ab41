# SPDX-License-Identifier: MIT
"""Six fixed pictures of a mesh: silhouettes of known area, what covers what, and where marks stand."""

import base64

import numpy as np
import pytest
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import GEOREFERENCED, box, sphere
from tests.report.mesh_records import findings_at, listed, mesh_of, pixels_of, point

from foparq.report.page.meshes.figure import MeshFigure, mesh_figures
from foparq.report.page.meshes.pictures import SidePicture, pictures_of
from foparq.report.page.meshes.raster import NOTHING, seen
from foparq.report.page.meshes.sides import SIDES, side_frame
from foparq.report.page.meshes.surface import shown_of
from foparq.report.page.png import palette_png
from foparq.report.record import AuditRecord

WHITE = (255, 255, 255)
RED = (0xC1, 0x12, 0x1F)
PALE_RED = (0xDA, 0xA0, 0xA5)  #: the same with three fifths of white, as a test of hue only


def covered(picture: SidePicture) -> np.ndarray:
    on: np.ndarray = (pixels_of(picture.image) != WHITE).any(axis=2)
    return on


def bluish(picture: SidePicture) -> np.ndarray:
    """Pixels of the inner side: more blue than red by far."""
    colours = pixels_of(picture.image).astype(int)
    on: np.ndarray = colours[..., 2] - colours[..., 0] > 30
    return on


def figure_of(base: AuditRecord, surface: Mesh, *places: tuple[float, float, float], **stated: str) -> MeshFigure:
    part = mesh_of(surface, **stated)
    return mesh_figures((part,), listed(base, [part], findings_at([point(*place) for place in places])))[0]


def by_side(figure: MeshFigure) -> dict[str, SidePicture]:
    return {picture.side: picture for picture in figure.pictures}


def numbers(picture: SidePicture) -> set[str]:
    return {label.text for ink in (picture.ink, picture.hidden) for label in ink.labels}


# --- which triangle is seen ------------------------------------------------------------------------------------------


def test_a_triangle_covers_its_area() -> None:
    corners = np.array([[(10.3, 5.2, 0), (190.7, 33.9, 0), (77.1, 148.6, 0)]])
    true = abs((190.7 - 10.3) * (148.6 - 5.2) - (33.9 - 5.2) * (77.1 - 10.3)) / 2
    for turned in (corners, corners[:, ::-1], corners[:, [1, 2, 0]]):
        on = seen(turned, 200, 160).triangle != NOTHING
        assert on.sum() == pytest.approx(true, abs=250)  # half a pixel along its sides, on the average much less
        assert on.sum() == pytest.approx(true, rel=0.005)
    on = seen(corners, 200, 160).triangle == 0
    line, column = np.nonzero(on)
    middle = corners[0, :, :2].mean(axis=0)
    assert (column.mean() + 0.5, line.mean() + 0.5) == pytest.approx(middle, abs=0.3)


def test_pixels_whose_centres_lie_on_a_side_are_covered_and_two_halves_leave_no_gap() -> None:
    square = np.array(
        [[(10.5, 10.5, 0), (20.5, 10.5, 0), (20.5, 20.5, 0)], [(10.5, 10.5, 0), (20.5, 20.5, 0), (10.5, 20.5, 0)]]
    )
    on = seen(square, 40, 40).triangle != NOTHING
    expected = np.zeros((40, 40), dtype=bool)
    expected[10:21, 10:21] = True
    assert (on == expected).all()


def test_the_nearer_triangle_is_seen_also_where_two_cross() -> None:
    # One slopes through the other: to the left it lies behind, to the right before.
    level = [(0, 0, 5.0), (100, 0, 5.0), (50, 100, 5.0)]
    slope = [(0, 0, 0.0), (100, 0, 10.0), (50, 100, 5.0)]
    for order in ([level, slope], [slope, level]):
        found = seen(np.array(order, dtype=float), 100, 100)
        top = found.triangle[5]
        assert (order[top[20]], order[top[80]]) == (level, slope)
        assert found.depth[5, 80] == pytest.approx(8.05, abs=0.01)
        assert found.depth[5, 20] == pytest.approx(5.0, abs=1e-6)


def test_a_heap_of_large_triangles_makes_a_coarser_picture_of_the_same_shape(monkeypatch: pytest.MonkeyPatch) -> None:
    disc = np.linspace(0, 2 * np.pi, 401)
    edge = np.stack([200 + 150 * np.cos(disc), 200 + 150 * np.sin(disc), np.zeros(401)], axis=1)
    fans = np.stack([np.broadcast_to((200, 200, 1.0), (400, 3)), edge[:-1], edge[1:]], axis=1)
    fine = (seen(fans, 400, 400).triangle != NOTHING).sum()
    monkeypatch.setattr("foparq.report.page.meshes.raster._MOST", 20_000)
    coarse = seen(fans, 400, 400)
    assert coarse.triangle.shape == coarse.depth.shape == (400, 400)
    assert (coarse.triangle[::4, ::4] == coarse.triangle[3::4, 3::4]).all()
    assert fine == pytest.approx(np.pi * 150**2, rel=0.002)
    assert (coarse.triangle != NOTHING).sum() == pytest.approx(np.pi * 150**2, rel=0.05)


@pytest.mark.parametrize(
    "corners",
    [np.empty((0, 3, 3)), np.array([[(5.0, 5, 1)] * 3]), np.array([[(-9.0, -9, 0), (-2, -9, 0), (-2, -3, 0)]])],
)
def test_nothing_to_be_seen(corners: np.ndarray) -> None:
    found = seen(corners, 12, 8)
    assert (found.triangle == NOTHING).all()
    assert (found.depth == -np.inf).all()


# --- the six sides ---------------------------------------------------------------------------------------------------


def test_a_box_has_the_areas_of_its_sides(rejected: AuditRecord) -> None:
    """The longest side is 640 pixels: 4, 2 and 1 units are 640, 320 and 160."""
    surface = box(4, (4.0, 2.0, 1.0))
    figure = figure_of(rejected, surface._replace(points=surface.points + GEOREFERENCED))
    assert tuple(picture.side for picture in figure.pictures) == SIDES
    size = {"front": (640, 160), "left": (320, 160), "top": (640, 320)}
    size |= {"back": size["front"], "right": size["left"], "bottom": size["top"]}
    for picture in figure.pictures:
        across, down = size[picture.side]
        on = covered(picture)
        lines, columns = np.flatnonzero(on.any(axis=1)), np.flatnonzero(on.any(axis=0))
        assert on.sum() == pytest.approx(across * down, abs=2 * (across + down))
        assert (np.ptp(columns) + 1, np.ptp(lines) + 1) == pytest.approx((across, down), abs=1)
        assert on[lines[0] : lines[-1] + 1, columns[0] : columns[-1] + 1].all()
        assert not bluish(picture).any()


def test_a_sphere_is_a_disc_from_every_side_lighter_above(rejected: AuditRecord) -> None:
    for picture in figure_of(rejected, sphere(5)).pictures:
        assert covered(picture).sum() == pytest.approx(np.pi / 4 * 640**2, rel=0.003)
        grey = pixels_of(picture.image).sum(axis=2)
        middle = picture.width // 2
        assert grey[picture.height // 4, middle] > grey[3 * picture.height // 4, middle]


def test_a_hole_of_a_sphere_is_seen_from_its_side_only(rejected: AuditRecord) -> None:
    """Faces within 30 degrees of -y are missing: a disc of half the radius, through which the inner side is seen."""
    surface = sphere(6)
    faces = surface.corners.reshape(-1, 3)
    kept = faces[surface.points[faces].mean(axis=1)[:, 1] > -np.cos(np.pi / 6)]
    pictures = by_side(figure_of(rejected, mesh(surface.points, kept.tolist())))
    assert bluish(pictures["front"]).sum() == pytest.approx(np.pi * (640 / 2 / 2) ** 2, rel=0.03)
    for side in set(SIDES) - {"front"}:
        # From beside, the rim is seen edge on.
        assert bluish(pictures[side]).sum() < 600
    assert covered(pictures["front"]).sum() == pytest.approx(np.pi / 4 * 640**2, rel=0.01)


#: standing on each side with z up: what lies at the right hand, and upward
HANDS = {
    "front": ("+x", "+z"), "back": ("-x", "+z"), "left": ("-y", "+z"), "right": ("+y", "+z"),
    "top": ("+x", "+y"), "bottom": ("+x", "-y"),
}  # fmt: skip
#: the same with y up, as in glTF, whose front looks along +z
HANDS_Y = {
    "front": ("+x", "+y"), "back": ("-x", "+y"), "left": ("+z", "+y"), "right": ("-z", "+y"),
    "top": ("+x", "-z"), "bottom": ("+x", "+z"),
}  # fmt: skip


@pytest.mark.parametrize(("up", "hands"), [("z", HANDS), ("y", HANDS_Y)])
def test_right_and_up_are_where_one_stands(up: str, hands: dict[str, tuple[str, str]]) -> None:
    for side, told in hands.items():
        right, upward, toward = side_frame(up, side)
        axes = {
            f"{sign}{name}": row
            for name, unit in zip("xyz", np.eye(3), strict=True)
            for sign, row in (("+", unit), ("-", -unit))
        }
        assert (right.tolist(), upward.tolist()) == tuple(axes[name].tolist() for name in told)
        assert np.cross(right, upward).tolist() == toward.tolist()


@pytest.mark.parametrize("up", "xyz")
def test_opposite_sides_look_at_each_other_and_all_axes_are_seen(up: str) -> None:
    toward = {side: side_frame(up, side)[2] for side in SIDES}
    for one, other in (("front", "back"), ("left", "right"), ("top", "bottom")):
        assert (toward[one] == -toward[other]).all()
    assert np.linalg.matrix_rank([toward["front"], toward["right"], toward["top"]]) == 3
    assert toward["top"].tolist() == np.eye(3)["xyz".index(up)].tolist()
    assert all(np.linalg.det(side_frame(up, side)) == pytest.approx(1) for side in SIDES)


# --- findings --------------------------------------------------------------------------------------------------------


def test_findings_are_red_where_they_are_and_paler_where_they_are_hidden(rejected: AuditRecord) -> None:
    import shapely

    part = mesh_of(box(8))
    line = shapely.LineString([(0.25, 0, 0.5), (0.75, 0, 0.5)])  # on the front
    figure = mesh_figures((part,), listed(rejected, [part], findings_at([line])))[0]
    pictures = by_side(figure)
    front = pixels_of(pictures["front"].image)
    red = (front == RED).all(axis=2)
    lines, columns = np.nonzero(red)
    assert np.ptp(columns) == pytest.approx(320, abs=2)
    assert np.ptp(lines) <= 2
    assert abs(lines.mean() - front.shape[0] / 2) < 2
    back = pixels_of(pictures["back"].image)
    assert not (back == RED).all(axis=2).any()
    hue = back.astype(int)
    assert ((hue[..., 0] - hue[..., 1]) > 40).sum() == pytest.approx(red.sum(), rel=0.05)


def test_a_face_is_filled(rejected: AuditRecord) -> None:
    import shapely

    part = mesh_of(box(2))
    face = shapely.Polygon([(0.1, 0, 0.1), (0.9, 0, 0.1), (0.1, 0, 0.9)])
    figure = mesh_figures((part,), listed(rejected, [part], findings_at([face])))[0]
    red = (pixels_of(by_side(figure)["front"].image) == RED).all(axis=2)
    side = 0.8 * 640
    outline = (2 + 2**0.5) * side  # two pixels wide, half of them outside
    assert side**2 / 2 - 10 <= red.sum() <= side**2 / 2 + 1.5 * outline


def test_a_number_stands_where_its_mark_is_seen(rejected: AuditRecord) -> None:
    """1 lies in front, 2 behind, 3 in the middle of the box: seen from nowhere, it stands on the first picture."""
    figure = figure_of(rejected, box(8), (0.5, 0, 0.5), (0.5, 1, 0.5), (0.5, 0.5, 0.5))
    names = {
        tuple(np.round(place, 3)): str(n)
        for place, n in zip(figure.marks.place.tolist(), figure.marks.number.tolist(), strict=True)
    }
    one, two, three = names[0.5, 0, 0.5], names[0.5, 1, 0.5], names[0.5, 0.5, 0.5]
    borne = {side: numbers(picture) for side, picture in by_side(figure).items()}
    assert (borne["front"], borne["back"]) == ({one, three}, {two})
    # From the other sides both lie on the edge, and are seen; what lies within is not numbered twice.
    assert all(three not in borne[side] for side in set(SIDES) - {"front"})
    assert by_side(figure)["front"].hidden.signs[0][0] == "major"


def test_marks_stand_at_the_place_of_the_finding(rejected: AuditRecord) -> None:
    """Corners of a box seen from the front are corners of what is covered."""
    figure = figure_of(rejected, box(4, (4.0, 2.0, 1.0)), (0, 0, 0), (4, 0, 1))
    front = by_side(figure)["front"]
    on = covered(front)
    lines, columns = np.flatnonzero(on.any(axis=1)), np.flatnonzero(on.any(axis=0))
    ((kind, path),) = front.ink.signs
    assert kind == "major"
    # Signs of major findings are triangles: their tips, 1.5 mm above the place.
    tips = sorted(tuple(map(int, part.split("l")[0].split())) for part in path.split("M")[1:])
    lift = 1.5 * 10 * 680 / 84
    corners = [(columns[0], lines[-1] + 1), (columns[-1] + 1, lines[0])]
    for (x, y), (column, line) in zip(tips, corners, strict=True):
        assert (x / 10, (y + lift) / 10) == pytest.approx((column, line), abs=8)


def test_too_many_numbers_are_counted(rejected: AuditRecord) -> None:
    from foparq.report.page.meshes.figure import mesh_view
    from foparq.report.words import Words

    places = np.random.default_rng(2).uniform(0.1, 0.9, (300, 3))
    places[:, 1] = 0
    figure = figure_of(rejected, box(4), *places.tolist())
    front = by_side(figure)["front"]
    assert len(front.ink.labels) == 40
    borne = set().union(*(numbers(picture) for picture in figure.pictures))
    told = mesh_view(Words("en"), figure).on_paper
    assert f": {300 - len(borne)}." in told
    assert len(borne) < 300


def test_no_triangle_no_picture() -> None:
    shown = shown_of(mesh_of(mesh([], [])), 10)
    assert pictures_of(shown, "z", None, None) == ()  # type: ignore[arg-type]


def test_a_palette_is_written_as_it_is() -> None:
    palette = np.array([(1, 2, 3), (250, 0, 7)], dtype=np.uint8)
    rows = np.array([[0, 1, 1], [1, 0, 0]], dtype=np.uint8)
    image = base64.b64encode(palette_png(rows, palette)).decode("ascii")
    assert (pixels_of(image) == palette[rows]).all()
