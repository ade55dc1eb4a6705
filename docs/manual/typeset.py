"""Equations of the pages, from TeX to MathML: browsers draw it without a script or a font of another host."""

from __future__ import annotations

import re

from latex2mathml.converter import convert

_INLINE = re.compile(r"(?<![\\\w$`])\$(?=\S)([^$\n`]+?)(?<=\S)\$(?![\w$])")


def display(tex: str) -> str:
    """Equations of their own lines, one for each line of the block."""
    lines = [line.strip() for line in tex.strip().split("\n") if line.strip()]
    return "\n\n".join(f'<div class="equation">{convert(line, display="block")}</div>' for line in lines)


def inline(text: str) -> str:
    """A line of text whose `$...$` are typeset.

    Example
        >>> inline("the ratio $i$ of").startswith('the ratio <math xmlns')
        True
        >>> inline("a price of 5 $ and 6 $")
        'a price of 5 $ and 6 $'
    """
    return _INLINE.sub(lambda found: convert(found[1]), text)
