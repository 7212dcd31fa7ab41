# SPDX-License-Identifier: MIT
"""Versions of the libraries that read files, and whether they can."""

from importlib.metadata import version

import pyogrio
import pyproj

_DRIVERS = ("GPKG", "ESRI Shapefile", "GeoJSON")


def reader_versions() -> dict[str, str]:
    """Version of every library that decides what is read."""
    return {
        "GDAL": ".".join(map(str, pyogrio.__gdal_version__)),
        "PROJ": pyproj.proj_version_str,
        "ezdxf": version("ezdxf"),
        "pyogrio": version("pyogrio"),
    }


def drivers() -> dict[str, bool]:
    """GDAL drivers that foparq reads through, and whether they are there."""
    known = pyogrio.list_drivers()
    return {name: name in known for name in _DRIVERS}
