"""Clauses against the facts as they stand: rules that give nothing, and constraints that are broken."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from casper.kb.base import KnowledgeBase
from casper.kb.checks.finding import Finding, error, warning
from casper.kb.errors import CasperError, Undefined
from casper.kb.program.control import is_control, plain_clauses
from casper.kb.reasons.proof import Proof
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import is_ground, substitute
from casper.kb.text.writer import literal_text

MOST_CLASHES = 3  # of one constraint


def rules_that_give_nothing(
    kb: KnowledgeBase, rules: Sequence[Clause], open_: Collection[Indicator]
) -> Iterator[Finding]:
    """Rules whose conditions no facts satisfy, each told where it goes wrong.

    ``open_`` are predicates whose rows are not all known yet (dynamic, situational, or in need of such a one). A rule
    that gives nothing because another rule gives nothing is not told, nor is one that cites something (``%: …``).
    """
    empty: dict[Indicator, bool] = {}
    for rule in rules:
        needed = [x.atom.indicator for x in rule.body if not x.is_comparison]
        if rule.place.citation or any(map(is_control, rule.body)):  # a law stated elsewhere need not have cases here
            continue
        if not needed or any(i in open_ for i in needed):
            continue
        if any(_is_empty(kb, i, empty) and any(c.body for c in kb.clauses_of(i)) for i in needed):
            continue
        culprit = _culprit(kb, rule)
        if culprit is not None:
            yield culprit


def _culprit(kb: KnowledgeBase, rule: Clause) -> Finding | None:
    conditions = sorted(rule.body, key=lambda x: x.negated or x.is_comparison)  # what binds stands first
    for length in range(1, len(conditions) + 1):
        if _holds(kb, conditions[:length]) is False:
            last = conditions[length - 1]
            others = _related(last, conditions[: length - 1])
            if not others:
                return warning(last.place, f"{literal_text(last)} holds of nothing, so the rule gives nothing")
            shown = ", ".join(literal_text(x) for x in (*others, last))
            return warning(last.place, f"no facts satisfy {shown} together, so the rule gives nothing")
    return None


def _related(literal: Literal, others: Sequence[Literal]) -> list[Literal]:
    """The conditions that share a variable with this one."""
    variables = set(literal.variables())
    return [x for x in others if variables & set(x.variables())]


def _is_empty(kb: KnowledgeBase, indicator: Indicator, known: dict[Indicator, bool]) -> bool:
    """Whether no row of the predicate is known; a search that does not end says nothing."""
    if indicator not in known:
        pattern = Compound((indicator[0], *(Variable(f"X{at}") for at in range(indicator[1]))))
        given = indicator in SYSTEM or (indicator in BUILTINS and not kb.defines(*indicator))
        known[indicator] = not given and _holds(kb, [Literal(pattern)]) is False
    return known[indicator]


def _holds(kb: KnowledgeBase, conditions: Sequence[Literal]) -> bool | None:
    """Whether the conditions have an answer; None when that cannot be told."""
    try:
        return next(kb.query(", ".join(map(literal_text, conditions))), None) is not None
    except CasperError:
        return None


def broken_constraints(
    kb: KnowledgeBase, constraints: Sequence[Clause], open_: Collection[Indicator]
) -> Iterator[Finding]:
    """Constraints that the facts alone break, with the facts that clash.

    ``open_`` are predicates that what is not known yet may change such that a broken constraint is no longer so.
    """
    for constraint in constraints:
        parts = plain_clauses([constraint])
        if any(x.needed in open_ for part in parts for x in part.body):
            continue
        body = _all_named(constraint)
        try:
            for answer in kb.query(", ".join(map(literal_text, body)), MOST_CLASHES):
                values: Mapping[Variable, Term] = {Variable(name): value for name, value in answer.items()}
                facts = _clashing(kb, [substitute(x.atom, dict(values)) for x in body if _looks_up(x)])
                shown = ", ".join(facts) or ", ".join(literal_text(x) for x in body)
                yield error(constraint.place, f'the facts break "{constraint.head[1]}": {shown}')
        except Undefined as doubt:
            sentence = f'whether the facts break "{constraint.head[1]}" is undefined: {doubt.sentence}'
            yield warning(constraint.place, sentence)
        except CasperError:
            continue  # it cannot be decided by the facts alone


def _looks_up(literal: Literal) -> bool:
    return not literal.is_comparison and not literal.negated and not is_control(literal)


def _all_named(constraint: Clause) -> list[Literal]:
    """The body with a name for every ``_`` of a positive condition, so that an answer tells its value."""
    names = {
        v: Variable(f"Any{v.name[2:]}")
        for literal in constraint.body
        if not literal.negated
        for v in literal.variables()
        if v.is_anonymous
    }
    return [Literal(substitute(x.atom, dict(names)), x.negated, x.place) for x in constraint.body]


def _clashing(kb: KnowledgeBase, atoms: Sequence[Compound]) -> list[str]:
    """The given facts behind the atoms, with their places."""
    found: dict[str, None] = {}
    for atom in atoms:
        proof = kb.why(atom) if is_ground(atom) else None
        for fact, place in _given(proof if isinstance(proof, Proof) else None):
            found[f"{term_text(as_term(fact))}{place}"] = None
    return list(found)


def _given(proof: Proof | None) -> Iterator[tuple[Compound, str]]:
    """The facts at the leaves of a proof, in its order, each with its place."""
    seen: set[int] = set()
    waiting = [] if proof is None else [proof]
    while waiting:
        step = waiting.pop()
        if id(step) in seen:
            continue
        seen.add(id(step))
        waiting.extend(reversed(step.premises))
        if step.clause is not None and not step.clause.body:
            place = step.clause.place
            yield step.fact, f" ({place.file.rsplit('/', 1)[-1]}:{place.line})" if place.line else ""
