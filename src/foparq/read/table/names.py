# SPDX-License-Identifier: MIT
"""Names that people give to the columns and uses in a table, in English, Portuguese and Spanish.

Compared without case, accents, blanks, a plural ``s``, and a unit in brackets at the end.
"""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from functools import cache

from foparq.units import unit_named

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
    "measured": (
        "medida", "medido", "trena", "tape", "cinta", "referência", "reference", "campo", "medida em campo",
        "field length", "medida en campo",
    ),
    "delivered": (
        "entregue", "entregado", "entregada", "desenho", "drawing", "dibujo", "restituída", "restituído",
        "CAD", "medida no desenho", "drawing length", "medida en el dibujo",
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
#: a length, and where it was taken: the two together name a column, in either order
_LENGTHS = (
    "medida", "medição", "distância", "comprimento", "dimensão", "valor", "length", "distance", "measurement", "value",
    "longitud", "medición",
)  # fmt: skip
_IN_FIELD = (
    "em campo", "de campo", "no campo", "campo", "in loco", "no local", "na obra", "no edifício", "levantada",
    "levantado", "medida", "medido", "real", "com trena", "à trena", "trena", "field", "in the field", "on site",
    "surveyed", "measured", "taped", "en campo", "en obra", "con cinta",
)  # fmt: skip
_IN_DRAWING = (
    "no desenho", "do desenho", "de desenho", "desenho", "na prancha", "no CAD", "CAD", "no DXF", "DXF", "entregue",
    "desenhada", "desenhado", "restituída", "restituído", "na restituição", "no produto", "drawing", "in the drawing",
    "drawn", "delivered", "en el dibujo", "del dibujo", "dibujo", "entregada",
)  # fmt: skip
#: names made of two words, beside those above
DISTANCE_PHRASES: Names = {
    column: tuple(name for noun in _LENGTHS for word in words for name in (f"{noun} {word}", f"{word} {noun}"))
    for column, words in (("measured", _IN_FIELD), ("delivered", _IN_DRAWING))
}
_SURVEYED = (
    "em campo",
    "de campo",
    "levantada",
    "topografia",
    "estação total",
    "real",
    "field",
    "surveyed",
    "en campo",
)
_DELIVERED = (
    "no desenho", "do desenho", "no CAD", "CAD", "DXF", "desenhada", "restituída", "fotogrametria",
    "in the drawing", "drawn", "en el dibujo",
)  # fmt: skip
CHECKPOINT_PHRASES: Names = {
    f"{axis}{end}": tuple(f"{name} {word}" for name in (axis, f"coordenada {axis}") for word in words)
    for axis in "xyz"
    for end, words in (("", (*_SURVEYED, "")), ("d", (*_DELIVERED, "entregue", "desenho")))
}
_USES: Names = {
    "required": (
        "", "required", "mandatory", "obrigatório", "obrigatória", "exigido", "exigida", "obligatorio", "obligatoria",
    ),
    "optional": ("optional", "opcional", "opcionais", "opcionales", "facultativo", "facultativa"),
    "prohibited": ("prohibited", "forbidden", "proibido", "proibida", "vedado", "vedada", "prohibido", "prohibida"),
}  # fmt: skip
_IN_BRACKETS = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_BETWEEN = re.compile(r"[\s,;/]+")  #: words in these brackets
_SHORTEST_PLURAL = 4  #: letters


def unit_in_header(name: str) -> str:
    """Unit that a column's name carries in brackets: ``"mm"`` of ``"X (mm)"``; ``""`` if none.

    Examples
    --------
    >>> unit_in_header("Medida (desenho, MM)"), unit_in_header("X [em metros]"), unit_in_header("Medida (in loco)")
    ('mm', 'm', '')
    """
    found = _IN_BRACKETS.search(name)
    words = [part.split()[-1:] for part in re.split("[,;/]", found[1])] if found else []
    return next((unit for word in words if (unit := unit_named(*word or [""]))), "")


def column_of(name: str, ours: Mapping[str, str]) -> str | None:
    """Our name of a column, by what its name says with and without what stands in brackets.

    Parameters
    ----------
    ours : mapping
        Plain names to our names.

    Examples
    --------
    >>> ours = {"medida": "measured", "medidadesenho": "delivered"}
    >>> column_of("Medida (desenho, m)", ours), column_of("Medida (m)", ours), column_of("Nota", ours)
    ('delivered', 'measured', None)
    """
    found = _IN_BRACKETS.search(name)
    if found:
        said = " ".join(part for part in re.split(_BETWEEN, found[1]) if not unit_named(part))
        if (column := ours.get(plain_word(f"{name[: found.start()]} {said}"))) is not None:
            return column
    return ours.get(plain_name(name))


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
