"""Laws of a domain's rules and constraints."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice, permutations, product

from hypothesis import given

from casper.engine.domain.domain import Domain
from casper.kb.base import KnowledgeBase
from casper.kb.reasons.constraints import History
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound, Term
from casper.kb.terms.unification import is_ground, substitute, variables_of
from casper.testing.laws.law import NotApplicable, with_rules
from casper.testing.profiles import checked
from casper.testing.strategies.statements import facts, statements
from casper.testing.values import constants_of, text_of, well_typed

MOST_TRIED = 3_000  # claims, or sets of facts, to break a constraint with
LONG = 1e6  # seconds: longer than any rule asks for
MOST_ASKED = 60  # statements that are compared after each change
_NEVER = ("never", 1)


def texts_read_back(domain: Domain) -> None:
    """What a domain's clauses and plans print reads in again as the same."""
    text = domain.kb.to_text()
    assert KnowledgeBase.from_text(text).to_text() == text, "the clauses print as a text that reads in as others"
    plans = domain.library.to_text()
    assert type(domain.library).from_text(plans).to_text() == plans, "the plans print as a text that reads as others"


def constraints_can_fire(domain: Domain) -> None:
    """Every constraint is broken by something: by a claim after what may have happened, or by a few more facts."""
    kb = with_rules(domain).kb
    constraints = [clause for clause in kb.clauses if clause.head.indicator == _NEVER]
    if not constraints:
        raise NotApplicable("the domain has no constraints")
    for constraint in constraints:
        assert any(_fires(kb, constraint)), (
            f"{constraint.place}: nothing breaks this constraint, so it never fires: {text_of(constraint.head[1])}\n"
            "  no claim of an action does, alone or after another one, and no facts do over the constants there are"
        )


def rejections_name_what_to_mend(domain: Domain) -> None:
    """Each rejection has a reason, and every repair that is offered lets the statement pass."""
    kb = with_rules(domain).kb

    @checked
    @given(statements(kb))
    def law(statement: str) -> None:
        verdict = kb.verify(statement)
        if verdict.valid is not False:
            return
        assert verdict.reasons, f"{statement} is rejected without a reason"
        for repair in kb.repair(statement):
            mended = kb.changed(repair).verify(statement)
            assert mended.valid, f"{statement} is still rejected when {repair}: {'; '.join(mended.reasons)}"

    law()


def changes_are_followed(domain: Domain) -> None:
    """A base that was changed fact by fact says what one says that was made with the facts from the start."""
    kb = with_rules(domain).kb
    asked = [statement for name, arity in kb.declared for statement in well_typed(kb, (name, arity), 40)][:MOST_ASKED]

    @checked
    @given(facts(kb))
    def law(fact: str) -> None:
        changed = kb.assume()
        given_already = not changed.assert_(fact)
        if given_already:
            changed.retract(fact)
        fresh = KnowledgeBase.from_text(changed.to_text())
        fresh.declare_statements(changed.declared)
        for statement in asked:
            ours, theirs = changed.verify(statement).valid, fresh.verify(statement).valid
            what = "without" if given_already else "with"
            assert ours == theirs, f"{text_of(statement)} is {ours} {what} {fact} stated later, {theirs} from the start"

    law()


# --- what breaks a constraint ---------------------------------------------------------------------------------------


def _fires(kb: KnowledgeBase, constraint: Clause) -> Iterator[bool]:
    if any(literal.atom.functor == "claim" for literal in constraint.body):
        yield from _fires_by_claim(kb, constraint)
    else:
        yield from _fires_by_facts(kb, constraint)


def _fires_by_claim(kb: KnowledgeBase, constraint: Clause) -> Iterator[bool]:
    """Claims alone, then each after one other statement, or after one for each did/2; provable ones come first."""
    claims = [statement for indicator in kb.declared for statement in well_typed(kb, indicator, MOST_TRIED)]
    for claim in claims[:MOST_TRIED]:
        yield _breaks(kb, constraint, claim, ())
    if any(literal.atom.functor == "did" for literal in constraint.body):
        for earlier, claim in islice(product(claims, claims), MOST_TRIED):
            yield _breaks(kb, constraint, claim, ((earlier, 0.0),))
        for claim, history in islice(_after_several(constraint, claims), MOST_TRIED):
            yield _breaks(kb, constraint, claim, history)


def _after_several(constraint: Clause, claims: Sequence[Compound]) -> Iterator[tuple[Compound, History]]:
    """Claims of the constraint's action after one statement for each of its did/2, near in time and far apart."""

    def like(relation: str) -> list[list[Compound]]:
        asked = [literal.atom[1] for literal in constraint.body if literal.atom.functor == relation]
        return [[c for c in claims if not isinstance(a, Compound) or c.indicator == a.indicator] for a in asked]

    for (claim, *earlier), apart in product(product(*like("claim")[:1], *like("did")), (LONG, 1.0)):
        for order in permutations(range(len(earlier))):
            yield claim, tuple((statement, apart * at) for statement, at in zip(earlier, order))


def _breaks(kb: KnowledgeBase, constraint: Clause, claim: Compound, history: History) -> bool:
    refusal = kb.why_not(claim, history)
    return refusal is not None and any(violation.clause == constraint for violation in refusal.violations)


def _fires_by_facts(kb: KnowledgeBase, constraint: Clause) -> Iterator[bool]:
    """The facts as they are, then with the constraint's own conditions stated over the constants."""
    if any(violation.clause == constraint for violation in kb.broken()):
        yield True
        return
    positive = [literal.atom for literal in constraint.body if not literal.negated and not literal.is_comparison]
    free = KnowledgeBase()  # of constraints: what would break one is no repair
    free.add(clause for clause in kb.clauses if clause.head.indicator != _NEVER)
    for instance in islice(_instances(positive, constants_of(kb)), MOST_TRIED):
        added = _added(free, instance)
        yield added is not None and any(v.clause == constraint for v in kb.assume(*added).broken())


def _added(kb: KnowledgeBase, atoms: list[Compound]) -> list[Compound] | None:
    """Facts with which all the atoms hold; None where that takes more than adding some."""
    supposed, added = kb, list[Compound]()
    for atom in atoms:
        if not supposed.ask(atom):
            additions = [repair for repair in supposed.repair(atom) if not repair.remove]
            if not additions:
                return None
            added += sorted(additions[0].add, key=repr)
            supposed = supposed.changed(additions[0])
    return added


def _instances(atoms: list[Compound], constants: list[Term]) -> Iterator[list[Compound]]:
    variables = list(variables_of(*atoms)) if atoms else []
    for values in product(constants, repeat=len(variables)):
        found = [substitute(atom, dict(zip(variables, values))) for atom in atoms]
        yield [atom for atom in found if is_ground(atom)]
