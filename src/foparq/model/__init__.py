# SPDX-License-Identifier: MIT
"""Delivered things: drawings, tables and the delivery that holds them."""
