# SPDX-License-Identifier: MIT
"""foparq audits photogrammetric documentation of architectural heritage."""

__version__ = "0.1.0"
__all__ = ["__version__"]
