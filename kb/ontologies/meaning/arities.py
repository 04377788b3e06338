"""How many arguments the constructors inside of axioms need: one without them means nothing, and is refused."""

from __future__ import annotations

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import Expression, parts_of
from casper.kb.ontologies.vocabulary.refusals import Beyond

_LEAST = {
    **dict.fromkeys(("ComplementOf", "InverseOf", "HasSelf", "PropertyChain", "BuiltInAtom"), 1),
    **dict.fromkeys(("SomeValuesFrom", "AllValuesFrom", "HasValue"), 2),
    **dict.fromkeys(("MinCardinality", "MaxCardinality", "ExactCardinality"), 2),
    **dict.fromkeys(("DatatypeRestriction", "FacetRestriction"), 2),
}


def check_arities(expression: Expression) -> None:
    """Refuse what has too few arguments to mean anything.

    Raises:
        Beyond: some constructor has.
    """
    for part in parts_of(expression):
        if isinstance(part, Expression) and len(part.args) < _LEAST.get(part.name, 0):
            shown = cited(part) if part.args else f"{part.name}()"
            raise Beyond(f"{shown} has too few arguments; mend the axiom")
