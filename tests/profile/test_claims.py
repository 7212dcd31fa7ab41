# SPDX-License-Identifier: MIT
"""Names and titles of one's own that a reader could take for shipped ones are refused; honest ones are not."""

from pathlib import Path

import pytest

from foparq.errors import ProfileError
from foparq.profile.claims import mistaken_for
from foparq.profile.letters import odd_letters
from foparq.profile.load import load_profile, shipped_profiles
from foparq.report.words import LANGUAGES, Words

TITLE = "ET/DOC-FOPARQ, classe A (produto métrico)"

NAMES = {
    "the same": "et-doc-foparq-a",
    "capitals": "ET-DOC-FOPARQ-A",
    "underscores": "et_doc_foparq_a",
    "spaces": "et doc foparq a",
    "no separators": "etdocfoparqa",
    "a space behind": "et-doc-foparq-a ",
    "Cyrillic a": "et-doc-foparq-\u0430",
    "Cyrillic o": "et-d\u043ec-foparq-a",
    "Greek omicron": "et-doc-f\u03bfparq-a",
    "full-width": "\uff45\uff54-doc-foparq-a",
    "mathematical letters": "\U0001d41et-doc-foparq-a",
    "small capitals": "et-doc-foparq-\u1d00",
    "zero-width space": "et-doc-\u200bfoparq-a",
    "soft hyphen": "et-doc-fop\u00adarq-a",
    "turned by a bidirectional mark": "\u202eet-doc-foparq-a",
    "accents": "ét-dóc-fopárq-á",
    "combining ring": "et-doc-foparq-a\u030a",
    "stroke through": "et-doc-f\u00f8parq-a",
    "non-breaking hyphens": "et\u2011doc\u2011foparq\u2011a",
    "zero for o": "et-d0c-f0parq-a",
    "four for a": "et-doc-fop4rq-4",
    "sign for a": "et-doc-fop@rq-a",
    "c and l for d": "et-cloc-foparq-a",
    "nine for q": "et-doc-fopar9-a",
    "another class": "et-doc-foparq-c",
    "a year behind": "et-doc-foparq-a-2026",
    "one letter otherwise": "et-doc-fopark-a",
}

TITLES = {
    "the same": TITLE,
    "English": "ET/DOC-FOPARQ, class A (metric product)",
    "capitals without accents": "ET/DOC-FOPARQ, CLASSE A (PRODUTO METRICO)",
    "without the class": "ET/DOC-FOPARQ",
    "a year behind": f"{TITLE}, 2026",
    "something in front": f"Especificação {TITLE}",
    "other separators": "ET DOC FOPARQ classe A",
    "the word alone": "Especificação FOPARQ, classe A",
    "division slash": "ET\u2215DOC-FOPARQ, classe A",
    "Cyrillic": "\u0415\u0422/DOC-FOPARQ, classe A",
    "invisible joiner": "ET/DOC-FO\u2060PARQ, classe A",
    "letters in squares": "\U0001f134\U0001f143/DOC-FOP\U0001f130RQ",
    "one letter otherwise": "ET/DOC-FOPARK, classe A (produto métrico)",
}

HONEST = [
    "caderno-da-obra",
    "Caderno de encargos",
    "iphan-sp-2026",
    "Casa de Câmara nº 3 – rev. 2",
    "DOC-01",
    "Øre & Ærø",
]


def written(folder: Path, text: str) -> Path:
    path = folder / "regras.toml"
    path.write_text('extends = "et-doc-foparq-a"\n' + text, encoding="utf-8")
    return path


def refusal(path: Path) -> ProfileError:
    with pytest.raises(ProfileError) as caught:
        load_profile(str(path))
    return caught.value


