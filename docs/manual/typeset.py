"""Equations of the pages, from TeX to MathML: browsers draw it without a script or a font of another host."""

from __future__ import annotations

import re

from latex2mathml.converter import convert

_INLINE = re.compile(r"(?<![\\\w$`])\$(?=\S)([^$\n`]+?)(?<=\S)\$(?![\w$])")


def display(tex: str) -> str:
    """Equations of their own lines, one for each line of the block; those of a line wrap on a narrow screen."""
    lines = [line.strip() for line in tex.strip().split("\n") if line.strip()]
    made = ["".join(f"<span>{convert(each, display='block')}</span>" for each in parts(line)) for line in lines]
    return "\n\n".join(f'<div class="equation">{line}</div>' for line in made)


def parts(line: str) -> list[str]:
    r"""The equations of a line, which `\qquad` divides.

    Example
        >>> parts(r"a = b, \qquad c = d")
        ['a = b,', 'c = d']
    """
    return [each.strip() for each in line.split(r"\qquad")]


def inline(text: str) -> str:
    """A line of text whose `$...$` are typeset, within a span: Markdown takes a `math` that begins a line for a block.

    Example
        >>> inline("$i$ is the ratio").startswith('<span><math xmlns')
        True
        >>> inline("a price of 5 $ and 6 $")
        'a price of 5 $ and 6 $'
    """
    return _INLINE.sub(lambda found: f"<span>{convert(found[1])}</span>", text)
