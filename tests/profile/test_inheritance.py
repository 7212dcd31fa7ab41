# SPDX-License-Identifier: MIT
"""What a profile makes of its tables: inheritance, chords, and lines of mistakes."""

import hashlib
from pathlib import Path

import pytest

from foparq.errors import ManifestError, ProfileError, UsageError
from foparq.findings.table import Severity
from foparq.profile.adjust import choose, with_settings
from foparq.profile.load import load_manifest, load_profile
from foparq.profile.schema import CheckSpec, Profile, ReadingSpec
from foparq.profile.toml_text import read_toml
from foparq.resources import shipped
from foparq.units import parse_any_quantity


def check(rule: str, **tolerances: str) -> CheckSpec:
    return CheckSpec(
        rule=rule, severity=Severity.MAJOR, tolerances={name: parse_any_quantity(q) for name, q in tolerances.items()}
    )


def profile(*checks: CheckSpec, sagitta: str = "0.02 mm @ scale") -> Profile:
    return Profile(
        name="t", title={"en": "t"}, product_class="A", reading=ReadingSpec(sagitta=sagitta), checks=tuple(checks)
    )


# --- chords ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rule", ["undershoot", "overshoot", "free-end"])
def test_chords_stay_within_a_quarter_of_the_finest_place_that_an_end_may_have(rule: str) -> None:
    made = profile(check(rule, coincide="0.01 mm @ scale", reach="1 mm"), check("gap", coincide="1 um"))
    assert made.chord_distance(50.0) == 0.000125
    finer = profile(*made.checks, check("undershoot", coincide="0.2 mm", reach="1 mm"))
    assert finer.chord_distance(50.0) == 0.00005


def test_chords_stay_within_the_stated_sagitta() -> None:
    made = profile(check("undershoot", coincide="1 m"), sagitta="0.5 mm")
    assert made.chord_distance(50.0) == 0.0005
    assert profile(check("gap", coincide="1 um")).chord_distance(50.0) == 0.001


def test_a_tolerance_of_nothing_asks_for_no_infinite_fineness() -> None:
    assert profile(check("undershoot", coincide="0 mm")).chord_distance(50.0) == 0.001


# --- choosing --------------------------------------------------------------------------------------------------------


def test_an_element_stays_only_if_all_its_rules_do() -> None:
    whole = load_profile("et-doc-foparq-a")
    chosen = choose(whole, ["undershoot"])
    assert all(set(element.uses) <= {"undershoot"} for element in chosen.elements)
    assert {element.id for element in whole.elements if not element.uses} <= {element.id for element in chosen.elements}
    assert "Q3-dangle" not in {element.id for element in chosen.elements}


def test_settings_leave_other_tolerances_alone() -> None:
    before = load_profile("et-doc-foparq-a")
    after = with_settings(before, ["undershoot.reach = 7 mm"])
    for one, other in zip(before.checks, after.checks, strict=True):
        expected = {**one.tolerances}
        if one.rule == "undershoot":
            expected["reach"] = parse_any_quantity("7 mm")
        assert other.tolerances == expected
    assert with_settings(before, []) is before


def test_a_setting_of_reading() -> None:
    made = with_settings(load_profile("et-doc-foparq-a"), ["reading.hidden=check", "reading.sagitta = 2 mm"])
    assert (made.reading.hidden, made.reading.sagitta.si()) == ("check", 0.002)


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("undershoot.reach", "usage.setting"), ("reach=1mm", "usage.setting"), ("undershoot.reach=x", "usage.setting"),
        ("undershoot.far=1mm", "usage.setting-unknown"), ("reading.x=1", "usage.setting-unknown"),
        ("reading.blocks=burn", "usage.setting"), ("reading.sagitta=1 m2", "usage.setting"),
    ],
)  # fmt: skip
def test_a_wrong_setting_by_kind(setting: str, message: str) -> None:
    with pytest.raises(UsageError) as caught:
        with_settings(load_profile("et-doc-foparq-a"), [setting])
    assert caught.value.message == message


# --- inheritance -----------------------------------------------------------------------------------------------------

MINE = """extends = "et-doc-foparq-a"
name = "mine"

[[check]]
rule = "gap"
severity = "note"
coincide = "7 mm"
most = "1 m2"

[[element]]
id = "Q9"
kind = "found-rate"
rules = ["gap"]
required = false
"""


