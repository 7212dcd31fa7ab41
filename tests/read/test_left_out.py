# SPDX-License-Identifier: MIT
"""Layers that are not checked are named with their items, and nobody hides a drawing that way."""

from pathlib import Path

import ezdxf
import pytest

from foparq.audit import Audit, audit, check_files
from foparq.evaluate.quality import QualityReport, Verdict
from foparq.findings.outcome import Outcome
from foparq.profile.load import load_profile
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words

PROFILE = load_profile("et-doc-foparq-b")


def draw(path: Path, *, unplotted: str = "", axes: int = 2, axis: str = "EIXO-1") -> None:
    """A frame, a post that stops 6.3 mm short of an axis and of nothing else, and further axes far away."""
    document = ezdxf.new("R2010", units=6)
    for name in ("PAREDE", axis):
        if name not in document.layers:
            document.layers.add(name, plot=name != unplotted)
    space = document.modelspace()
    corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    for n, corner in enumerate(corners):
        space.add_line(corner, corners[(n + 1) % 4], dxfattribs={"layer": "PAREDE"})
    space.add_line((1, 1.0063), (1, 3), dxfattribs={"layer": "PAREDE"})
    space.add_line((0.5, 1), (1.5, 1), dxfattribs={"layer": axis})
    for n in range(axes - 1):
        space.add_line((10 + n, 0), (10 + n, 2), dxfattribs={"layer": axis})
    document.saveas(path)


def check(path: Path, *ignored: str) -> Audit:
    return check_files(
        [path], profile=PROFILE, scale=50.0, unit=None, plane=None, areas=(), ignore_layers=ignored, language="en"
    )


def said(quality: QualityReport) -> str:
    for language in ("pt-BR", "en"):
        text = " ".join(reason_sentence(Words(language), reason) for reason in (*quality.why, *quality.remarks))
    return text


def ran(done: Audit, name: str) -> Outcome:
    return next(outcome for outcome in done.record.outcomes if outcome.name == name)


def test_what_is_left_out_is_neither_judged_nor_met(tmp_path: Path) -> None:
    draw(tmp_path / "a.dxf")
    every, part = check(tmp_path / "a.dxf"), check(tmp_path / "a.dxf", "eixo*")
    assert [ran(one, "undershoot").found for one in (every, part)] == [1, 0]
    assert [ran(one, "undershoot").checked for one in (every, part)] == [7, 5]
    assert (every.record.quality.verdict, part.record.quality.verdict) == (Verdict.REJECTED, Verdict.ACCEPTED)
    assert "2 items" in said(part.record.quality)
    assert "EIXO-1 (2)" in said(part.record.quality)
    (skipped,) = part.record.delivery.sources[0].skipped
    assert (skipped.reason, skipped.layer, skipped.count) == ("ignored-layer", "EIXO-1", 2)
    places = part.record.findings.place[part.record.findings.name == "free-end"]
    assert [1.0, 1.0063, 0.0] in places.tolist(), "an end that rests on what is left out only is free"


@pytest.mark.parametrize("axis", ["EIXO-1", "Defpoints"])
def test_what_does_not_plot_is_left_out_by_default(tmp_path: Path, axis: str) -> None:
    draw(tmp_path / "a.dxf", unplotted=axis if axis != "Defpoints" else "", axis=axis)
    done = check(tmp_path / "a.dxf")
    assert (done.record.quality.verdict, ran(done, "undershoot").checked) == (Verdict.ACCEPTED, 5)
    assert "do not plot" in said(done.record.quality)
    assert f"{axis} (2)" in said(done.record.quality)


@pytest.mark.parametrize(("ignored", "unplotted"), [(("PAREDE",), ""), ((), "PAREDE"), (("*",), "")])
def test_most_of_the_linework_is_never_left_out_in_silence(
    tmp_path: Path, ignored: tuple[str, ...], unplotted: str
) -> None:
    draw(tmp_path / "a.dxf", unplotted=unplotted)
    quality = check(tmp_path / "a.dxf", *ignored).record.quality
    assert quality.verdict is Verdict.UNDECIDED
    assert "PAREDE" in said(quality)


@pytest.mark.parametrize(("axes", "verdict"), [(5, Verdict.ACCEPTED), (6, Verdict.UNDECIDED)])
def test_half_of_the_items_may_be_left_out(tmp_path: Path, axes: int, verdict: Verdict) -> None:
    """Five items stay; half of all is no more than half."""
    draw(tmp_path / "a.dxf", axes=axes)
    assert check(tmp_path / "a.dxf", "EIXO*").record.quality.verdict is verdict


def deliver(folder: Path, drawing: str) -> Audit:
    draw(folder / "a.dxf")
    (folder / "delivery.toml").write_text(
        '[delivery]\nprofile = "et-doc-foparq-b"\nscale = "1:50"\n'
        f'[[drawing]]\npath = "a.dxf"\nunit = "m"\n{drawing}\n',
        encoding="utf-8",
    )
    return audit(folder, language="en")


@pytest.mark.parametrize(("said_too", "status"), [
    ("", "pass"), ('classes = { "EIXO*" = "janela" }', "undecided"), ('areas = ["EIXO-1"]', "undecided"),
    ('classes = { "PAREDE" = "janela" }', "pass"),
])  # fmt: skip
def test_a_layer_that_the_manifest_calls_a_feature_is_not_left_out(tmp_path: Path, said_too: str, status: str) -> None:
    done = deliver(tmp_path, f'ignore_layers = ["EIXO*"]\n{said_too}')
    element = next(one for one in done.record.quality.elements if one.id == "Q3")
    assert element.status.value == status
    assert "EIXO-1 (2)" in said(done.record.quality)


def test_an_unplotted_layer_that_shows_a_feature_is_checked(tmp_path: Path) -> None:
    draw(tmp_path / "b.dxf", unplotted="EIXO-1")
    done = check_files(
        [tmp_path / "b.dxf"], profile=PROFILE, scale=50.0, unit=None, plane=None, areas=("EIXO*",), language="en"
    )
    assert ran(done, "undershoot").checked == 7


@pytest.mark.parametrize(
    "bind",
    ['[["PAREDE", "EIXO*"]]', '["PAREDE", "EIXO*"]', '["*"]', '[["*"]]'],
    ids=["group", "flat", "all", "group all"],
)
def test_a_manifest_binds(tmp_path: Path, bind: str) -> None:
    done = deliver(tmp_path, f"bind = {bind}")
    (drawing,) = done.record.delivery.drawings
    assert drawing.bind in {(("PAREDE", "EIXO*"),), (("*",),)}
