# SPDX-License-Identifier: MIT
"""Rules on files and formats."""