def shown(error: ProfileError, language: str) -> str:
    return Words(language).error(error)


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES.keys())
def test_a_name_that_could_be_taken_for_a_shipped_one_is_refused(tmp_path: Path, name: str) -> None:
    error = refusal(written(tmp_path, f'name = "{name}"\n'))
    for language in LANGUAGES:
        said = shown(error, language)
        assert "regras.toml" in said
        assert 'name = "caderno-da-obra"' in said
        assert said.isprintable(), "what is invisible must be seen in the message"
    assert error.fields["line"] == 2


@pytest.mark.parametrize("language", [*LANGUAGES, "fr"])
@pytest.mark.parametrize("title", TITLES.values(), ids=TITLES.keys())
def test_so_is_a_title_in_any_language(tmp_path: Path, title: str, language: str) -> None:
    error = refusal(written(tmp_path, f'name = "caderno"\n[title]\n{language} = "{title}"\n'))
    assert error.fields["line"] == 4
    for spoken in LANGUAGES:
        assert f"title.{language}" in shown(error, spoken)
        assert shown(error, spoken).isprintable()


@pytest.mark.parametrize("text", HONEST)
def test_an_honest_name_or_title_is_taken(tmp_path: Path, text: str) -> None:
    profile = load_profile(str(written(tmp_path, f'name = "{text}"\n[title]\npt-BR = "{text}"\n')))
    assert (profile.name, profile.titled("pt-BR"), profile.titled("en")) == (text, text, text)


@pytest.mark.parametrize("text", ["", "-", "  ", "–"])
def test_a_name_needs_a_letter(tmp_path: Path, text: str) -> None:
    assert refusal(written(tmp_path, f'name = "{text}"\n')).message == "profile.nameless"


def test_a_title_that_would_fill_the_first_lines_is_refused(tmp_path: Path) -> None:
    """What stands behind it would not be read."""
    assert load_profile(str(written(tmp_path, f'name = "{"n" * 200}"\n'))).name
    assert refusal(written(tmp_path, f'name = "{"n" * 201}"\n')).message == "profile.long-name"


def test_a_title_without_a_language_is_told_with_a_right_example(tmp_path: Path) -> None:
    error = refusal(written(tmp_path, 'name = "caderno"\ntitle = "Caderno"\n'))
    assert (error.message, error.fields["line"]) == ("toml.wrong-value", 3)
    path = written(tmp_path, f'name = "caderno"\n{error.fields["example"]}\n')
    assert load_profile(str(path)).titled("pt-BR") in str(error.fields["example"])


def test_letters_that_are_composed_or_not_are_the_same() -> None:
    assert odd_letters("métrico") == odd_letters("me\u0301trico") == []
    assert odd_letters("b\u0301") == ["\u0301"], "there is no such letter"
    assert odd_letters("x\u200b") == ["\u200b"]


def test_a_shipped_name_in_other_letters_is_told_with_them() -> None:
    """The two names look the same: a message without the letter's number would say nothing."""
    with pytest.raises(ProfileError) as caught:
        load_profile("et-doc-foparq-\u0430")
    assert all("U+0430" in shown(caught.value, language) for language in LANGUAGES)


def test_every_shipped_profile_is_taken_for_itself() -> None:
    for name in shipped_profiles():
        assert mistaken_for(name)
        assert load_profile(name).shipped


def test_a_profile_of_ones_own_that_is_extended_may_not_bear_such_a_name_either(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text('name = "ET-DOC-FOPARQ-A"\n', encoding="utf-8")
    path = tmp_path / "regras.toml"
    path.write_text('extends = "base.toml"\nname = "caderno"\n', encoding="utf-8")
    assert "base.toml" in str(refusal(path).fields["file"])


def test_without_a_title_it_is_called_by_its_name_and_cites_nothing(tmp_path: Path) -> None:
    profile = load_profile(str(written(tmp_path, 'name = "caderno"\n')))
    assert (profile.titled("pt-BR"), profile.titled("en"), profile.norms) == ("caderno", "caderno", ())


def test_without_a_name_it_is_refused(tmp_path: Path) -> None:
    error = refusal(written(tmp_path, ""))
    assert (error.message, error.fields["key"]) == ("toml.missing-key", "name")
