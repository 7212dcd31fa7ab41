# SPDX-License-Identifier: MIT
"""What tables and lists say of meshes."""
