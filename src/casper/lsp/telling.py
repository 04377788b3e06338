"""What the editor shows of a name: what it is, what defines it, how many rows it has, its sentences, its comment."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM
from casper.kb.terms.control import CONTROL
from casper.lsp.documents import Document
from casper.lsp.names import Name
from casper.lsp.settings import setting_named
from casper.lsp.workspace import Domain, Symbol

_RULE = re.compile(r"[-=*]{3,}")
MOST_SHOWN = 8  # places, classes, sentences


def hover_text(domain: Domain, name: Name, rows: Mapping[str, int]) -> str:
    """Markdown about a name; empty where there is nothing to say."""
    if name.role == "variable":
        return ""
    if name.within == "setting" and name.arity is None:
        told = _setting(domain, name)
        if told:
            return told
    symbol = domain.symbol(name)
    return "\n\n".join(_about(domain, symbol, rows))


def comment_of(doc: Document, start: int) -> str:
    """The comment that goes with a clause: the lines right above it, or what stands behind it on its line."""
    before = doc.text[:start].split("\n")[:-1]
    above: list[str] = []
    while before and before[-1].lstrip().startswith("%"):
        above.insert(0, before.pop().lstrip(" \t%").rstrip())
    above = [said for line in above if (said := _RULE.sub("", line).strip())]
    piece = doc.piece_at(start)
    end = start if piece is None else start + len(piece[1].text)
    behind = doc.text[end : doc.text.find("\n", end) if "\n" in doc.text[end:] else len(doc.text)]
    trailing = behind.partition("%")[2].strip() if behind.lstrip().startswith("%") else ""
    return trailing.removeprefix(":").strip() or " ".join(above)


def _about(domain: Domain, symbol: Symbol, rows: Mapping[str, int]) -> Iterator[str]:
    name, arity = symbol
    if arity is None:
        yield from _thing(domain, name)
        return
    key = f"{name}/{arity}"
    definitions = domain.definitions(symbol)
    if symbol in BUILTINS or symbol in CONTROL:
        yield f"**{key}** — built in"
        return
    if symbol in SYSTEM:
        yield f"**{key}** — given by the system (docs/language.md)"
        return
    kind = "task or goal of plans" if (name, arity) in domain.tasks else "predicate"
    if not definitions:
        yield f"**{key}** — nothing here defines it"
        return
    plural = "" if len(definitions) == 1 else "s"
    counted = f", {rows[key]:,} row{'' if rows[key] == 1 else 's'}" if key in rows else ""
    yield f"**{key}** — {kind}, {len(definitions)} clause{plural}{counted}"
    first = definitions[0]
    piece = first.doc.piece_at(first.start)
    if piece is not None:
        yield f"```prolog\n{piece[1].text[:500]}\n```"
        comment = comment_of(first.doc, piece[0])
        if comment:
            yield comment
    said = [s for s in domain.says if s.about.indicator in ((name, arity), (name, arity - 1))]
    if said:
        yield "\n".join(
            f"- {s.language or 'say'}: “{s.clause.head[-1]}”{' (denied)' if s.denied else ''}"
            for s in said[:MOST_SHOWN]
        )
    files = {use.doc.path.name: use.doc.lines.position(use.start)[0] + 1 for use in reversed(definitions)}
    yield "defined in " + ", ".join(f"{file}:{line}" for file, line in sorted(files.items()))


def _thing(domain: Domain, name: str) -> Iterator[str]:
    """A constant: what is said of it by facts, and what it is called."""
    uses = domain.uses.get((name, None), [])
    facts = dict.fromkeys(use.name.within for use in uses if use.name.within and _is_fact(use.doc, use.start))
    facts = {fact: None for fact in facts if fact not in ("say", "setting", "example")}
    yield f"**{name}** — a name that stands in {len(uses)} place{'' if len(uses) == 1 else 's'}"
    if facts:
        yield "stated: " + ", ".join(list(facts)[:MOST_SHOWN]) + (", …" if len(facts) > MOST_SHOWN else "")
    said = [say for say in domain.says if say.about == (name,)]
    if said:
        yield "\n".join(f"- {say.language or 'say'}: “{say.clause.head[-1]}”" for say in said[:MOST_SHOWN])


def _is_fact(doc: Document, offset: int) -> bool:
    found = doc.piece_at(offset)
    return found is not None and not any(n.role in ("condition", "step") for n in found[1].names)


def _setting(domain: Domain, name: Name) -> str:
    """A setting, or the section of one."""
    section = name.name
    if name.number == 1:
        section = next((n.name for n in _neighbours(domain, name) if n.within == "setting" and n.number == 0), "")
    found = setting_named(section, name.name) if name.number == 1 else None
    if found is None:
        return ""
    default = f", by default {found.default}" if found.default else ""
    return f"**setting({section}, {found.name}, …)**{default}\n\n{found.about}"


def _neighbours(domain: Domain, name: Name) -> tuple[Name, ...]:
    """The names of the clause that has exactly this name."""
    for doc in domain.docs:
        for _, piece in doc.pieces:
            if any(each is name for each in piece.names):
                return piece.names
    return ()
