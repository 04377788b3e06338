"""Entities of XML: abbreviations of namespaces are understood, and what would grow without bound is refused."""

from __future__ import annotations

import re

from casper.kb.errors import Place, ReadError

_DECLARED = re.compile(rb"""<!ENTITY\s+(?:%\s*)?([^\s"'<>&;]+)\s+(?:"([^"]*)"|'([^']*)')""")
_USED = re.compile(rb"&([^\s#;&]+);")
_LONGEST = 4096  # characters that one entity may stand for: it is an abbreviation


def check_entities(content: bytes, file: str) -> None:
    """Refuse a document in which an entity stands for too much, or for what is declared behind it.

    Raises:
        ReadError: with the line of its declaration.
    """
    lengths = dict.fromkeys((b"amp", b"lt", b"gt", b"quot", b"apos"), 1)
    for found in _DECLARED.finditer(content):
        value = found[2] if found[2] is not None else found[3]
        used = _USED.findall(value)
        length = len(value) + sum(lengths.get(name, _LONGEST) for name in used)
        if length > _LONGEST:
            name = found[1].decode("utf-8", "replace")
            sentence = f"the entity {name} stands for too much, or for one behind it; write out what it stands for"
            raise ReadError(sentence, Place(file, content.count(b"\n", 0, found.start()) + 1))
        lengths[found[1]] = length
