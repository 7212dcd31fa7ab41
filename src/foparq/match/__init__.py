# SPDX-License-Identifier: MIT
"""What is delivered against what it should belong to."""
