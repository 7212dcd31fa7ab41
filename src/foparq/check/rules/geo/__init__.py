# SPDX-License-Identifier: MIT
"""Rules on one item's own geometry."""
