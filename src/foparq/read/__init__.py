# SPDX-License-Identifier: MIT
"""File formats: what is delivered becomes columns, bounded in time and space, and nothing is ever written."""

import os

# GDAL decides once, when it is loaded, which drivers it has and whether it may reach the network. A delivery is
# hostile input: only the drivers that are asked for by name stay, and a person's own setting is respected.
_UNWANTED = (
    "ADBC AIVector AmigoCloud AVCBin AVCE00 Carto CSV CSW DGN DXF EDIGEO EEDA Elasticsearch ESRIJSON FlatGeobuf GDALG "
    "GeoJSONSeq GeoRSS GML GPSBabel GPX GTFS HTTP Idrisi JML JSONFG KML LIBKML LVBAG MapInfo_File MapML MBTiles "
    "MiraMonVector MVT NGW OAPIF ODS OGCAPI OGR_GMT OGR_PDS OGR_VRT OpenFileGDB OSM PCIDSK PDF PDS4 PGDUMP PLSCENES "
    "PMTiles S57 Selafin SQLite SXF TopoJSON VDV VFK VICAR WAsP WFS XLSX"
)
os.environ.setdefault("OGR_SKIP", ",".join(name.replace("MapInfo_File", "MapInfo File") for name in _UNWANTED.split()))
os.environ.setdefault("CPL_VSIL_CURL_ALLOWED_EXTENSIONS", ".never")
os.environ.setdefault("PROJ_NETWORK", "OFF")
# GDAL would otherwise write to the terminal about names in that list that its build lacks.
os.environ.setdefault("CPL_LOG", os.devnull)
