# SPDX-License-Identifier: MIT
"""From what was found to the quality report after ISO 19157."""
