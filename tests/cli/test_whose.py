# SPDX-License-Identifier: MIT
"""Whose specification and scale: what is not shipped never passes for it; what the reviewer states is told first."""

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import ezdxf
import jsonschema
import pytest
from tests.cli.conftest import Command

from foparq.cli.main import run
from foparq.evaluate.late_doubt import without_reports
from foparq.evaluate.quality import QualityReport, Verdict, because
from foparq.profile.load import load_profile
from foparq.report.words import Words
from foparq.resources import shipped

SHIPPED = load_profile("et-doc-foparq-a")
BARE = (
    'product_class = "A"\n[reading]\nsagitta = "0.001 mm @ scale"\n'
    '[[check]]\nrule = "needs-recovery"\nseverity = "minor"\n'
)
OWN = 'extends = "et-doc-foparq-a"\nname = "caderno"\n'
EASY = '[[element]]\nid = "Q1"\nkind = "absolute"\nrequired = true\nlimit = "240 mm @ scale"\n'
WAIVED = '[[element]]\nid = "Q1-X"\nkind = "absolute"\nrequired = false\napplicable = false\n'


@pytest.fixture
def foparq(foparq: Command) -> Command:
    """Run the command in English, whatever the manifest says."""
    return lambda *arguments: foparq(*arguments, "--lang", "en")


def deliver(folder: Path, profile: str | None, files: Mapping[str, str], scale: str | None = "1:50") -> Path:
    """A delivery of one drawing, with a profile that its manifest names."""
    folder.mkdir(parents=True)
    document = ezdxf.new("R2010", units=6)
    for start, end in (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 0))):
        document.modelspace().add_line(start, end)
    document.saveas(folder / "fachada.dxf")
    stated = [f'profile = "{profile}"'] if profile else []
    stated += [f'scale = "{scale}"'] if scale else []
    lines = ["[delivery]", 'title = "Casa"', *stated, "[[drawing]]", 'path = "fachada.dxf"', 'unit = "m"']
    (folder / "delivery.toml").write_text("\n".join(lines), encoding="utf-8")
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def audited(folder: Path) -> dict[str, Any]:
    report: dict[str, Any] = json.loads((folder / "audit" / "audit.json").read_text(encoding="utf-8"))
    schema = json.loads((shipped("templates") / "schema" / "foparq-audit-1.schema.json").read_text(encoding="utf-8"))
    jsonschema.validate(report, schema)
    return report


def copy_of_the_shipped() -> str:
    return Path(SHIPPED.path).read_text(encoding="utf-8")


