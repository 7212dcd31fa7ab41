# SPDX-License-Identifier: MIT
"""Tables of a delivery, held against its parts."""
