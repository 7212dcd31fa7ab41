# SPDX-License-Identifier: MIT
"""The page in headless Chromium: quiet, offline, in both languages, with and without script, on screen and on paper."""

import io
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
import shapely
from pypdf import PdfReader

from foparq.findings.table import Findings
from foparq.model.drawing import Drawing
from foparq.report.page.page import write_page
from foparq.report.record import AuditRecord

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser
A4_PIXELS = 688  #: of an A4 sheet between its margins, 182 mm
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


def test_paper_shows_one_language_whole_and_no_controls(browser: "Browser", path: Path, rejected: AuditRecord) -> None:
    shown = Shown(browser, path)
    whole = shown.view()
    shown.page.locator(".tools:visible [data-do=in]").click()
    assert shown.view() != whole
    shown.page.emulate_media(media="print")
    shown.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert shown.page.locator("main:visible").count() == 1
    for control in (".strip", ".tools", "nav", ".toggle"):
        assert shown.page.locator(f"{control}:visible").count() == 0
    assert shown.page.locator(".method dl:visible").count() == len(rejected.quality.elements)
    assert shown.view() == whole
    assert shown.page.pdf(format="A4").startswith(b"%PDF")


def on_paper(
    browser: "Browser", path: Path, *, script: bool = True, every: bool = False, language: str = ""
) -> PdfReader:
    """The page as it is printed."""
    shown = Shown(browser, path, script=script, at="?print=all" if every and script else "")
    if language:
        shown.page.locator(f"label[for=show-{language}]").click()
    if every and not script:
        shown.page.locator("label.print-all:visible").click()
    return PdfReader(io.BytesIO(shown.page.pdf(format="A4", prefer_css_page_size=True)))


@pytest.fixture
def many(rejected: AuditRecord, drawing: Drawing, plant: Callable[..., Findings], tmp_path: Path) -> Path:
    """A page with 66 findings of one rule, strewn over the elevation."""
    places = np.random.default_rng(5).uniform((0, 0), (30, 9), (66, 2)).tolist()
    rows = [(f"{n:X}", "ESQUADRIA_PORTA", shapely.Point(x, 12.5, z), 0.004) for n, (x, z) in enumerate(places)]
    findings = plant(drawing, "TOP011", "undershoot", rows)
    write_page(replace(rejected, findings=findings, outcomes=()), tmp_path / "many.html")
    return tmp_path / "many.html"


def plates_on_paper(printed: PdfReader, word: str) -> dict[int, str]:
    """Text of the pages by the plates that stand on them."""
    found = {}
    for sheet in printed.pages:
        text = sheet.extract_text()
        found |= {int(number): text for number in re.findall(rf"{word} (\d+)\.", text)}
    return found


@pytest.mark.parametrize("script", [True, False])
def test_paper_holds_the_first_rows_and_all_on_request(browser: "Browser", many: Path, *, script: bool) -> None:
    texts = {
        every: "\n".join(sheet.extract_text() for sheet in on_paper(browser, many, script=script, every=every).pages)
        for every in (False, True)
    }
    ends = {every: len(re.findall(r"termina 4 mm\s+antes", text)) for every, text in texts.items()}
    assert ends == {False: 20, True: 66}
    assert "Impressas: as primeiras 20 de 66 linhas." in " ".join(texts[False].split())
    assert "Impressas: as primeiras" not in texts[True]
    assert "Camadas de fachada.dxf" in texts[True]
    assert "Camadas de fachada.dxf" not in texts[False]


def test_paper_has_plates_with_the_number_of_every_row(browser: "Browser", many: Path) -> None:
    printed = on_paper(browser, many, every=True, language="en")
    plates = plates_on_paper(printed, "Plate")
    assert len(plates) >= 4
    text = many.read_text(encoding="utf-8")
    english = text[text.index('<main lang="en">') :]
    rows = re.findall(
        r'<tr id="f-[^"]+--en">\s*<td class="n">.*?>(\d+)<.*?<td class="n paper">(\d+)</td>', english, re.DOTALL
    )
    assert len(rows) == 66
    for number, plate in rows:
        assert re.search(rf"(?<!\d){number}(?!\d)", plates[int(plate)]), f"number {number} on plate {plate}"
    lying = [sheet for sheet in printed.pages if sheet.mediabox.width > sheet.mediabox.height]
    assert len(lying) >= 2, "wide drawings on lying sheets"
    assert all("Plate" in sheet.extract_text() for sheet in lying)
    assert len(printed.pages) < 25


