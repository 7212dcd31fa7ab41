# SPDX-License-Identifier: MIT
"""Rules: what they are, what they look at, and how they run."""
