# SPDX-License-Identifier: MIT
"""Rules on meshes."""