#: name of the profile in the manifest, files of the delivery: disguises that are seen through before anything is read
REFUSED: dict[str, tuple[str, dict[str, str]]] = {
    "the shipped name": ("r.toml", {"r.toml": 'extends = "et-doc-foparq-a"\nname = "et-doc-foparq-a"\n'}),
    "the shipped name in capitals": ("r.toml", {"r.toml": 'extends = "et-doc-foparq-a"\nname = "Et-Doc-Foparq-A"\n'}),
    "a Cyrillic letter": ("r.toml", {"r.toml": 'extends = "et-doc-foparq-a"\nname = "et-doc-foparq-\u0430"\n'}),
    "a file called like the shipped one": ("et-doc-foparq-a.toml", {"et-doc-foparq-a.toml": OWN + EASY}),
    "a file called like its title": ("ET DOC FOPARQ, class A.toml", {"ET DOC FOPARQ, class A.toml": OWN + EASY}),
    "what it extends called like the shipped one": (
        "r.toml", {"r.toml": OWN.replace("-a", "-a.toml"), "et-doc-foparq-a.toml": 'name = "b"\n' + BARE},
    ),
    "an easy element under the id of another": (
        "r.toml", {"r.toml": OWN + '[[element]]\nid = "Q1"\nkind = "found-rate"\nrequired = true\nlimit = "99 %"\n'},
    ),
    "an easy element under the id of a result": (
        "r.toml", {"r.toml": f'name = "caderno"\n{BARE}' + EASY.replace("Q1", "Q1-X").replace("absolute", "omission")},
    ),
    "a copy of the shipped file": ("et-doc-foparq-a.toml", {"et-doc-foparq-a.toml": copy_of_the_shipped()}),
    "a copy under another name, with its title": (
        "r.toml", {"r.toml": copy_of_the_shipped().replace('"et-doc-foparq-a"', '"caderno"')},
    ),
    "the shipped title": ("r.toml", {"r.toml": f'{OWN}[title]\npt-BR = "{SHIPPED.title["pt-BR"]}"\n'}),
    "the shipped title in the other language": ("r.toml", {"r.toml": f'{OWN}[title]\nen = "{SHIPPED.title["en"]}"\n'}),
    "an invisible letter in the title": ("r.toml", {"r.toml": f'{OWN}[title]\nen = "Cader\u200bno"\n'}),
    "a result waived behind an element": ("r.toml", {"r.toml": OWN + WAIVED}),
    "an element beside itself": ("r.toml", {"r.toml": OWN + EASY + EASY.replace("true", "false")}),
    "the visual product called metric": (
        "r.toml", {"r.toml": 'extends = "et-doc-foparq-b"\nname = "caderno"\nproduct_class = "A"\n'},
    ),
    "no name": ("r.toml", {"r.toml": 'extends = "et-doc-foparq-a"\n'}),
    "the folder above": ("../r.toml", {"../r.toml": OWN}),
    "what it extends in the folder above": (
        "r.toml", {"r.toml": 'extends = "../base.toml"\nname = "caderno"\n', "../base.toml": copy_of_the_shipped()},
    ),
    "a sibling that begins alike": ("../d-2/r.toml", {"../d-2/r.toml": OWN}),
    "the shipped file under a name in capitals": ("ET-DOC-FOPARQ-A", {}),
}  # fmt: skip

#: the same for profiles that are used and named for what they are, and words of what is looser
NAMED: dict[str, tuple[str, dict[str, str], tuple[str, ...]]] = {
    "an easy limit": ("r.toml", {"r.toml": OWN + EASY}, ("limit of Q1 is 12 m instead of 15 mm",)),
    "no title": ("r.toml", {"r.toml": OWN}, ("nowhere looser",)),
    "norms of the shipped one": ("r.toml", {"r.toml": OWN + f"norms = {list(SHIPPED.norms)}\n"}, ()),
    "a folder called like the shipped one": ("et-doc-foparq-a/r.toml", {"et-doc-foparq-a/r.toml": OWN + EASY}, ("Q1",)),
    "easy limits in what it extends": (
        "r.toml", {"r.toml": 'extends = "base.toml"\nname = "caderno"\n', "base.toml": 'name = "b"\n' + BARE},
        ("Q1, Q2, Q3, Q3-mesh, Q4, Q5, Q6", "undershoot"),
    ),
    "another class that asks for less": (
        "r.toml", {"r.toml": OWN + 'product_class = "B"\n' + EASY.replace("true", "false")},
        ("Compared with et-doc-foparq-a", "elements not required: Q1"),
    ),
    "nothing asked for": ("r.toml", {"r.toml": 'name = "caderno"\n' + BARE}, ("Q1, Q2, Q3, Q3-mesh, Q4, Q5, Q6",)),
    "rules bound to no layer": (
        "r.toml", {"r.toml": OWN + '[[check]]\nrule = "invalid-geometry"\nseverity = "note"\nlayers = []\n'},
        ("invalid-geometry weighs as note instead of major", "invalid-geometry looks at the layers"),
    ),
}  # fmt: skip


@pytest.mark.parametrize(("profile", "files"), REFUSED.values(), ids=REFUSED.keys())
def test_a_disguise_is_refused(foparq: Command, tmp_path: Path, profile: str, files: dict[str, str]) -> None:
    folder = deliver(tmp_path / "d", profile, files)
    code, out, err = foparq("audit", folder)
    assert (code, out) == (2, "")
    assert "Example: " in err
    assert not (folder / "audit" / "audit.json").exists()


