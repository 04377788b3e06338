"""Statements and facts of a base."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

from hypothesis import strategies as st

from casper.engine.domain.domain import Domain
from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Compound
from casper.testing.values import base_facts, checked, columns_of, text_of, well_typed

MOST_LISTED = 5_000


def statements(
    base: KnowledgeBase | Domain, *, actions: Sequence[Indicator] | None = None, valid: bool | None = None
) -> st.SearchStrategy[str]:
    """Statements as text, such as ``eat(human, meal, plate)``, each argument of a value that it may have.

    Args:
        base: a base whose statements are declared, as a domain's actions are, or a domain.
        actions: names and arities to draw from; all declared statements by default.
        valid: True for valid statements only, False for those that are not.

    Raises:
        CasperError: nothing to draw from.
    """
    kb = base.kb if isinstance(base, Domain) else base
    declared = list(kb.declared)
    chosen = checked(declared if actions is None else actions, declared)
    if valid is None:
        return st.one_of([_of_columns(kb, indicator) for indicator in chosen])
    judged = [statement for indicator in chosen for statement in well_typed(kb, indicator)]
    fitting = [statement for statement in judged if (kb.verify(statement).valid is True) == valid]
    if not fitting:
        kind = "valid" if valid else "invalid"
        raise CasperError(f"none of the {len(judged)} statements is {kind}, so there is nothing to draw from")
    return st.sampled_from([text_of(statement) for statement in fitting])


def facts(base: KnowledgeBase | Domain, *, predicates: Sequence[Indicator] | None = None) -> st.SearchStrategy[str]:
    """Facts as text, of the predicates that facts alone define, over the values that stand in their columns.

    Some are given in the base already, others are not: a base may be changed by them, and changed back.

    Raises:
        CasperError: nothing to draw from.
    """
    kb = base.kb if isinstance(base, Domain) else base
    known = list(base_facts(kb))
    chosen = checked(known if predicates is None else predicates, known)
    return st.one_of([_of_columns(kb, indicator) for indicator in chosen])


def _of_columns(kb: KnowledgeBase, indicator: Indicator) -> st.SearchStrategy[str]:
    """Texts of a predicate over its columns: listed, where there are not too many."""
    columns = columns_of(kb, indicator)
    if prod(map(len, columns)) <= MOST_LISTED:
        listed = [text_of(statement) for statement in well_typed(kb, indicator)]
        return st.sampled_from(listed) if listed else st.nothing()
    rows = st.tuples(*map(st.sampled_from, columns))
    return rows.map(lambda row: text_of(Compound((indicator[0], *row))))