LONG_PATH = "/dados/entregas/2026/estacao-ferroviaria-de-presidente-prudente/fachada-norte-revisao-3.dxf"
LONG_LAYER = "MURO_DE_FECHO_DA_ESTACAO_FERROVIARIA_LADO_NORTE_PAVIMENTO_TERREO"


@pytest.mark.parametrize("layer", [LONG_LAYER, "X" * 240])
def test_nothing_is_wider_than_paper(
    browser: "Browser", rejected: AuditRecord, drawing: Drawing, plant: Callable[..., Findings], tmp_path: Path,
    layer: str,
) -> None:  # fmt: skip
    """What is wider makes the browser print everything smaller."""
    moved = replace(drawing, path=LONG_PATH)
    rows = [(f"{n:X}", layer, shapely.Point(n, 12.5, 3), 0.004) for n in range(25)]
    record = replace(
        rejected, findings=plant(moved, "TOP011", "undershoot", rows, other="31"),
        outcomes=tuple(replace(run, source=LONG_PATH, scope=f"{LONG_PATH}: {layer}") for run in rejected.outcomes),
        delivery=replace(
            rejected.delivery, parts=(moved,),
            sources=tuple(
                replace(source, path=LONG_PATH, skipped=tuple(replace(part, layer=layer) for part in source.skipped))
                for source in rejected.delivery.sources
            ),
        ),
    )  # fmt: skip
    write_page(record, tmp_path / "long.html")
    shown = Shown(browser, tmp_path / "long.html", width=A4_PIXELS, at="?print=all")
    for language in ("en", "pt-BR"):
        shown.page.emulate_media(media="screen")
        shown.page.locator(f"label[for=show-{language}]").click()
        shown.page.emulate_media(media="print")
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= A4_PIXELS


def test_layers_are_not_broken_on_paper(browser: "Browser", many: Path) -> None:
    text = "\n".join(sheet.extract_text() for sheet in on_paper(browser, many).pages)
    assert text.count("ESQUADRIA_PORTA") >= 40, "in the column and in the sentence of twenty rows"


def test_rows_unfold_without_script_and_by_their_address(browser: "Browser", many: Path) -> None:
    shown = Shown(browser, many, script=False)
    rows = shown.page.locator("main:visible .rows tbody tr:visible")
    assert rows.count() == 20
    shown.page.locator("main:visible label.button").click()
    assert rows.count() == 66
    shown.page.locator("main:visible label.button").click()
    assert rows.count() == 20
    last = re.findall(r'<tr id="(f-[^"]+)"', many.read_text(encoding="utf-8"))[65]
    for script in (True, False):
        assert Shown(browser, many, script=script, at=f"#{last}").page.locator(f"[id='{last}']").is_visible()


def test_a_telephone_shows_letters_that_can_be_read_and_targets_that_can_be_hit(browser: "Browser", many: Path) -> None:
    shown = Shown(browser, many, width=390)
    for language in ("en", "pt-BR"):
        shown.page.locator(f"label[for=show-{language}]").click()
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= 390
        small = shown.page.evaluate("""() => {
            const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), found = [];
            for (let node; node = texts.nextNode();) {
                const holder = node.parentElement, box = holder.getBoundingClientRect();
                if (!node.data.trim() || !box.width || holder.closest("svg, script, style, .unseen"))
                    continue;
                if (parseFloat(getComputedStyle(holder).fontSize) < 14) found.push(node.data.trim().slice(0, 40));
            }
            return found;
        }""")
        assert small == []
        low = shown.page.evaluate("""() => [...document.querySelectorAll(
            "label:not([for='']), button, summary, nav a, .to-mark")].filter((one) => {
                const box = one.getBoundingClientRect();
                return box.width && (box.height < 44 || box.width < 44);
            }).map((one) => one.textContent)""")
        assert low == []
    cards = shown.page.locator("main:visible .rows tbody tr:visible").all()
    for card in cards:
        for cell in card.locator("td:visible").all():
            box = cell.bounding_box()
            assert box is not None
            assert 0 <= box["x"] < box["x"] + box["width"] <= 390


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
