# SPDX-License-Identifier: MIT
"""Case, accents in either composition, plurals: one name."""

import unicodedata
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foparq.errors import UnreadableError
from foparq.profile.manifest import SurveySection
from foparq.read.table.tables import read_checkpoints, read_feature_list

USES = {
    "required": ["required", "obrigatório", "obrigatória", "exigido", "exigidas", "obligatorio", "obligatorias"],
    "optional": ["optional", "opcional", "opcionais", "opcionales", "facultativo", "facultativas"],
    "prohibited": ["prohibited", "proibido", "proibidas", "vedado", "vedadas", "prohibido", "prohibidas"],
}
FORMS = ("NFC", "NFD", "NFKC", "NFKD")


def spelled(name: str) -> st.SearchStrategy[str]:
    """A name in any case, with or without accents, composed or decomposed."""
    bare = "".join(c for c in unicodedata.normalize("NFKD", name) if not unicodedata.combining(c))
    cases = st.sampled_from([str.lower, str.upper, str.title])
    return st.builds(
        lambda text, case, form: unicodedata.normalize(form, case(text)),
        st.sampled_from([name, bare]), cases, st.sampled_from(FORMS),
    )  # fmt: skip


def written(folder: Path, text: str) -> Path:
    path = folder / "t.csv"
    path.write_text(text, encoding="utf-8")
    return path


@settings(max_examples=120, deadline=None, derandomize=True)
@given(st.sampled_from([(use, word) for use, words in USES.items() for word in words]).flatmap(
    lambda pair: st.tuples(st.just(pair[0]), spelled(pair[1]), st.booleans())
))  # fmt: skip
def test_one_use_in_every_spelling(tmp_path_factory: pytest.TempPathFactory, pair: tuple[str, str, bool]) -> None:
    use, word, plural = pair
    text = f"id;classe;exigência\nA;janela;{word}{'s' if plural and not word.lower().endswith('s') else ''}\n"
    assert read_feature_list(written(tmp_path_factory.mktemp("t"), text)).use.tolist() == [use]


@pytest.mark.parametrize("word", ["obriga", "não", "s", "opc", "required?"])
def test_an_unknown_use_is_refused(tmp_path: Path, word: str) -> None:
    with pytest.raises(UnreadableError, match=r"table\.use-unknown"):
        read_feature_list(written(tmp_path, f"id;class;use\nA;window;{word}\n"))


@settings(max_examples=40, deadline=None, derandomize=True)
@given(spelled("código"), spelled("x restituído"), spelled("elevação"))
def test_one_column_in_every_spelling(
    tmp_path_factory: pytest.TempPathFactory, name: str, delivered: str, height: str
) -> None:
    text = f"{name};este;norte;{height};{delivered}\nP1;1.5;2.5;3.5;1.25\n"
    points = read_checkpoints(written(tmp_path_factory.mktemp("t"), text), SurveySection(path="t"))
    assert points.surveyed.tolist() == [[1.5, 2.5, 3.5]]
    assert points.delivered[0, 0] == 1.25


@pytest.mark.parametrize("header", ["Pontos;classes;fachadas;quantidades", "Puntos;Clases;Fachadas;Cantidad"])
def test_plural_headers(tmp_path: Path, header: str) -> None:
    rows = read_feature_list(written(tmp_path, f"{header}\nA;janela;N;3\n"))
    assert (rows.facade.tolist(), rows.count.tolist(), rows.ignored) == (["N"], [3], ())
