# SPDX-License-Identifier: MIT
"""Meshes in headless Chromium: turned, flown to and back, with marks where they belong, and without WebGL."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.mesh.made import box
from tests.report.mesh_records import findings_at, mesh_of, point, record_of
from tests.report.test_page_browser import CHROMIUM, Shown, on_paper

from foparq.report.page.page import write_page
from foparq.report.record import AuditRecord

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.browser
SOFTWARE = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
#: of a box of 4 x 2 x 1: two corners of its front, a place on its front and one on its back
PLACES = [(0, 0, 0), (4, 0, 1), (1, 0, 0.5), (1, 2, 0.5)]
Point2 = tuple[float, float]


@pytest.fixture(scope="module")
def opener() -> Iterator[Callable[[list[str]], "Browser"]]:
    if not CHROMIUM.exists():
        pytest.skip(f"{CHROMIUM} is not installed: apt-get install chromium")
    from playwright.sync_api import sync_playwright

    opened: dict[str, Browser] = {}
    with sync_playwright() as driver:

        def opening(args: list[str]) -> "Browser":
            key = " ".join(args)
            if key not in opened:
                opened[key] = driver.chromium.launch(executable_path=str(CHROMIUM), args=args)
            return opened[key]

        yield opening
        for one in opened.values():
            one.close()


@pytest.fixture
def browser(opener: Callable[[list[str]], "Browser"]) -> "Browser":
    return opener(SOFTWARE)


@pytest.fixture
def path(rejected: AuditRecord, tmp_path: Path) -> Path:
    findings = findings_at([point(*place) for place in PLACES])
    write_page(record_of(rejected, [mesh_of(box(4, (4.0, 2.0, 1.0)))], findings), tmp_path / "mesh.html")
    return tmp_path / "mesh.html"


class Turned(Shown):
    """A page whose mesh can be turned."""

    def rest(self) -> None:
        """Wait until the camera stands, and marks know what hides them."""
        self.page.wait_for_function(
            """() => {
                const stage = [...document.querySelectorAll('.stage')].find((one) => one.clientWidth);
                return stage && stage.dataset.moving === '' && stage.querySelector('.mark');
            }"""
        )
        self.page.wait_for_timeout(400)

    def marks(self) -> dict[str, Point2]:
        """Middle of each mark on the screen, from the corner of the picture, by its number."""
        found: dict[str, Point2] = self.page.evaluate("""() => {
            const over = [...document.querySelectorAll('svg.over')].find((one) => one.clientWidth);
            const corner = over.getBoundingClientRect();
            return Object.fromEntries([...over.querySelectorAll('.mark')].map((mark) => {
                const box = mark.querySelector('.reach').getBoundingClientRect();
                return [mark.querySelector('text').textContent,
                    [box.x + box.width / 2 - corner.x, box.y + box.height / 2 - corner.y]];
            }));
        }""")
        return found

    def covered(self) -> list[float]:
        """Left, top, right and bottom of what is drawn on the canvas, in pixels of the page, and its share."""
        found: list[float] = self.page.evaluate("""() => {
            const canvas = [...document.querySelectorAll('.space canvas')].find((one) => one.clientWidth);
            const { width, height } = canvas, k = canvas.clientWidth / width;
            const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data;
            let [left, top, right, bottom, number] = [width, height, 0, 0, 0];
            for (let n = 0; n < width * height; n += 1) {
                if (pixels[4 * n] > 250 && pixels[4 * n + 1] > 250 && pixels[4 * n + 2] > 250) continue;
                const [x, y] = [n % width, Math.floor(n / width)];
                [left, top] = [Math.min(left, x), Math.min(top, y)];
                [right, bottom] = [Math.max(right, x + 1), Math.max(bottom, y + 1)];
                number += 1;
            }
            return [left * k, top * k, right * k, bottom * k, number / (width * height)];
        }""")
        return found

    def size(self) -> Point2:
        box = self.page.locator("svg.over:visible").bounding_box()
        assert box is not None
        return box["width"], box["height"]

    def numbers(self) -> list[str]:
        """Numbers of the rows of the places, in their order."""
        texts = {}
        for row in self.page.locator("main:visible .rows tbody tr").all():
            item = row.locator("td.id").inner_text()
            texts[item] = row.locator("a.to-mark").inner_text()
        return [texts[f"f{n}"] for n in range(len(PLACES))]


@pytest.mark.parametrize("width", [1200, 390])
def test_it_is_quiet_offline_and_fits_in_both_languages(browser: "Browser", path: Path, width: int) -> None:
    shown = Turned(browser, path, width=width)
    for language in ("pt-BR", "en"):
        shown.page.locator(f"label[for=show-{language}]").click()
        shown.page.locator(".stage:visible").scroll_into_view_if_needed()
        shown.rest()
        assert len(shown.marks()) == len(PLACES)
        assert shown.covered()[4] > 0.03
        assert shown.page.locator(".sides:visible, .still:visible").count() == 0
        assert shown.page.evaluate("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
        for button in shown.page.locator(".stage:visible button").all():
            box = button.bounding_box()
            assert box is not None
            assert width > 400 or min(box["width"], box["height"]) >= 43.9
    assert shown.quiet(), (shown.said, shown.asked)


def test_from_row_to_place_and_back(browser: "Browser", path: Path) -> None:
    shown = Turned(browser, path)
    shown.rest()
    before = shown.marks()
    numbers = shown.numbers()
    returning = shown.page.locator(".tools:visible [data-do=return]")
    assert returning.is_disabled()
    link = shown.page.locator(f"main:visible a.to-mark:text-is('{numbers[2]}')")
    link.click()
    shown.rest()
    width, height = shown.size()
    near = shown.marks()
    assert near[numbers[2]] == pytest.approx((width / 2, height / 2), abs=1.5)
    apart = [abs(marks[numbers[0]][0] - marks[numbers[1]][0]) for marks in (before, near)]
    assert apart[1] > 5 * apart[0], "it is seen larger"
    mark = shown.page.locator(".mark.here")
    assert mark.count() == 1
    assert mark.locator("text").text_content() == numbers[2]
    assert mark.evaluate("one => one === document.activeElement")
    returning.click()
    shown.rest()
    for number, place in shown.marks().items():
        assert place == pytest.approx(before[number], abs=1)
    assert returning.is_disabled()
    shown.page.locator(f".over:visible .mark:has(text:text-is('{numbers[0]}'))").click()
    row = shown.page.locator("tr.here")
    assert row.locator("a.to-mark").inner_text() == numbers[0]
    assert row.is_visible()
    assert shown.quiet()


def test_what_lies_behind_is_lighter_until_one_goes_there(browser: "Browser", path: Path) -> None:
    shown = Turned(browser, path)
    shown.rest()
    front, back = shown.numbers()[2:]

    def behind() -> set[str]:
        found = shown.page.locator(".over:visible .mark.behind text").all_text_contents()
        return set(found)

    assert back in behind()
    assert front not in behind()
    shown.page.locator(f"main:visible a.to-mark:text-is('{back}')").click()
    shown.rest()
    assert back not in behind(), "the camera goes round"
    assert front in behind()
    opacity = shown.page.locator(f".over:visible .mark:has(text:text-is('{front}'))").evaluate(
        "one => Number(getComputedStyle(one).opacity)"
    )
    assert opacity < 0.6


def test_the_keyboard_turns_moves_zooms_and_goes_back(browser: "Browser", path: Path) -> None:
    shown = Turned(browser, path)
    shown.rest()
    begin = shown.marks()
    low, high = shown.numbers()[:2]
    width, height = shown.size()
    shown.page.locator(".stage:visible").focus()

    def press(*keys: str) -> dict[str, Point2]:
        for key in keys:
            shown.page.keyboard.press(key)
        shown.rest()
        return shown.marks()

    larger = press("+")
    assert larger[high][0] - larger[low][0] == pytest.approx((begin[high][0] - begin[low][0]) / 0.6, rel=0.01)
    assert press("-")[low] == pytest.approx(begin[low], abs=1)
    moved = press("Shift+ArrowRight")
    assert (moved[low][0] - begin[low][0], moved[low][1] - begin[low][1]) == pytest.approx((-30, 0), abs=1)
    assert press("Shift+ArrowLeft")[low] == pytest.approx(begin[low], abs=1)
    turned = press("ArrowRight")
    assert turned[low] != pytest.approx(begin[low], abs=5)
    assert press("0")[low] == pytest.approx(begin[low], abs=1)
    above = press("5")
    assert above[low][1] == pytest.approx(above[high][1], abs=1), "seen from the top both corners lie on one line"
    assert press("Escape")[low] == pytest.approx(begin[low], abs=1)
    assert shown.size() == (width, height)


def test_a_drag_turns_and_chooses_no_mark(browser: "Browser", path: Path) -> None:
    shown = Turned(browser, path)
    shown.page.locator(".over:visible").scroll_into_view_if_needed()
    shown.rest()
    begin = shown.marks()
    box = shown.page.locator(".over:visible").bounding_box()
    assert box is not None
    x, y = begin[shown.numbers()[2]]
    shown.page.mouse.move(box["x"] + x, box["y"] + y)
    shown.page.mouse.down()
    shown.page.mouse.move(box["x"] + x + 80, box["y"] + y + 5, steps=4)
    shown.page.mouse.up()
    shown.rest()
    assert shown.page.locator(".here").count() == 0
    # Turned to the right, what is in front goes to the right.
    assert shown.marks()[shown.numbers()[2]][0] > x + 5


@pytest.mark.parametrize("script", [True, False])
def test_without_webgl_or_script_six_pictures_are_shown(
    opener: Callable[[list[str]], "Browser"], path: Path, *, script: bool
) -> None:
    without = opener(["--no-sandbox", "--disable-gpu", "--disable-3d-apis"])
    shown = Shown(without, path, script=script)
    assert shown.page.locator(".side:visible svg").count() == 6
    assert shown.page.locator(".stage:visible").count() == 0
    assert "six fixed pictures" in shown.page.locator(".still:visible").inner_text()
    link = shown.page.locator("main:visible a.to-mark").first
    link.click()
    assert shown.page.evaluate("location.hash" if script else "1")
    assert shown.page.locator("figure.solid:visible").bounding_box()
    shown.page.locator("label[for=show-pt-BR]").click()
    assert shown.page.locator(".side:visible figcaption").all_inner_texts() == [
        "Frente", "Trás", "Esquerda", "Direita", "Topo", "Base",
    ]  # fmt: skip
    assert shown.quiet(), shown.said


def test_paper_bears_the_six_pictures_and_no_canvas(browser: "Browser", path: Path) -> None:
    shown = Turned(browser, path)
    shown.rest()
    shown.page.emulate_media(media="print")
    assert shown.page.locator(".side:visible svg").count() == 6
    assert shown.page.locator(".stage:visible, .still:visible").count() == 0
    text = "\n".join(sheet.extract_text() for sheet in on_paper(browser, path).pages)
    for name in ("Front", "Back", "Left", "Right", "Top", "Bottom"):
        assert name in text
    assert "50 cm" in text


def test_an_address_of_a_mark_is_flown_to(browser: "Browser", path: Path) -> None:
    shown = Turned(browser, path)
    shown.rest()
    anchor = shown.page.locator(".over:visible .mark").first.get_attribute("id")
    again = Turned(browser, path, at=f"#{anchor}")
    again.rest()
    assert again.page.locator(".mark.here").get_attribute("id") == anchor
    number = again.page.locator(".mark.here text").text_content() or ""
    width, height = again.size()
    assert again.marks()[number] == pytest.approx((width / 2, height / 2), abs=1.5)
