"""The kitchen's ontology, alone: the rest of the domain is no logic task."""

from pathlib import Path

from casper.kb.base import KnowledgeBase

ONTOLOGY = Path(__file__).resolve().parents[3] / "domains" / "kitchen" / "ontology.pl"
STATEMENTS = ("pick_and_place", "eat", "sip", "cook", "wash")


def kitchen() -> KnowledgeBase:
    """Facts, rules and constraints of the kitchen, with its action statements declared."""
    kb = KnowledgeBase.from_text(ONTOLOGY.read_text(), ONTOLOGY.name)
    kb.declare_statements((name, 3) for name in STATEMENTS)
    kb.compile()
    return kb
