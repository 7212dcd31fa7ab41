# SPDX-License-Identifier: MIT
"""The command: arguments and exit codes. Nothing is decided here."""
