# SPDX-License-Identifier: MIT
"""Names as people write them: accents, case, singular and plural."""

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foparq.model.layers import matches
from foparq.names import folded, of_kind, unaccented

PLURALS = [
    ("janela", "janelas"), ("porta", "portas"), ("vão", "vãos"), ("portão", "portões"), ("painel", "painéis"),
    ("capitel", "capitéis"), ("gradil", "gradis"), ("portal", "portais"), ("pilar", "pilares"), ("óculo", "óculos"),
    ("flor", "flores"), ("luz", "luzes"), ("torre", "torres"), ("grade", "grades"), ("cornija", "cornijas"),
    ("window", "windows"), ("door", "doors"), ("arch", "arches"), ("cornice", "cornices"), ("grille", "grilles"),
    ("balcony", "balconies"), ("fixture", "fixtures"), ("cross", "crosses"), ("ornament", "ornaments"),
    ("base", "bases"), ("frieze", "friezes"),
]  # fmt: skip


@pytest.mark.parametrize(("one", "many"), PLURALS)
def test_singular_and_plural_are_one_kind(one: str, many: str) -> None:
    for form in ("NFC", "NFD"):
        assert of_kind(one) == of_kind(unicodedata.normalize(form, many.upper()))
    assert of_kind(f"{one} de ferro") == of_kind(f" {many}  de ferro ")


def test_kinds_stay_apart() -> None:
    assert len({of_kind(one) for one, _ in PLURALS}) == len(PLURALS)
    assert of_kind("S") != of_kind("")


@given(st.text(max_size=12))
def test_composition_case_and_repetition_change_nothing(name: str) -> None:
    for key in (folded, unaccented, of_kind):
        assert key(unicodedata.normalize("NFD", name)) == key(unicodedata.normalize("NFC", name))
    assert folded(folded(name)) == folded(name)


def test_layers_match_however_their_accents_are_composed() -> None:
    assert matches("VA\u0303O_1", ("v\u00e3o*",))
    assert matches("V\u00c3O_1", ("va\u0303o_?",))
