# SPDX-License-Identifier: MIT
"""DXF drawings turned into GIS files by GDAL, as ogr2ogr and QGIS do it."""

import json
import os
import subprocess
import sys
from pathlib import Path

#: blocks become one collection each (GDAL's own way), rows of their own, or stay whole
WHOLE, APART = {"DXF_MERGE_BLOCK_GEOMETRIES": "TRUE"}, {"DXF_MERGE_BLOCK_GEOMETRIES": "FALSE"}
KEPT = {"DXF_INLINE_BLOCKS": "FALSE"}

_CONVERT = """
import json, os, sys, pyogrio
source, target, options, multi = json.loads(sys.argv[1])
pyogrio.set_gdal_config_options(options)
for layer in pyogrio.list_layers(source)[:, 0].tolist():
    meta, _, geometry, values = pyogrio.raw.read(source, layer=layer)
    chosen = [n for n, name in enumerate(meta["fields"]) if not name.startswith(("BlockScale", "BlockOCS"))]
    pyogrio.raw.write(
        target, geometry, [values[n] for n in chosen], [meta["fields"][n] for n in chosen], driver="GPKG",
        geometry_type="Unknown", crs=meta["crs"], layer=layer, append=os.path.exists(target), promote_to_multi=multi,
    )
"""


def export(source: Path, target: Path, options: dict[str, str], *, multi: bool = False) -> Path:
    """Every layer that GDAL sees of a DXF file; of newer ones it is told the encoding, which it takes for another.

    A process of its own, because this one may have been left with the drivers that foparq reads with.
    """
    newer = b"AC102" in source.read_bytes()[:1000]
    asked = {**options, "DXF_ENCODING": "UTF-8"} if newer else options
    told = json.dumps([str(source), str(target), asked, multi])
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("GDAL", "OGR", "CPL"))}
    subprocess.run([sys.executable, "-W", "ignore", "-c", _CONVERT, told], check=True, env=clean, capture_output=True)
    return target
