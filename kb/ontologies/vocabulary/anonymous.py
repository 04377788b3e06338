"""Individuals without a name: numbered by what is said of them, so that every syntax gives them the same number."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import is_

from casper.kb.ontologies.expressions import Anonymous, Axiom, Expression, Ontology, Part, parts_of

_MOST_ROUNDS = 10


def relabelled(ontology: Ontology, label: Callable[[str], str]) -> None:
    """Give every anonymous individual another label."""
    renamed = ((x, _renamed(x.expression, label)) for x in ontology.axioms)
    ontology.axioms = [
        Axiom(new, x.place, x.label) if isinstance(new, Expression) and new is not x.expression else x
        for x, new in renamed
    ]


def number_anonymous(ontology: Ontology) -> None:
    """Label anonymous individuals ``1``, ``2``, …: those that differ in what is said of them in a fixed order."""
    about: dict[str, list[Expression]] = {}
    for axiom in ontology.axioms:
        for part in parts_of(axiom.expression):
            if isinstance(part, Anonymous):
                about.setdefault(part.label, []).append(axiom.expression)
    if not about:
        return
    colours = dict.fromkeys(about, 0)
    for _ in range(_MOST_ROUNDS):
        finer = _refined(about, colours)
        if len(set(finer.values())) == len(set(colours.values())):
            break
        colours = finer
    order = {label: str(number) for number, label in enumerate(sorted(about, key=lambda x: (colours[x], x)), 1)}
    relabelled(ontology, order.__getitem__)


def _refined(about: Mapping[str, list[Expression]], colours: Mapping[str, int]) -> dict[str, int]:
    """The colour of each by what is said of it, with the colours so far in the place of labels."""

    def told(own: str, expression: Expression) -> str:
        return repr(_renamed(expression, lambda other: "" if other == own else str(colours[other])))

    keys = {label: (colours[label], *sorted(told(label, x) for x in said)) for label, said in about.items()}
    numbers = {key: number for number, key in enumerate(sorted(set(keys.values())))}
    return {label: numbers[keys[label]] for label in about}


def _renamed(part: Part, label: Callable[[str], str]) -> Part:
    """The part with other labels; the same one where it has none."""
    if isinstance(part, Anonymous):
        return Anonymous(label(part.label))
    if isinstance(part, Expression):
        args = [_renamed(arg, label) for arg in part.args]
        return part if all(map(is_, args, part.args)) else Expression(part.name, tuple(args))
    return part