def write(folder: Path, text: str, name: str = "mine.toml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_own_tables_replace_those_of_the_base_in_their_place(tmp_path: Path) -> None:
    base = load_profile("et-doc-foparq-a")
    mine = load_profile(str(write(tmp_path, MINE)))
    assert (mine.name, mine.product_class) == ("mine", base.product_class)
    assert list(dict.fromkeys(spec.rule for spec in mine.checks)) == list(
        dict.fromkeys(spec.rule for spec in base.checks)
    )
    (gap,) = (spec for spec in mine.checks if spec.rule == "gap")
    assert (gap.severity, gap.tolerances["coincide"].si(), gap.line) == (Severity.NOTE, 0.007, 4)
    assert [spec for spec in mine.checks if spec.rule != "gap"] == [spec for spec in base.checks if spec.rule != "gap"]
    assert [element.id for element in mine.elements] == [*(element.id for element in base.elements), "Q9"]


def test_the_hash_is_of_the_profile_and_of_what_it_extends(tmp_path: Path) -> None:
    path = write(tmp_path, MINE)
    base = shipped("rules") / "profiles" / "et-doc-foparq-a.toml"
    both = "".join(f"{hashlib.sha256(file.read_bytes()).hexdigest()}\n" for file in (path, base))
    assert load_profile(str(path)).sha256 == hashlib.sha256(both.encode()).hexdigest()
    assert load_profile("et-doc-foparq-a").sha256 == hashlib.sha256(base.read_bytes()).hexdigest()


def test_a_relative_name_starts_from_the_folder_beside(tmp_path: Path) -> None:
    write(tmp_path, MINE)
    assert load_profile("mine.toml", beside=tmp_path).name == "mine"
    with pytest.raises(ProfileError):
        load_profile("mine.toml", beside=tmp_path / "other")


# --- where mistakes stand --------------------------------------------------------------------------------------------

TEXT = """# comment
title = "x"

[delivery]
scale = "1:50"
a.b = 1
"quoted key" = 2

[[drawing]]
path = "a.dxf"

  [[drawing]]
  path = "b.dxf"

[x . "y z"]
k = 1
"""


def test_lines_of_tables_and_keys(tmp_path: Path) -> None:
    text = read_toml(write(tmp_path, TEXT), ManifestError)
    known = {
        ("title",): 2, ("delivery",): 4, ("delivery", "scale"): 5, ("delivery", "a", "b"): 6,
        ("delivery", "quoted key"): 7, ("drawing", 0): 9, ("drawing", 0, "path"): 10, ("drawing", 1): 12,
        ("drawing", 1, "path"): 13, ("x", "y z"): 15, ("x", "y z", "k"): 16,
    }  # fmt: skip
    assert {place: text.line(place) for place in known} == known
    # What has no line of its own stands where the nearest table begins.
    assert text.line(("drawing", 1, "unit", 3)) == 12
    assert text.line(("nowhere",)) == 1


@pytest.mark.parametrize(
    ("line", "example"),
    [
        ("path = C:\\a\\b.dxf", 'path = "C:/a/b.dxf"'), ("unit = mm # note", 'unit = "mm"'),
        ("title = “x”", 'title = "x"'), ("areas = [x", 'unit = "m"'), ("what", 'unit = "m"'), ("= 3", 'unit = "m"'),
    ],
)  # fmt: skip
def test_a_line_that_lacks_quotes_is_shown_with_them(tmp_path: Path, line: str, example: str) -> None:
    with pytest.raises(ManifestError) as caught:
        load_manifest(write(tmp_path, f"[delivery]\n{line}\n"))
    fields = caught.value.fields
    assert (caught.value.message, fields["line"], fields["value"]) == ("toml.syntax", 2, line)
    assert fields["example"] == example


@pytest.mark.parametrize("line", ["counted =", "counted =   # a number from 4 to 8", "  counted=\t"])
def test_a_key_without_a_value_is_told_as_such(tmp_path: Path, line: str) -> None:
    """The lines that the page offers leave the count open; who pastes them as they are learns which line to fill in."""
    with pytest.raises(ManifestError) as caught:
        load_manifest(write(tmp_path, f"[[decision]]\n{line}\n"))
    fields = caught.value.fields
    assert (caught.value.message, fields["line"], fields["key"]) == ("toml.no-value", 2, "counted")


def test_a_manifest_of_exactly_a_million_bytes_is_read(tmp_path: Path) -> None:
    path = write(tmp_path, "#" * 999_999 + "\n")
    assert load_manifest(path).drawing == ()
    path.write_text("#" * 1_000_000 + "\n")
    with pytest.raises(ManifestError) as caught:
        load_manifest(path)
    assert (caught.value.message, caught.value.fields["value"]) == ("toml.too-large", 1_000_001)
