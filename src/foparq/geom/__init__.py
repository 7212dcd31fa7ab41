# SPDX-License-Identifier: MIT
"""Kernels of plane geometry on numpy and shapely arrays."""
