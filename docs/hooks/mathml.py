"""Formulas as MathML, which browsers draw by themselves: no script, nothing to load."""

from __future__ import annotations

import html
import re

from latex2mathml.converter import convert

FORMULA = re.compile(
    r'<(?P<tag>span|div) class="arithmatex">\\[(\[](?P<latex>.*?)\\[)\]]</(?P=tag)>', re.DOTALL
)
TAG = re.compile(r"\\tag\{(?P<number>[^}]*)\}")


def on_page_content(content: str, **_: object) -> str:
    """Replace what the extension arithmatex marks as a formula."""
    return FORMULA.sub(_as_mathml, content)


def _as_mathml(formula: re.Match[str]) -> str:
    latex = html.unescape(formula["latex"]).strip()
    if formula["tag"] == "span":
        return convert(latex)
    number = TAG.search(latex)
    shown = convert(TAG.sub("", latex), display="block")
    label = f'<span class="number">({number["number"]})</span>' if number else ""
    return f'<div class="formula">{shown}{label}</div>'
