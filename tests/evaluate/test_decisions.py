# SPDX-License-Identifier: MIT
"""A person decides how many features are drawn: within what the linework allows, by name, and for all to read."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from tests.check.windows import PLACES, counted, drawing, frame, pane
from tests.evaluate.deliveries import drawn, judge, listed, messages, profile, spec

from foparq.audit import audit
from foparq.errors import ManifestError
from foparq.evaluate.decisions import wrong_decision
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import ElementStatus, QualityReport, Verdict
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.statements import Decision
from foparq.profile.load import load_manifest
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
Q4, Q5 = spec("commission", id="Q4"), spec("omission", id="Q5")
#: twenty windows, or forty: each frame holds another
FRAMES = drawing([frame(*place, inset) for place in PLACES for inset in (0.0, 0.06)])


def decision(counted: int, **changes: Any) -> Decision:
    said = {"element": "Q5", "feature_class": "window", "facade": "N", "by": "A. Souza", "reason": "counted by hand"}
    return Decision(**{**said, "counted": counted, **changes})


def delivery(required: int, *decisions: Decision) -> Delivery:
    return replace(drawn(FRAMES, features=listed(("window", "N", required))), decisions=decisions)


def judged(required: int, *decisions: Decision) -> QualityReport:
    return judge(Q4, Q5, delivery=delivery(required, *decisions), counts=counted(FRAMES))


def wrong(required: int, *decisions: Decision) -> tuple[str, dict[str, object]]:
    evidence = Evidence(
        delivery=delivery(required, *decisions), outcomes=(), counts=counted(FRAMES), scale=50.0, faults=0
    )
    found = wrong_decision(profile(Q4, Q5), evidence)
    return (found.kind, dict(found.fields)) if found else ("", {})


def test_without_a_decision_the_reason_says_what_to_write() -> None:
    commission, omission = judged(30).elements
    assert (commission.status, omission.status) == (UNDECIDED, UNDECIDED)
    asked = dict(omission.why[0].fields)
    assert (asked["classes"], asked["missing"], asked["least"]) == (["window / N: 20–40"], 10, 0)
    assert asked["ask"] == '[[decision]] element = "Q5", class = "window", facade = "N", counted, by, reason'


@pytest.mark.parametrize(
    ("counted", "statuses", "missing", "surplus"),
    [(20, (PASS, FAIL), 10, 0), (29, (PASS, PASS), 1, 0), (30, (PASS, PASS), 0, 0), (31, (FAIL, PASS), 0, 1)],
)
def test_what_was_counted_decides_both_elements(counted: int, statuses: tuple, missing: int, surplus: int) -> None:
    report = judged(30, decision(counted))
    commission, omission = report.elements
    assert (commission.status, omission.status) == statuses
    assert (omission.value, commission.value) == (missing / 30, surplus / 30)
    for element in report.elements:
        (made,) = (reason for reason in element.why if reason.message == "features.decided")
        said = dict(made.fields)
        assert (said["by"], said["reason"], said["counted"]) == ("A. Souza", "counted by hand", counted)
        assert (said["low"], said["high"]) == (20, 40)
    told = [reason.message for reason in (*report.why, *report.remarks)]
    assert "features.decided" in told, "the verdict rests on it"


def test_names_are_written_as_people_write_them() -> None:
    report = judged(30, decision(30, feature_class="Windows", facade="n"))
    assert report.verdict is Verdict.ACCEPTED
    assert "features.decided" in messages(report.elements[1])


@pytest.mark.parametrize("counted", [0, 19, 41, 1000])
def test_a_number_that_the_linework_rules_out_is_an_error(counted: int) -> None:
    kind, fields = wrong(30, decision(counted))
    assert (kind, fields["low"], fields["high"], fields["value"]) == ("outside", 20, 40, counted)
    commission, omission = judged(30, decision(counted)).elements
    assert (commission.status, omission.status) == (UNDECIDED, UNDECIDED)


def test_decisions_that_decide_nothing_are_errors() -> None:
    assert wrong(30, decision(30)) == ("", {})
    assert wrong(30, decision(30, element="Q3"))[0] == "element"
    assert wrong(30, decision(30), decision(31, element="Q4"))[0] == "twice"
    for stranger in (decision(30, facade="S"), decision(30, feature_class="door"), decision(30, facade="")):
        kind, fields = wrong(30, stranger)
        assert (kind, fields["known"]) == ("unknown", "window / N")


def test_an_error_names_the_manifest_and_the_interval(tmp_path: Path) -> None:
    document = ezdxf.new(units=6)
    for x, y in PLACES[:4]:
        pane(document.modelspace(), x, y, layer="JANELA")
        pane(document.modelspace(), x, y, inset=0.06, layer="JANELA")
    document.saveas(tmp_path / "a.dxf")
    (tmp_path / "f.csv").write_text("id;class;facade;count\nJ;window;N;6\n")
    said = '[[decision]]\nelement = "Q5"\nclass = "window"\nfacade = "N"\nby = "A. Souza"\nreason = "seen"\n'
    text = (
        '[delivery]\nscale = "1:50"\n[[drawing]]\npath = "a.dxf"\nunit = "m"\nplane = "xy"\nfacade = "N"\n'
        f'classes = {{ JANELA = "window" }}\n[features]\npath = "f.csv"\n{said}'
    )
    manifest = tmp_path / "delivery.toml"
    manifest.write_text(f"{text}counted = 9\n")
    with pytest.raises(ManifestError) as caught:
        audit(tmp_path)
    assert caught.value.message == "decision.outside"
    assert {caught.value.fields[name] for name in ("file", "low", "high")} == {"delivery.toml", 4, 8}
    manifest.write_text(f"{text}counted = 6\n")
    elements = {element.id: element for element in audit(tmp_path).record.quality.elements}
    assert (elements["Q4"].status, elements["Q5"].status) == (PASS, PASS)


@pytest.mark.parametrize("line", ['counted = "6"', "counted = -1", "counted = 6.5", "", 'counted = 6\nclas = "a"'])
def test_a_decision_needs_a_whole_number_and_known_keys(tmp_path: Path, line: str) -> None:
    path = tmp_path / "delivery.toml"
    path.write_text(f'[[decision]]\nelement = "Q5"\nclass = "window"\nby = "A"\nreason = "b"\n{line}\n')
    with pytest.raises(ManifestError):
        load_manifest(path)
    path.write_text('[[decision]]\nelement = "Q5"\nclass = "window"\nby = " "\nreason = "b"\ncounted = 1\n')
    with pytest.raises(ManifestError):
        load_manifest(path)


def test_both_elements_ask_for_the_same_one_decision() -> None:
    commission, omission = (dict(one.why[0].fields) for one in judged(30).elements)
    assert commission["ask"] == omission["ask"]
    assert commission["elements"] == omission["elements"] == ["Q4", "Q5"]
    (reading,) = commission["readings"]
    said = dict(reading.fields)
    assert (said["label"], said["low"], said["high"], said["listed"]) == ("window / N", 20, 40, 30)


def test_what_a_person_decided_stands_with_what_decides() -> None:
    """It is what rejects, or what accepts: no remark."""
    for number in (20, 30):
        report = judged(30, decision(number))
        assert "features.decided" in [reason.message for reason in report.why]
        assert "features.decided" not in [reason.message for reason in report.remarks]
    assert [reason.message for reason in judged(30, decision(20)).why] == ["omission.fail", "features.decided"]


def test_a_decision_may_have_a_day(tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    said = '[[decision]]\nelement = "Q5"\nclass = "window"\nby = "A"\nreason = "b"\ncounted = 1\n'
    for line, day in (("date = 2026-02-28", "2026-02-28"), ('date = "2026-02-28"', "2026-02-28"), ("", "")):
        path.write_text(said + line)
        assert load_manifest(path).decision[0].date == day
    for line in ('date = "28/02/2026"', "date = 2026-02-28T10:00:00", "date = 20260228", 'date = "2026-02-30"'):
        path.write_text(said + line)
        with pytest.raises(ManifestError) as caught:
            load_manifest(path)
        assert caught.value.fields["example"] == "date = 2026-11-20"
    (told,) = (one for one in judged(30, decision(20, date="2026-02-28")).why if one.message == "features.decided")
    for language in ("en", "pt-BR"):
        assert "A. Souza (2026-02-28)" in reason_sentence(Words(language), told)


def test_who_decides_is_told_which_manifest_was_audited() -> None:
    sources = (Source(path="delivery.toml", role="manifest", sha256="ab" * 32, bytes=1, status=SourceStatus.READ),)
    for decisions, told in (((), []), ((decision(30),), ["ab" * 32])):
        signed = replace(delivery(30, *decisions), sources=sources)
        report = judge(Q4, Q5, delivery=signed, counts=counted(FRAMES))
        found = [dict(one.fields)["sha256"] for one in report.remarks if one.message == "verdict.signed"]
        assert found == told
