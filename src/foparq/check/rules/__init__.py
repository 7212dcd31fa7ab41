# SPDX-License-Identifier: MIT
"""The rules: one file a rule, file name = rule name."""
