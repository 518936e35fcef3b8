"""Makes matplotlib's svg fit to stand inside the page: slim, with its own anchors, in the page's colours."""

from __future__ import annotations

import hashlib
import re
from html import escape

from cross_check.report.palette import GRID, INK, LIGHT

COLORS = {INK: "currentColor", GRID: "var(--grid)"} | {color: f"var(--{hue})" for hue, color in LIGHT.items()}
DROPPED = (
    re.compile(r"<metadata>.*?</metadata>", re.DOTALL),
    re.compile(r"<defs>\s*<style[^>]*>.*?</style>\s*</defs>", re.DOTALL),
    re.compile(r"<!--.*?-->", re.DOTALL),
    re.compile(r" transform=\"rotate\(-0 [^\"]*\""),
    re.compile(r"; stroke-dashoffset: 0"),
    re.compile(r"(?<=<g) id=\"[^\"]*\""),
)
TAG = re.compile(r"<[^>]*>")
FAMILY = "font-family: 'DejaVu Sans', sans-serif; "
FONT = re.compile(r"font: (?:\d+ )?([\d.]+px) [^;\"]*")
NUMBER = re.compile(r"-?\d+\.\d{3,}")
ANCHOR = re.compile(r"(?<=<path id=\")[^\"]+|(?<=<clipPath id=\")[^\"]+")
REFERENCE = re.compile(r"( id=\"|url\(#|href=\"#)([^\")]+)")
MARKS = re.compile(r"<g((?: [^>]*)?)>((?:<use [^>]* style=\"[^\"]*\"/>)+)</g>")
MARK_STYLE = re.compile(r" style=\"([^\"]*)\"")
OUTLINE = re.compile(r" d=\"(M [^\"]*)\"")


def slim(svg: str, name: str, title: str) -> str:
    """The `<svg>` element alone; `name` keeps its anchors apart from other figures, `title` is read aloud."""
    body = svg[svg.index("<svg") :]
    for pattern in DROPPED:
        body = pattern.sub("", body)
    opening, _, rest = body.partition(">")
    box = re.search(r"viewBox=\"[^\"]*\"", opening)
    rest = re.sub(r"\s*\n\s*", " ", re.sub(r">\s+<", "><", rest)).strip()
    short = _short_anchors(rest, name)
    rest = TAG.sub(lambda match: _slim_tag(match.group(0), short), rest)  # never the text of a label
    rest = MARKS.sub(_styled_once, rest)
    rest = OUTLINE.sub(_tight, rest)
    label = escape(title, quote=True)
    return f'<svg {box.group(0) if box else ""} role="img" aria-label="{label}">{rest}'


def _rounded(match: re.Match[str]) -> str:
    return f"{float(match.group(0)):.2f}".rstrip("0").rstrip(".")


def _short_anchors(body: str, name: str) -> dict[str, str]:
    """Anchors as short as can be that no other figure of the page has."""
    prefix = "f" + hashlib.blake2b(name.encode(), digest_size=4).hexdigest()
    return {anchor: f"{prefix}-{place}" for place, anchor in enumerate(dict.fromkeys(ANCHOR.findall(body)))}


def _slim_tag(tag: str, anchors: dict[str, str]) -> str:
    tag = NUMBER.sub(_rounded, tag)
    tag = FONT.sub(r"font-size: \1", tag).replace("xlink:href", "href").replace(FAMILY, "")
    tag = REFERENCE.sub(lambda match: match.group(1) + anchors.get(match.group(2), match.group(2)), tag)
    for color, themed in COLORS.items():
        tag = tag.replace(color, themed)
    return tag


def _styled_once(match: re.Match[str]) -> str:
    """Marks of one style: the style moves to the group around them."""
    attributes, marks = match.groups()
    styles = set(MARK_STYLE.findall(marks))
    if len(styles) != 1:
        return match.group(0)
    return f'<g{attributes} style="{styles.pop()}">{MARK_STYLE.sub("", marks)}</g>'


def _tight(match: re.Match[str]) -> str:
    """A path of straight lines without the letters that svg lets out: pairs after M are line ends."""
    outline = match.group(1).strip()
    if re.search("[^-0-9. ML]", outline):
        return f' d="{outline}"'
    return ' d="' + outline.replace(" L ", " ").replace("M ", "M") + '"'
