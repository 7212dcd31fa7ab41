# SPDX-License-Identifier: MIT
"""Meshes on the page: the surface that the view in space turns, and six fixed pictures of it."""
