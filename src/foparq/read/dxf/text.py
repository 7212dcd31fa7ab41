# SPDX-License-Identifier: MIT
"""Names and letterings of a DXF file as people see them."""

import re
from typing import Any

from ezdxf.lldxf.encoding import decode_dxf_unicode, decode_mif_to_unicode
from ezdxf.tools.text import fast_plain_mtext, plain_text

_SURROGATE = re.compile("[\ud800-\udfff]")  #: stands for bytes that the encoding does not know
_STACK = re.compile(r"\\S([^;^#/]*)[\^#/]([^;]*);")
_LONGEST = 2_000  #: letters that are looked at; the cost of the patterns grows with their square
_TOLERANCE_STACK = re.compile(r"\\S[^;^#/]*\^[^;]*;")


def readable(name: str) -> str:
    r"""Name with the escapes ``\U+00E7`` and ``\M+n....`` decoded and undecodable bytes shown as U+FFFD."""
    if "\\" in name:
        name = decode_mif_to_unicode(decode_dxf_unicode(name))
    return _SURROGATE.sub("\ufffd", name)


def override_text(text: str) -> str:
    """Lettering of a dimension that replaces the measured length; ``""`` if it only repeats it."""
    return "" if text.strip() in ("", "<>") or "<>" in text else plain_lettering(text)


def plain_lettering(text: str) -> str:
    """Beginning of a lettering without formatting codes; stacked fractions as ``1/2``, stacked tolerances left out."""
    fractions = _STACK.sub(r" \1/\2", _TOLERANCE_STACK.sub("", text[:_LONGEST]))
    return " ".join(str(fast_plain_mtext(fractions)).split())[:_LONGEST]


def rendered_text(entity: Any) -> str:  # noqa: ANN401 - ezdxf entities share no useful type
    """Lettering of a TEXT or MTEXT."""
    if entity.dxftype() == "MTEXT":
        return plain_lettering(entity.text)
    return " ".join(plain_text(entity.dxf.text[:_LONGEST]).split())
