"""Who is watched and who helps, and whether they are in the world."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError, Place
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term

if TYPE_CHECKING:
    from casper.kb.terms.terms import Term

KINDS = ("human", "robot", "agent")
"""Relations of which one must hold of an agent, where the domain has any of them."""


def named_agents(kb: KnowledgeBase, role: str) -> tuple[str, ...]:
    """Those whom ``setting(agents, Role, Name)`` names, in order."""
    rows = (row for row in kb.rows("setting", 3) if row[:2] == ("agents", role))
    return tuple(dict.fromkeys(str(name) for *_, name in rows))


def agent_of(kb: KnowledgeBase, role: str, kind: str) -> str:
    """The first of those named for the role, else the first individual of the kind, else the kind's name."""
    named = named_agents(kb, role)
    return named[0] if named else next((str(row[0]) for row in kb.rows(kind, 1)), kind)


def partners_of(kb: KnowledgeBase) -> tuple[str, ...]:
    """All who are watched: those that settings name, else every human there is."""
    humans = tuple(dict.fromkeys(str(row[0]) for row in kb.rows("human", 1)))
    return named_agents(kb, "partner") or humans or ("human",)


def is_known(kb: KnowledgeBase, name: Term) -> bool:
    """Whether somebody of that name is in the world, as far as the domain says who is; unknown is not no."""
    defined = [kind for kind in KINDS if kb.defines(kind, 1)]
    return not defined or any(kb.truth(Compound((kind, name))) != "false" for kind in defined)


def strangers(kb: KnowledgeBase) -> Iterator[tuple[Place, str]]:
    """Partners and robots that settings name and that are not in the world: where, and what to do about it."""
    for clause in kb.clauses_of(("setting", 3)):
        section, role, name = clause.head.args
        if section != "agents" or role not in ("partner", "robot") or is_known(kb, name):
            continue
        kind, who = "robot" if role == "robot" else "human", term_text(as_term(name))
        there = ", ".join(str(row[0]) for row in kb.rows(kind, 1)) or "nobody"
        yield (
            clause.place,
            f"the {role} {who} is not in the world; state {kind}({who}) in ontology.pl, or name one there is: {there}",
        )


def check_agents(kb: KnowledgeBase) -> None:
    """Refuse a partner or a robot who is not in the world.

    Raises:
        DomainError: with the place of the setting, and what to do.
    """
    for place, sentence in strangers(kb):
        raise DomainError(sentence, place)
