# SPDX-License-Identifier: MIT
"""Where a name may be broken to fit its column: never within a word that has room."""

import re

from markupsafe import Markup

_WHOLE = 16  #: letters that every column has room for
_LONGEST = 255  #: letters of a name that is looked at for its parts
_SEAMS = re.compile(r"(?<=[_\-.$|/])(?=[^_\-.$|/])")


def breakable(text: str) -> Markup:
    """Text with places to break its words after separators; a part too long for a column may be broken anywhere.

    Examples
    --------
    >>> str(breakable("on layer ESQUADRIA_PORTA")), str(breakable("MURO_DE_FECHO_NORTE"))
    ('on layer ESQUADRIA_PORTA', 'MURO_<wbr>DE_<wbr>FECHO_<wbr>NORTE')
    """
    return Markup(" ").join(_word(word) if len(word) > _WHOLE else word for word in text.split(" "))


def _word(text: str) -> Markup:
    parts = _SEAMS.split(text) if len(text) <= _LONGEST else [text]
    if max(map(len, parts)) > _WHOLE:
        return Markup('<span class="torn">%s</span>') % Markup("<wbr>").join(parts)
    return Markup("<wbr>").join(parts)
