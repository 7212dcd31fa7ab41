# SPDX-License-Identifier: MIT
"""The folder of a delivery: drawing, tables, manifest."""

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from tests.tools.office_drawings import write_dxf, write_gpkg
from tests.tools.offices import METRES, Office, Style

_POINT_NAMES = (
    ["Ponto", "X", "Y", "Z", "X entregue", "Y entregue", "Z entregue"],
    ["id", "x", "y", "z", "xd", "yd", "zd"],
)
_DISTANCE_NAMES = (["Distância", "de", "para", "medida", "desenho"], ["id", "from", "to", "measured", "delivered"])
_PLACE_NAMES = ["x1", "y1", "z1", "x2", "y2", "z2"]


def write(office: Office, folder: Path) -> Path:
    """Write a delivery into a new folder.

    Returns
    -------
    Path
        The folder.
    """
    folder.mkdir(parents=True)
    name = f"fachada.{office.format}"
    (write_dxf if office.format == "dxf" else write_gpkg)(office, folder / name)
    _table(folder / "pontos.csv", office.style, points_table(office))
    _table(folder / "distancias.csv", office.style, distances_table(office))
    _table(folder / "feicoes.csv", office.style, features_table(office))
    for change in office.tamper:
        change(office, folder)
    (folder / "delivery.toml").write_text(manifest(office, name), encoding="utf-8")
    return folder


def number(office: Office, metres: float) -> str:
    """A length as the office's table shows it; empty if it is none."""
    if not np.isfinite(metres):
        return ""
    text = f"{metres / METRES[office.table_unit]:.{office.digits}f}"
    if not office.style.trailing and "." in text:
        text = text.rstrip("0").rstrip(".")
    return text.replace(".", ",") if office.style.comma else text


def points_table(office: Office) -> list[list[str]]:
    """Header and rows of the checkpoints."""
    width = 7 if office.told or office.delivered is not None else 4
    rows = zip(office.ids, office.surveyed, office.columns, strict=True)
    body = [[name, *(number(office, value) for value in (*one, *other))][:width] for name, one, other in rows]
    return [_POINT_NAMES[office.english][:width], *body]


def distances_table(office: Office) -> list[list[str]]:
    """Header and rows of the distances; the coordinates of the ends where the office gives them."""
    by_place = office.ends_by == "places"
    header = [*_DISTANCE_NAMES[office.english], *(_PLACE_NAMES if by_place else [])]
    body = []
    for row, (names, measured, length) in enumerate(zip(office.ends, office.measured, office.lengths, strict=True)):
        places = office.columns[list(office.rows[row])].ravel() if by_place else ()
        shown = [f"{end} canto" if by_place else end for end in names]
        body.append([f"D{row + 1:02d}", *shown, *(number(office, value) for value in (measured, length, *places))])
    return [header, *body]


def features_table(office: Office) -> list[list[str]]:
    """Header and rows of the specified features: one row a class, or one a feature."""
    kinds = [kind for kind in ("window", "door", "cornice", "panel") if office.facade.count(kind)]
    header = ["id", "class", "facade", "count"] if office.english else ["id", "classe", "fachada", "quantidade"]
    if office.seed % 2:
        return [header, *([kind.upper(), kind, "N", str(office.facade.count(kind))] for kind in kinds)]
    each = [(kind, k) for kind in kinds for k in range(office.facade.count(kind))]
    return [header, *([f"{kind[:3].upper()}-N-{k + 1:02d}", kind, "N", "1"] for kind, k in each)]


def manifest(office: Office, drawing: str) -> str:
    """Text of ``delivery.toml``: what is true, but for what is stated otherwise."""
    said = {
        "delivery": {"title": f"Escritório {office.seed}", "scale": f"1:{office.scale}", "language": "pt-BR"},
        "drawing": {"path": drawing, "unit": office.unit, "plane": office.plane, "facade": "N"},
        "checkpoints": {"path": "pontos.csv", "survey_sd": _mm(office.survey_sd), "unit": office.table_unit},
        "distances": {"path": "distancias.csv", "survey_sd": _mm(office.distance_sd), "unit": office.table_unit},
        "features": {"path": "feicoes.csv"},
    }  # fmt: skip
    classes = {layer: kind for kind, layer in office.layers.items() if kind != "wall"}
    lines: list[str] = []
    for section, values in said.items():
        if office.stated.get(section, {}).get("path", "") is None:
            continue
        lines.append(f"[[{section}]]" if section == "drawing" else f"[{section}]")
        every = values | office.stated.get(section, {})
        lines += [f"{key} = {_toml(value)}" for key, value in every.items() if value is not None]
        if section == "drawing":
            lines.append(f"classes = {_toml(classes)}")
        lines.append("")
    for other in office.stated.get("drawings", {}).values():
        lines += ["[[drawing]]", *(f"{key} = {_toml(value)}" for key, value in other.items()), ""]
    for one in office.confirmed:
        lines += ["[[confirmed]]", *(f"{key} = {_toml(value)}" for key, value in one.items()), ""]
    return "\n".join(lines)


def _mm(metres: float) -> str:
    return f"{metres * 1000:.4f} mm"


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f'"{key}" = {_toml(one)}' for key, one in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def _table(path: Path, style: Style, rows: Sequence[Sequence[str]]) -> None:
    text = io.StringIO()
    quoting = csv.QUOTE_ALL if style.quoted else csv.QUOTE_MINIMAL
    csv.writer(text, delimiter=style.separator, quoting=quoting, lineterminator="\r\n").writerows(rows)
    path.write_bytes(text.getvalue().encode(style.encoding))