@pytest.mark.parametrize("kind", ["link", "absolute", "link to what it extends"])
def test_nothing_outside_the_folder_is_opened_for_a_profile(foparq: Command, tmp_path: Path, kind: str) -> None:
    secret = tmp_path / "elsewhere.toml"
    secret.write_text('name = "a-secret"\nsecret = "17"\n', encoding="utf-8")
    named = str(secret) if kind == "absolute" else "r.toml"
    files = {"r.toml": 'extends = "base.toml"\nname = "caderno"\n'} if kind == "link to what it extends" else {}
    folder = deliver(tmp_path / "d", named, files)
    if kind != "absolute":
        (folder / ("base.toml" if files else "r.toml")).symlink_to(secret)
    code, out, err = foparq("audit", folder)
    assert (code, out) == (2, "")
    assert "secret" not in err
    assert "outside the delivery's folder" in err


@pytest.mark.parametrize(("profile", "files", "words"), NAMED.values(), ids=NAMED.keys())
def test_what_is_not_shipped_is_named_and_inherits_no_claim(
    foparq: Command, tmp_path: Path, profile: str, files: dict[str, str], words: tuple[str, ...]
) -> None:
    folder = deliver(tmp_path / "d", profile, files)
    code, out, _ = foparq("audit", folder)
    assert code == 3
    report = audited(folder)
    first = report["why"][0]["text"]
    assert f"({', '.join(files)}) is not one that comes with foparq" in first
    assert all(part in first for part in words), first
    assert first in out
    assert report["profile"]["shipped"] is False
    hashed = {one["path"]: one["sha256"] for one in report["inputs"] if one["role"] == "profile"}
    assert hashed == {name: hashlib.sha256(text.encode()).hexdigest() for name, text in files.items()}
    assert "not a specification that comes with foparq" in out.splitlines()[1]
    for name in ("quality.xml", "report.html", "audit.json"):
        told = (folder / "audit" / name).read_text(encoding="utf-8")
        assert not any(title in told for title in SHIPPED.title.values()), name
    xml = (folder / "audit" / "quality.xml").read_text(encoding="utf-8")
    assert not any(norm in xml for norm in SHIPPED.norms)
    assert not re.search(r">caderno</gco:CharacterString>\s*</mcc:code>\s*<mcc:codeSpace>", xml)


def test_the_shipped_specification_is_named_without_remark(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "et-doc-foparq-a", {})
    _, out, _ = foparq("audit", folder)
    report = audited(folder)
    assert (report["profile"]["shipped"], report["profile"]["compared_with"]) == (True, None)
    assert not any(reason["id"].startswith("terms.") for reason in report["why"])
    assert out.splitlines()[1] == (
        "Specification: ET/DOC-FOPARQ, class A (metric product) (et-doc-foparq-a). Class of product: A (metric). "
        "Scale: 1:50."
    )


def test_a_scale_that_the_profile_fixes_is_told(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "r.toml", {"r.toml": OWN + 'scale = "1:200"\n'}, scale=None)
    foparq("audit", folder)
    report = audited(folder)
    assert report["scale"] == "1:200"
    assert "1:200" in report["why"][0]["text"]


# --- the reviewer ----------------------------------------------------------------------------------------------------


