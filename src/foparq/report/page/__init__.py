# SPDX-License-Identifier: MIT
"""The page for people: ``report.html``."""
