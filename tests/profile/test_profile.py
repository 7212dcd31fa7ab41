# SPDX-License-Identifier: MIT
"""Profiles and manifests: what is taken, and how a mistake is told."""

from pathlib import Path

import pytest

from foparq.check.validate import validate_checks
from foparq.errors import FoparqError, ManifestError, ProfileError, UsageError
from foparq.profile.adjust import choose, with_settings
from foparq.profile.load import load_manifest, load_profile, shipped_profiles
from foparq.report.words import LANGUAGES, Words


def write(folder: Path, text: str, name: str = "delivery.toml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_limits_of_class_a_at_1_50_are_those_of_the_specification() -> None:
    profile = load_profile("et-doc-foparq-a")
    limits = {element.id: element.limit for element in profile.elements if getattr(element, "limit", None)}
    assert limits["Q1"].si(50) == 0.015
    assert limits["Q2"].si(50) == 0.010
    assert limits["Q3"].si() == 0.1
    assert limits["Q4"].si() == 0.0
    assert limits["Q5"].si() == 0.05
    assert {element.id for element in profile.elements if element.required} == {
        "Q1", "Q2", "Q3", "Q3-mesh", "Q4", "Q5", "Q6",
    }  # fmt: skip


def test_class_b_makes_no_metric_promise() -> None:
    profile = load_profile("et-doc-foparq-b")
    assert profile.product_class == "B"
    assert {element.id for element in profile.elements if not element.applicable} == {"Q1", "Q2", "Q6"}
    assert {element.id for element in profile.elements if element.required} == {"Q3", "Q3-mesh", "Q4", "Q5"}
    assert [element.id for element in profile.elements] == [
        element.id for element in load_profile("et-doc-foparq-a").elements
    ]


@pytest.mark.parametrize("name", shipped_profiles())
def test_shipped_profiles_are_valid(name: str) -> None:
    validate_checks(load_profile(name))


@pytest.mark.parametrize(
    ("text", "line", "names"),
    [
        ('[delivery]\ntitel = "x"\n', 2, "titel"),
        ('[delivery]\nscale = "50"\n', 2, "1:50"),
        ('[delivery]\nlanguage = "de"\n', 2, "pt-BR"),
        ('[[drawing]]\nunit = "m"\n', 1, "path"),
        ('[[drawing]]\npath = "a.dxf"\nunit = "stone"\n', 3, "stone"),
        ('[[drawing]]\npath = "a.dxf"\n\n[[drawing]]\npath = "b.dxf"\nplane = "zz"\n', 6, "zz"),
        ('[checkpoints]\npath = "p.csv"\nsurvey_sd = 3\n', 3, "3"),
        ('[checkpoints]\npath = "p.csv"\nsurvey_sd = "3 kg"\n', 3, "kg"),
        ("[delivery]\nscale = = 3\n", 2, "scale = = 3"),
    ],
)
def test_a_wrong_manifest_is_told_with_file_line_value_and_example(
    tmp_path: Path, text: str, line: int, names: str
) -> None:
    path = write(tmp_path, text)
    with pytest.raises(ManifestError) as caught:
        load_manifest(path)
    assert caught.value.fields["line"] == line
    for language in LANGUAGES:
        sentence = Words(language).error(caught.value)
        assert str(path) in sentence
        assert names in sentence
        assert str(line) in sentence


@pytest.mark.parametrize(
    ("line", "message", "example"),
    [
        ("symbol = 3", "quantity.bare", "3 mm @ scale"),
        ('symbol = "3 deg"', "quantity.wrong-unit", "3 mm @ scale"),
        ("symbol_times = 0", "toml.wrong-value", "symbol_times = 3"),
        ("symbol_times = true", "toml.wrong-value", "symbol_times = 3"),
        ("symbol_times = 2.5", "toml.wrong-value", "symbol_times = 3"),
    ],
)
def test_what_recognises_a_symbol_is_told_if_it_is_wrong(tmp_path: Path, line: str, message: str, example: str) -> None:
    text = f'extends = "et-doc-foparq-a"\nname = "mine"\n[linework]\n{line}\n'
    with pytest.raises(ProfileError) as caught:
        load_profile(str(write(tmp_path, text, "mine.toml")))
    assert caught.value.message.startswith(message)
    assert caught.value.fields["line"] == 4
    assert example in caught.value.fields["example"]


def test_an_empty_manifest_is_a_manifest(tmp_path: Path) -> None:
    manifest = load_manifest(write(tmp_path, ""))
    assert manifest.drawing == ()
    assert manifest.checkpoints is None


def test_a_manifest_that_is_not_text(tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ManifestError, match="not-utf8"):
        load_manifest(path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ('[[check]]\nrule = "undershot"\nseverity = "major"\n', "unknown-rule"),
        ('[[check]]\nrule = "undershoot"\nseverity = "major"\ncoincide = "1 mm"\n', "missing-tolerance"),
        ('[[check]]\nrule = "undershoot"\nseverity = "major"\ncoincide = "1 mm"\nreach = "1 m2"\n', "tolerance-unit"),
        (
            '[[check]]\nrule = "free-end"\nseverity = "major"\ncoincide = "1 mm"\nreach = "1 m"\nmost = "1 m2"\n',
            "unknown-tolerance",
        ),
    ],
)
def test_a_wrong_check_is_told_before_any_file_is_read(tmp_path: Path, change: str, message: str) -> None:
    head = 'extends = "et-doc-foparq-a"\nname = "mine"\n\n'
    path = write(tmp_path, head + change, "mine.toml")
    profile = load_profile(str(path))
    with pytest.raises(ProfileError, match=message) as caught:
        validate_checks(profile)
    assert caught.value.fields["line"] == 4
    assert caught.value.fields["file"] == str(path)


