# SPDX-License-Identifier: MIT
"""Found things: what rules return, and the one table of all findings."""
