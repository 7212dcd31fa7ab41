# SPDX-License-Identifier: MIT
"""The page in headless Chromium: quiet, offline, in both languages, with and without script, on screen and on paper."""

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
import shapely

from foparq.report.page.page import write_page
from foparq.report.record import AuditRecord

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser
CHROMIUM = Path("/usr/bin/chromium")


@pytest.fixture(scope="module")
def browser() -> Iterator["Browser"]:
    if not CHROMIUM.exists():
        pytest.skip(f"{CHROMIUM} is not installed: apt-get install chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        opened = driver.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox", "--disable-gpu"])
        yield opened
        opened.close()


class Shown:
    """A page that is open, and what it said and asked for."""

    def __init__(self, browser: "Browser", path: Path, *, script: bool = True, width: int = 1200, at: str = "") -> None:
        self.context = browser.new_context(java_script_enabled=script, viewport={"width": width, "height": 900})
        self.page: Page = self.context.new_page()
        self.said: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("dialog", lambda dialog: self.said.append(f"dialog {dialog.message}"))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(path.as_uri() + at)
        self.page.wait_for_load_state()

    def quiet(self) -> bool:
        """Nothing was said, and nothing but the file was asked for."""
        return not self.said and all(re.match(r"file:|data:image/png", url) for url in self.asked)

    def view(self) -> list[float]:
        """View box of the visible picture."""
        found = self.page.locator("svg.picture:visible").first.get_attribute("viewBox") or ""
        return [float(part) for part in found.split()]


@pytest.fixture
def path(rejected: AuditRecord, tmp_path: Path) -> Path:
    write_page(rejected, tmp_path / "report.html")
    return tmp_path / "report.html"


