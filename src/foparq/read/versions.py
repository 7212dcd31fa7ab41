# SPDX-License-Identifier: MIT
"""Versions of the libraries that read files, and whether they can."""

import re
from importlib import metadata

_DRIVERS = ("GPKG", "ESRI Shapefile", "GeoJSON")
_EXTRAS = ("laspy", "lazrs")  #: read LAS and LAZ where they are installed
#: a library that a wheel carries has its version in its name: ``libgdal-253d08a6.so.38.3.12.4``
_CARRIED = r"^lib{name}[^/]*(?:\.so\.[0-9]+\.(?P<so>[0-9.]+)|\.[0-9]+\.(?P<dylib>[0-9]+\.[0-9.]+)\.dylib)$"


def reader_versions() -> dict[str, str]:
    """Version of every library there that decides what is read; none is loaded for it where its name tells."""
    return {
        "GDAL": _carried("pyogrio", "gdal") or _loaded_gdal(),
        "PROJ": _carried("pyproj", "proj") or _loaded_proj(),
        "ezdxf": metadata.version("ezdxf"),
        "openpyxl": metadata.version("openpyxl"),
        "pyogrio": metadata.version("pyogrio"),
        **{name: version for name in _EXTRAS if (version := _version(name))},
    }


def drivers() -> dict[str, bool]:
    """GDAL drivers that foparq reads through, and whether they are there."""
    import pyogrio  # noqa: PLC0415 - a DXF is read without it

    known = pyogrio.list_drivers()
    return {name: name in known for name in _DRIVERS}


def _version(package: str) -> str:
    """Version of a package; ``""`` where it is not installed."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def _carried(package: str, name: str) -> str:
    pattern = re.compile(_CARRIED.replace("{name}", name))
    for file in metadata.files(package) or ():
        if found := pattern.match(file.name):
            return found["so"] or found["dylib"]
    return ""


def _loaded_gdal() -> str:
    import pyogrio  # noqa: PLC0415

    return ".".join(map(str, pyogrio.__gdal_version__))


def _loaded_proj() -> str:
    import pyproj  # noqa: PLC0415

    return str(pyproj.proj_version_str)
