# SPDX-License-Identifier: MIT
"""Kinds of parts as the rules see them: one module a kind."""