@pytest.mark.parametrize("width", [1200, 390])
def test_it_is_quiet_and_fits(browser: "Browser", path: Path, width: int) -> None:
    shown = Shown(browser, path, width=width)
    for language in ("en", "pt-BR"):
        shown.page.locator(f"label[for=show-{language}]").click()
        assert shown.page.locator("main:visible").get_attribute("lang") == language
        assert shown.page.evaluate("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    assert shown.quiet()


def test_results_are_seen_on_a_telephone_without_moving_the_table(browser: "Browser", path: Path) -> None:
    shown = Shown(browser, path, width=390)
    states = shown.page.locator("main:visible .elements .state").all()
    assert states
    for state in states:
        box = state.bounding_box()
        assert box is not None
        assert 0 <= box["x"] < box["x"] + box["width"] <= 390


def test_the_language_is_chosen_by_mouse_and_by_keyboard(browser: "Browser", path: Path) -> None:
    shown = Shown(browser, path)
    heading = shown.page.locator("h1:visible")
    assert heading.inner_text() == "Entrega não conforme em relação à especificação ET/DOC-FOPARQ, classe A."
    shown.page.locator("label[for=show-en]").click()
    assert heading.inner_text() == "The delivery does not conform to ET/DOC-FOPARQ, classe A."
    assert shown.page.evaluate("document.documentElement.lang") == "en"
    assert shown.page.title() == "Audit report: Estação Ferroviária de Presidente Prudente"
    shown.page.locator("#show-en").focus()
    shown.page.keyboard.press("ArrowLeft")
    assert heading.inner_text() == "Entrega não conforme em relação à especificação ET/DOC-FOPARQ, classe A."


def test_without_script_everything_is_there(browser: "Browser", path: Path, rejected: AuditRecord) -> None:
    shown = Shown(browser, path, script=False)
    assert (
        shown.page.locator("h1:visible").inner_text()
        == "Entrega não conforme em relação à especificação ET/DOC-FOPARQ, classe A."
    )
    shown.page.locator("label[for=show-en]").click()
    assert shown.page.locator("h1:visible").inner_text() == "The delivery does not conform to ET/DOC-FOPARQ, classe A."
    assert shown.page.locator(".picture:visible .mark").count() == np.sum(~shapely.is_empty(rejected.findings.sheet))
    mark = shown.page.locator(".picture:visible .mark.critical").bounding_box()
    assert mark is not None
    assert 5 < mark["width"] < 80
    assert not shown.page.locator(".tools").first.is_visible()
    assert shown.quiet()


def test_from_row_to_mark_and_back(browser: "Browser", path: Path) -> None:
    shown = Shown(browser, path)
    whole = shown.view()
    link = shown.page.locator("tr:has-text('JANELA') a.to-mark:visible").first
    number = link.inner_text()
    link.click()
    mark = shown.page.locator(".mark.here")
    assert mark.count() == 1
    assert mark.locator("text").text_content() == number
    near = shown.view()
    assert near[2] < whole[2] / 50
    assert float(mark.get_attribute("data-x") or 0) == pytest.approx(near[0] + near[2] / 2)
    assert shown.page.evaluate("document.activeElement.classList.contains('mark')")
    shown.page.keyboard.press("Enter")
    row = shown.page.locator("tr.here")
    assert row.locator("a.to-mark").inner_text() == number
    assert shown.quiet()


def test_the_address_of_a_finding_opens_it(browser: "Browser", path: Path) -> None:
    anchor = re.search(r'<tr id="(f-TOP011-[0-9a-f]+--en)"', path.read_text(encoding="utf-8"))
    assert anchor is not None
    shown = Shown(browser, path, at=f"#{anchor[1]}")
    assert shown.page.locator("main:visible").get_attribute("lang") == "en"
    assert shown.page.locator("tr.here").get_attribute("id") == anchor[1]


def test_buttons_wheel_and_drag_move_the_picture(browser: "Browser", path: Path) -> None:
    shown = Shown(browser, path)
    whole = shown.view()
    tools = shown.page.locator(".tools:visible")
    tools.locator("[data-do=in]").click()
    assert shown.view()[2] == pytest.approx(whole[2] / 2)
    box = shown.page.locator("svg.picture:visible").bounding_box()
    assert box is not None
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    before = shown.view()
    shown.page.mouse.move(*middle)
    shown.page.mouse.down()
    shown.page.mouse.move(middle[0] + 110, middle[1], steps=4)
    shown.page.mouse.up()
    assert shown.view()[0] == pytest.approx(before[0] - 110 * before[2] / box["width"], rel=0.02)
    shown.page.mouse.wheel(0, 100)
    assert shown.view()[2] == pytest.approx(before[2]), "the wheel alone scrolls the page"
    tools.locator("[data-do=whole]").click()
    assert shown.view() == whole
    assert shown.page.locator(".bar:visible text").text_content() == "5 m"
    assert shown.quiet()


def test_layers_can_be_hidden(browser: "Browser", path: Path) -> None:
    shown = Shown(browser, path)
    layers = shown.page.locator(".layers:visible")
    layers.locator("summary").click()
    uses = shown.page.locator("figure:visible .linework use[data-layer=PAREDE]")
    layers.locator("input[data-layer=PAREDE]").uncheck()
    assert uses.evaluate_all("found => found.every((use) => getComputedStyle(use).display === 'none')")
    layers.locator("input[data-layer=PAREDE]").check()
    assert uses.evaluate_all("found => found.every((use) => getComputedStyle(use).display !== 'none')")


def test_paper_shows_one_language_whole_and_no_controls(browser: "Browser", path: Path) -> None:
    shown = Shown(browser, path)
    whole = shown.view()
    shown.page.locator(".tools:visible [data-do=in]").click()
    assert shown.view() != whole
    shown.page.emulate_media(media="print")
    shown.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert shown.page.locator("main:visible").count() == 1
    for control in (".strip", ".tools", "nav", ".toggle"):
        assert shown.page.locator(f"{control}:visible").count() == 0
    assert shown.page.locator("details:visible dl").first.is_visible()
    assert shown.view() == whole
    assert shown.page.pdf(format="A4").startswith(b"%PDF")


def test_a_toned_picture_is_shown(
    browser: "Browser", rejected: AuditRecord, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("foparq.report.page.drawing.EXACT_ITEMS", 10)
    monkeypatch.setattr("foparq.report.page.drawing.EXACT_VERTICES", 10)
    write_page(replace(rejected, language="en"), tmp_path / "toned.html")
    shown = Shown(browser, tmp_path / "toned.html")
    picture = shown.page.locator("image").get_attribute("href") or ""
    size = shown.page.evaluate(
        "async (src) => { const i = new Image(); i.src = src; await i.decode(); return i.naturalWidth }", picture
    )
    assert size == 2000
    assert shown.quiet()
