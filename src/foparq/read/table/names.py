# SPDX-License-Identifier: MIT
"""Names that people give to the columns and uses in a table, in English, Portuguese and Spanish.

Compared without case, accents, blanks, a plural ``s``, and a unit in brackets at the end.
"""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from functools import cache

from foparq.units import LENGTHS

Names = Mapping[str, Sequence[str]]  #: our name of a column to the names that people give it

_ID = (
    "ponto", "point", "punto", "pto", "nome", "name", "nombre", "código", "code", "identificador", "ident", "nº", "n°",
    "no", "#",
)  # fmt: skip
CHECKPOINT_COLUMNS: Names = {
    "id": _ID,
    "x": ("e", "este", "leste", "easting", "x levantado", "x surveyed", "x campo", "x referência", "x ref"),
    "y": ("n", "norte", "northing", "y levantado", "y surveyed", "y campo", "y referência", "y ref"),
    "z": (
        "h", "cota", "altitude", "altitud", "height", "elevation", "elevação", "elevación",
        "z levantado", "z surveyed", "z campo", "z referência", "z ref",
    ),
    **{
        f"{axis}d": tuple(
            f"{axis} {word}"
            for word in (
                "entregue", "delivered", "entregado", "desenho", "drawing", "dibujo", "restituído", "medido",
            )
        )
        for axis in "xyz"
    },
}  # fmt: skip
DISTANCE_COLUMNS: Names = {
    "id": (*_ID, "distância", "distance"),
    "from": ("de", "desde", "start", "início", "do ponto", "del punto", "point a", "ponto a", "punto a"),
    "to": ("para", "até", "hasta", "end", "fim", "fin", "ao ponto", "al punto", "point b", "ponto b", "punto b"),
    "measured": ("medida", "medido", "trena", "tape", "cinta", "referência", "reference", "campo"),
    "delivered": (
        "entregue", "entregado", "entregada", "desenho", "drawing", "dibujo", "restituída", "restituído",
    ),
    **{f"{axis}{end}": (f"{axis} {name}",) for end, name in ((1, "de"), (2, "para")) for axis in "xyz"},
}  # fmt: skip
FEATURE_COLUMNS: Names = {
    "id": (*_ID, "feição", "feature"),
    "class": ("classe", "clase", "feature class", "tipo", "categoria"),
    "facade": ("fachada", "façade", "lado", "elevation", "elevação", "elevación", "alzado"),
    "count": ("quantidade", "qtd", "qtde", "contagem", "quantity", "cantidad", "cant"),
    "use": ("uso", "exigência", "obrigatoriedade", "obligatoriedad"),
    "omission_accepted": (
        "omissão aceita", "motivo da omissão", "accepted omission", "omisión aceptada", "motivo de la omisión",
    ),
    "evidence": (
        "evidência", "prova", "comprovação", "justificativa", "evidencia", "prueba", "justificación",
    ),
    **{axis: (f"{axis} referência", f"{axis} ref", f"posição {axis}", f"posición {axis}") for axis in "xyz"},
    "tol": ("tolerância", "tolerancia", "tolerance", "raio", "radio", "radius"),
}  # fmt: skip
_USES: Names = {
    "required": (
        "", "required", "mandatory", "obrigatório", "obrigatória", "exigido", "exigida", "obligatorio", "obligatoria",
    ),
    "optional": ("optional", "opcional", "opcionais", "opcionales", "facultativo", "facultativa"),
    "prohibited": ("prohibited", "forbidden", "proibido", "proibida", "vedado", "vedada", "prohibido", "prohibida"),
}  # fmt: skip
_IN_BRACKETS = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_SHORTEST_PLURAL = 4  #: letters


def unit_in_header(name: str) -> str:
    """Unit that a column's name carries in brackets: ``"mm"`` of ``"X (mm)"``; ``""`` if none."""
    found = _IN_BRACKETS.search(name)
    return found[1] if found and found[1] in LENGTHS else ""


def plain_name(name: str) -> str:
    """Name of a column as it is compared.

    Examples
    --------
    >>> plain_name("X Referência (mm)"), plain_name("Obrigatórios")
    ('xreferencia', 'obrigatorio')
    """
    return plain_word(_IN_BRACKETS.sub("", name))


def use_of(word: str) -> str:
    """Whether a feature is ``"required"``, ``"optional"`` or ``"prohibited"``; ``""`` if the word is not known.

    Examples
    --------
    >>> use_of("OBRIGATORIOS"), use_of(""), use_of("talvez")
    ('required', 'required', '')
    """
    return _uses().get(plain_word(word), "")


@cache
def _uses() -> Mapping[str, str]:
    return {plain_word(word): use for use, words in _USES.items() for word in words}


def plain_word(word: str) -> str:
    """Word without case, accents, blanks, points, dashes and a plural ``s``."""
    letters = unicodedata.normalize("NFKD", unicodedata.normalize("NFKC", word).casefold())
    bare = re.sub(r"[\s_.\-]+", "", "".join(c for c in letters if not unicodedata.combining(c)))
    bare = bare.lstrip("#/") or bare  # what some programs put before a header
    return bare.removesuffix("s") if len(bare) >= _SHORTEST_PLURAL else bare
