"""HTML and SVG as trees, to look into: what is not well formed is refused."""

from __future__ import annotations

import re
from html import unescape
from xml.etree import ElementTree

_STYLE = re.compile(r"<style>.*?</style>", re.S)


def parsed(shown):
    """The root element; tags without their namespace."""
    root = ElementTree.fromstring(_STYLE.sub("", shown))
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    return root


def numbers(root):
    """The exact numbers that are shown, in order, each checked against what the eye sees."""
    found = []
    for data in root.iter("data"):
        value, seen = data.get("value"), data.text
        digits = len(seen.partition(".")[2])
        assert f"{float(value):.{digits}f}" == seen
        found.append(float(value))
    return found


def words(root):
    """All that is written, titles included."""
    return unescape(" ".join(root.itertext()))
