# SPDX-License-Identifier: MIT
"""Drawings in GeoPackage, Shapefile and GeoJSON."""
