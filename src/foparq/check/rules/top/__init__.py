# SPDX-License-Identifier: MIT
"""Rules on items among each other."""
