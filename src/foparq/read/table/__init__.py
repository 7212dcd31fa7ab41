# SPDX-License-Identifier: MIT
"""Tables of checkpoints, distances and features."""
