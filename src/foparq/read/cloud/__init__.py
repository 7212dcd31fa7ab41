# SPDX-License-Identifier: MIT
"""Clouds of points that a delivery is compared with."""