@pytest.mark.parametrize(
    "text",
    [
        '[[check]]\nrule = "undershoot"\nseverity = "awful"\ncoincide = "1 mm"\nreach = "2 mm"\n',
        '[[check]]\nrule = "undershoot"\nseverity = "major"\ncoincide = 1\nreach = "2 mm"\n',
        "check = 3\n",
        "check = [3]\n",
        "element = {}\n",
        'element = [{ id = "Q3" }, "Q4"]\n',
        "colour = 3\n",
        '[[element]]\nid = "Q3"\nkind = "guess"\nrequired = true\n',
    ],
)
def test_a_wrong_profile_is_told(tmp_path: Path, text: str) -> None:
    path = write(tmp_path, 'extends = "et-doc-foparq-a"\n' + text, "mine.toml")
    with pytest.raises(ProfileError) as caught:
        load_profile(str(path))
    for language in LANGUAGES:
        assert str(path) in Words(language).error(caught.value)


def test_only_one_level_of_extending(tmp_path: Path) -> None:
    path = write(tmp_path, 'extends = "et-doc-foparq-b"\n', "mine.toml")
    with pytest.raises(ProfileError, match="extends-twice"):
        load_profile(str(path))


@pytest.mark.parametrize("name", ["et-doc-foparq-x", "../../etc/passwd", "nowhere.toml", ""])
def test_an_unknown_profile_names_those_that_exist(name: str) -> None:
    with pytest.raises(ProfileError) as caught:
        load_profile(name)
    assert "et-doc-foparq-a" in Words("en").error(caught.value)


def test_settings_change_tolerances_of_one_rule_or_all() -> None:
    profile = with_settings(
        load_profile("et-doc-foparq-a"), ["undershoot.reach=7mm", "*.coincide=1um", "reading.blocks=skip"]
    )
    by_rule = {spec.rule: spec.tolerances for spec in profile.checks}
    assert by_rule["undershoot"]["reach"].si() == 0.007
    assert by_rule["overshoot"]["reach"].si(50) == 0.010
    assert {tolerances["coincide"].si() for tolerances in by_rule.values() if "coincide" in tolerances} == {1e-6}
    assert profile.reading.blocks == "skip"


@pytest.mark.parametrize(
    "setting",
    [
        "",
        "reach=1mm",
        "undershoot.reach",
        "undershoot.reach=7",
        "undershoot.speed=1mm",
        "nothing.reach=1mm",
        "reading.blocks=burn",
        "reading.x=1",
    ],
)
def test_a_wrong_setting_is_told(setting: str) -> None:
    with pytest.raises(UsageError) as caught:
        with_settings(load_profile("et-doc-foparq-a"), [setting])
    assert Words("en").error(caught.value)


def test_chosen_rules_keep_only_elements_that_need_no_other() -> None:
    profile = choose(load_profile("et-doc-foparq-a"), ["undershoot", "overshoot"])
    assert {spec.rule for spec in profile.checks} == {"undershoot", "overshoot"}
    assert "Q3-dangle" in {element.id for element in profile.elements}
    assert "Q3" not in {element.id for element in profile.elements}


def test_an_error_crosses_processes() -> None:
    import pickle

    error = ProfileError("profile.unknown", value="x", known="a", example="a")
    again = pickle.loads(pickle.dumps(error))
    assert isinstance(again, FoparqError)
    assert (again.message, again.fields) == (error.message, error.fields)
