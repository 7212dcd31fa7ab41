# SPDX-License-Identifier: MIT
"""Meshes as delivered: one module a format, each with a parser of its own.

trimesh is not used: it merges vertices, splits an OBJ where texture coordinates differ, cuts polygons into triangles
and leaves out what it takes for degenerate. The auditor must see the file.
"""
