# SPDX-License-Identifier: MIT
"""DXF drawings turned into GIS files by GDAL, as ogr2ogr and QGIS do it."""

from pathlib import Path

import pyogrio

#: blocks become one collection each (GDAL's own way), rows of their own, or stay whole
WHOLE, APART = {"DXF_MERGE_BLOCK_GEOMETRIES": "TRUE"}, {"DXF_MERGE_BLOCK_GEOMETRIES": "FALSE"}
KEPT = {"DXF_INLINE_BLOCKS": "FALSE"}


def export(source: Path, target: Path, options: dict[str, str], *, multi: bool = False) -> Path:
    """Every layer that GDAL sees of a DXF file; of newer ones it is told the encoding, which it takes for another."""
    newer = b"AC102" in source.read_bytes()[:1000]
    asked = {**options, "DXF_ENCODING": "UTF-8"} if newer else options
    driver = {".gpkg": "GPKG", ".geojson": "GeoJSON"}[target.suffix]
    pyogrio.set_gdal_config_options(asked)
    try:
        for layer in pyogrio.list_layers(source)[:, 0].tolist():
            meta, _, geometry, values = pyogrio.raw.read(source, layer=layer)
            chosen = [n for n, name in enumerate(meta["fields"]) if not name.startswith(("BlockScale", "BlockOCS"))]
            pyogrio.raw.write(
                target, geometry, [values[n] for n in chosen], [meta["fields"][n] for n in chosen], driver=driver,
                geometry_type="Unknown", crs=meta["crs"], layer=layer, append=target.exists(), promote_to_multi=multi,
            )  # fmt: skip
    finally:
        pyogrio.set_gdal_config_options(dict.fromkeys(asked))
    return target
