# SPDX-License-Identifier: MIT
"""Drawings in DXF."""
