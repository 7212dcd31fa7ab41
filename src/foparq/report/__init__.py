# SPDX-License-Identifier: MIT
"""Writers: one kind of report each."""
