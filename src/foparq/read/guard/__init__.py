# SPDX-License-Identifier: MIT
"""What may be opened, and readers bounded in time and memory."""
