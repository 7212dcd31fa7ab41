# SPDX-License-Identifier: MIT
"""Names that people write, compared as people read them."""

import unicodedata


def folded(name: str) -> str:
    """Name without regard to case, blanks around it, and whether accents are composed.

    Examples
    --------
    >>> folded(" Pe\u0301-direito ") == folded("P\u00c9-DIREITO")
    True
    """
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name.strip()).casefold())
