# SPDX-License-Identifier: MIT
"""What evaluates quality elements: one module a kind."""
