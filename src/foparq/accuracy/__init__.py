# SPDX-License-Identifier: MIT
"""Kernels of positional accuracy on numpy arrays."""
