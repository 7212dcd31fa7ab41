# SPDX-License-Identifier: MIT
"""Rules on layers and units."""
