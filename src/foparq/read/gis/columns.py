# SPDX-License-Identifier: MIT
"""Columns of a table that are read, by their names."""


def _written(*names: str) -> tuple[str, ...]:
    # GeoPackages keep the case of letters, databases between them may not.
    return tuple(dict.fromkeys(way for name in names for way in (name, name.lower(), name.upper())))


#: columns whose text is the layer of a row, as CAD programs export it
LAYER_COLUMNS = ("layer", "Layer", "LAYER", "camada", "Camada", "CAMADA")
PAPER_COLUMNS = _written("PaperSpace")
#: columns of GDAL's DXF driver; a Shapefile keeps ten letters of a name
CAD_COLUMNS = {
    "subclasses": _written("SubClasses"), "handle": _written("EntityHandle", "EntityHand"), "text": _written("Text"),
    "inserted": _written("BlockName"), "defined": _written("Block"),
}  # fmt: skip
#: columns of texts that are read
TEXT_COLUMNS = (*LAYER_COLUMNS, *(name for names in CAD_COLUMNS.values() for name in names))
READ_COLUMNS = [*TEXT_COLUMNS, *PAPER_COLUMNS]
#: types of columns that hold geometry
GEOMETRY_TYPES = frozenset({
    "GEOMETRY", "POINT", "LINESTRING", "POLYGON", "MULTIPOINT", "MULTILINESTRING", "MULTIPOLYGON", "GEOMETRYCOLLECTION",
    "CIRCULARSTRING", "COMPOUNDCURVE", "CURVEPOLYGON", "MULTICURVE", "MULTISURFACE", "CURVE", "SURFACE",
})  # fmt: skip
