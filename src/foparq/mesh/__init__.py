# SPDX-License-Identifier: MIT
"""Kernels on surfaces of polygons, as plain arrays.

The vertices are ``points`` (n, 3). The faces are ragged polygons: ``corners`` (m,) holds the vertex of every corner,
``starts`` (f + 1,) the first corner of every face, so that face i has ``corners[starts[i]:starts[i + 1]]``. Corner c is
also the side that begins there. Kernels receive faces of at least three corners whose vertices exist and are finite.
Coordinates beyond 1e150 are too far apart for their squares: what is measured of them is infinite or no number.
"""