def test_the_reviewers_scale_goes_before_the_deliverys(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", None, {}, scale="1:100")
    _, out, _ = foparq("audit", folder, "--scale", "1:50")
    report = audited(folder)
    assert (report["scale"], report["why"][0]["id"]) == ("1:50", "terms.reviewer-scale")
    assert all(scale in report["why"][0]["text"] for scale in ("1:50", "1:100"))
    lines = out.splitlines()
    assert "Scale: 1:50." in lines[1]
    assert report["why"][0]["text"] in lines[2]
    limits = {one["id"]: one["limit"] for one in report["elements"]}
    assert limits["Q1-X"] == 0.015


def test_the_reviewers_profile_goes_before_the_deliverys(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "r.toml", {"r.toml": OWN + EASY})
    foparq("audit", folder, "--profile", "et-doc-foparq-a")
    report = audited(folder)
    assert (report["profile"]["name"], report["profile"]["shipped"]) == ("et-doc-foparq-a", True)
    assert report["why"][0]["id"] == "terms.reviewer-profile"
    assert all(name in report["why"][0]["text"] for name in ("et-doc-foparq-a", "r.toml"))
    (unused,) = (one for one in report["inputs"] if one["path"] == "r.toml")
    assert (unused["role"], unused["status"]) == ("other", "read")
    assert unused["sha256"] == hashlib.sha256((OWN + EASY).encode()).hexdigest()


def test_a_profile_of_the_reviewers_own_may_lie_anywhere_and_is_named_as_such(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "et-doc-foparq-a", {})
    mine = tmp_path / "elsewhere" / "mine.toml"
    mine.parent.mkdir()
    mine.write_text(OWN + EASY, encoding="utf-8")
    foparq("audit", folder, "--profile", mine, "--scale", "1:20")
    report = audited(folder)
    first = report["why"][0]
    assert first["id"] == "terms.several"
    assert [part["id"] for part in first["fields"]["parts"]] == [
        "terms.reviewer-profile", "terms.reviewer-scale", "terms.own-looser",
    ]  # fmt: skip
    assert "is not one that comes with foparq" in first["text"]
    (source,) = (one for one in report["inputs"] if one["role"] == "profile")
    assert (source["path"], source["sha256"]) == (mine.as_posix(), hashlib.sha256(mine.read_bytes()).hexdigest())


@pytest.mark.parametrize("arguments", [("--profile", "et-doc-foparq-a"), ("--scale", "1:50"), ("--scale", "1 : 50")])
def test_what_does_not_differ_is_not_told(foparq: Command, tmp_path: Path, arguments: tuple[str, ...]) -> None:
    folder = deliver(tmp_path / "d", "et-doc-foparq-a", {})
    foparq("audit", folder, *arguments)
    assert not any(reason["id"].startswith("terms.") for reason in audited(folder)["why"])


def test_a_copy_of_the_deliverys_profile_does_not_differ_from_it(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "r.toml", {"r.toml": OWN + EASY, "../copy.toml": OWN + EASY})
    foparq("audit", folder, "--profile", tmp_path / "copy.toml")
    assert audited(folder)["why"][0]["id"] == "terms.own-looser"


@pytest.mark.parametrize("text", ["not TOML", 'extends = "et-doc-foparq-a"\nname = "ET-DOC-FOPARQ-A"\n', None])
def test_a_profile_of_the_delivery_that_cannot_be_used_does_not_matter_then(
    foparq: Command, tmp_path: Path, text: str | None
) -> None:
    folder = deliver(tmp_path / "d", "r.toml", {} if text is None else {"r.toml": text})
    assert foparq("audit", folder)[0] == 2
    assert foparq("audit", folder, "--profile", "et-doc-foparq-b")[0] == 3
    assert audited(folder)["why"][0]["id"] == "terms.reviewer-profile"


def test_the_reviewers_scale_serves_where_the_manifest_has_none(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", None, {}, scale=None)
    assert foparq("audit", folder)[0] == 2
    assert foparq("audit", folder, "--scale", "1:50")[0] == 3
    report = audited(folder)
    assert report["scale"] == "1:50"
    assert not any(reason["id"].startswith("terms.") for reason in report["why"])


def test_the_reviewers_scale_settles_two_of_the_delivery(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "r.toml", {"r.toml": OWN + 'scale = "1:10"\n'})
    assert foparq("audit", folder)[0] == 2
    assert foparq("audit", folder, "--scale", "1:20")[0] == 3
    assert audited(folder)["scale"] == "1:20"


@pytest.mark.parametrize("arguments", [("--scale", "50"), ("--profile", "nowhere.toml"), ("--profile", "")])
def test_a_reviewers_slip_is_told(foparq: Command, tmp_path: Path, arguments: tuple[str, ...]) -> None:
    folder = deliver(tmp_path / "d", None, {})
    code, _, err = foparq("audit", folder, *arguments)
    assert code == 2
    assert "Example: " in err


def test_a_profile_of_the_delivery_reaches_no_farther_when_the_reviewer_names_it(
    foparq: Command, tmp_path: Path
) -> None:
    files = {"r.toml": 'extends = "../base.toml"\nname = "caderno"\n', "../base.toml": 'name = "b"\n' + BARE}
    folder = deliver(tmp_path / "d", None, files)
    code, _, err = foparq("audit", folder, "--profile", folder / "r.toml")
    assert (code, "outside the delivery's folder" in err) == (2, True)
    (folder / "r.toml").write_text(OWN, encoding="utf-8")
    assert foparq("audit", folder, "--profile", folder / "r.toml")[0] == 3
    assert [one["path"] for one in audited(folder)["inputs"] if one["role"] == "profile"] == ["r.toml"]


def test_a_ring_of_links_is_no_profile(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", "ring.toml", {})
    (folder / "ring.toml").symlink_to(folder / "ring.toml")
    assert foparq("audit", folder)[0] == 2
    assert foparq("audit", folder, "--profile", folder / "ring.toml")[0] == 2


def test_two_scales_of_the_reviewers_are_refused(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", None, {"../mine.toml": OWN + 'scale = "1:10"\n'})
    code, _, err = foparq("audit", folder, "--profile", tmp_path / "mine.toml", "--scale", "1:50")
    assert code == 2
    assert all(part in err for part in ("1:10", "1:50", "mine.toml"))


# --- loose drawings, and what comes later ----------------------------------------------------------------------------


def test_check_names_specification_class_and_scale(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", None, {"r.toml": OWN + EASY})
    drawing = folder / "fachada.dxf"
    lines = foparq("check", drawing, "--scale", "1:100")[1].splitlines()
    assert "class A (metric product)" in lines[1]
    assert lines[1].endswith("Class of product: A (metric). Scale: 1:100.")
    lines = foparq("check", drawing, "--scale", "1:100", "--profile", folder / "r.toml")[1].splitlines()
    assert "caderno, not a specification that comes with foparq" in lines[1]
    changed = ("--set", "undershoot.reach=1m", "--ignore", "gap")
    lines = foparq("check", drawing, "--scale", "1:100", *changed, "--out", tmp_path / "out")[1].splitlines()
    assert "changed for this run: --ignore gap, --set undershoot.reach=1m" in lines[1]
    told = json.loads((tmp_path / "out" / "audit.json").read_text(encoding="utf-8"))
    assert told["profile"]["changes"] == ["--ignore gap", "--set undershoot.reach=1m"]
    assert "--set undershoot.reach=1m" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_a_report_that_crashes_does_not_hide_whose_specification_it_was() -> None:
    first = because("terms.own", profile="caderno", files=["r.toml"], compared="et-doc-foparq-a")
    quality = QualityReport(
        verdict=Verdict.ACCEPTED, why=(first, because("verdict.accepted", elements=["Q3"])), elements=(), terms=first
    )
    doubted = without_reports(quality, ["report.html"])
    assert (doubted.verdict, doubted.why[0]) == (Verdict.UNDECIDED, first)
    shipped_one = without_reports(replace(quality, terms=None, why=quality.why[1:]), ["report.html"])
    assert [reason.message for reason in shipped_one.why] == ["verdict.crashed-reports"]


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_the_help_of_audit_tells_of_both(capsys: pytest.CaptureFixture[str], language: str) -> None:
    assert run(["audit", "--help", "--lang", language]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert all(option in out for option in ("--profile", "--scale 1:K"))
    assert Words(language)("cli.audit.profile-value") in out
