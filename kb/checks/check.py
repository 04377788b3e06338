"""All that is wrong with a text of facts, rules and constraints, not only the first thing.

>>> [str(finding) for finding in check_text("human(ann). greets(X) :- humn(X).", "home.pl")]
['home.pl:1: error: nothing defines humn/1; did you mean human?']
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from casper.kb.base import KnowledgeBase
from casper.kb.checks.bodies import contradictions, duplicates
from casper.kb.checks.facts import broken_constraints, rules_that_give_nothing
from casper.kb.checks.finding import Finding, finding_of, sorted_findings
from casper.kb.checks.names import (
    arity_clashes,
    needed_by,
    own_mistakes,
    single_variables,
    unbound_conditions,
    undefined_names,
)
from casper.kb.checks.needs import needs_graph, negative_circles, unneeded
from casper.kb.checks.says import wrong_says
from casper.kb.errors import CasperError, Place, ProgramError
from casper.kb.program.control import plain_clauses
from casper.kb.program.declarations import declaration
from casper.kb.reasons.says import SAYS
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Directive, Indicator, Sentence
from casper.kb.text.recovery import read_tolerantly


@dataclass(frozen=True)
class Context:
    """What a text is checked in.

    Args:
        asked: predicates that are asked from outside (actions, goals, settings): with what they need, they are needed.
        known: predicates that somebody else defines.
        half_read: names of clauses that could not be read, and so may be defined by them.
        exempt: relations that the system reads: they may share names with others.
    """

    asked: Collection[Indicator] = ()
    known: Collection[Indicator] = ()
    half_read: Collection[str] = ()
    exempt: Collection[Indicator] = ()


_ALONE = Context()


@dataclass
class Checked:
    """What was found, and the knowledge base of everything that is sound."""

    findings: list[Finding]
    kb: KnowledgeBase
    faulty: list[Clause] = field(default_factory=list)


def check_text(text: str, file: str = "<text>") -> list[Finding]:
    """Everything that is wrong with a text, by line; never raises."""
    read = read_tolerantly(text, file)
    checked = check_sentences(read.sentences, Context(half_read=read.half_read))
    return sorted_findings([*map(finding_of, read.mistakes), *checked.findings])


def check_sentences(sentences: Sequence[Sentence], context: Context = _ALONE) -> Checked:
    """Everything that is wrong with the clauses of a text; productions are the plan library's to check."""
    clauses = [s for s in sentences if isinstance(s, Clause)]
    dynamic, findings = _dynamic(sentences)
    known = {c.head.indicator for c in clauses} | dynamic | set(context.known)
    faulty: list[Clause] = []
    plain: list[Clause] = []  # with the goals inside goals as clauses of their own
    for number, clause in enumerate(clauses):
        try:
            parts = list(plain_clauses([clause], f"{number} "))
        except ProgramError as mistake:
            findings.append(finding_of(mistake, clause.place))
            faulty.append(clause)
            continue
        plain.extend(parts)
        mistakes = [*own_mistakes(parts), *undefined_names(parts, known, context.half_read)]
        findings.extend(mistakes)
        if mistakes or not needed_by(parts) <= {*known, *SYSTEM, *BUILTINS}:
            faulty.append(clause)
    findings.extend(negative_circles([c for c in plain if not c.is_constraint]))
    findings.extend(single_variables(sentences))
    findings.extend(arity_clashes(clauses, context.exempt))
    findings.extend(duplicates(sentences))
    findings.extend(wrong_says(sentences, known, context.half_read))
    findings.extend(unneeded(plain, {*context.asked, *SAYS} if context.asked else ()))
    sound = [c for c in clauses if c not in faulty]
    impossible = [f for c in sound for f in contradictions(c)]
    findings.extend(impossible)
    contradictory = {c for c in sound if any(True for _ in contradictions(c))}
    findings.extend(f for c in sound if c not in contradictory for f in unbound_conditions(c))
    tables = [s for s in sentences if isinstance(s, Directive) and s.term.functor == "table" and _is_sound(s)]
    kb = _sound_base(sound, known | dynamic, tables, findings)
    open_ = _open(plain, dynamic | {c.head.indicator for c in faulty}, context)
    revisable = _revisable(plain, open_)
    findings.extend(_against_facts(kb, [c for c in sound if c not in contradictory], open_, revisable))
    return Checked(findings, kb, faulty)


def _dynamic(sentences: Iterable[Sentence]) -> tuple[set[Indicator], list[Finding]]:
    """What is declared dynamic, and every directive that nobody knows."""
    declared: set[Indicator] = set()
    findings: list[Finding] = []
    for sentence in sentences:
        if isinstance(sentence, Directive):
            try:
                declared.update(declaration(sentence).dynamic)
            except CasperError as mistake:
                findings.append(finding_of(mistake, sentence.place))
    return declared, findings


def _is_sound(directive: Directive) -> bool:
    try:
        declaration(directive)
    except ProgramError:
        return False
    return True


def _sound_base(
    sound: Sequence[Clause], known: Collection[Indicator], declared: Sequence[Sentence], findings: list[Finding]
) -> KnowledgeBase:
    """The knowledge base of the sound clauses; should it refuse them all the same, that is a finding, too."""
    kb = KnowledgeBase(sound, {i for i in known if i not in SYSTEM})
    kb.add(declared)
    try:
        kb.compile()
    except CasperError as mistake:
        findings.append(finding_of(mistake, sound[0].place if sound else Place()))
        kb = KnowledgeBase()
    return kb


def _open(clauses: Iterable[Clause], unknown: Collection[Indicator], context: Context) -> set[Indicator]:
    """Predicates of which not all rows are known yet, with everything that needs one of them."""
    import networkx as nx

    graph = needs_graph(clauses)
    roots = [i for i in graph if i in SYSTEM or i in unknown or i in context.known or i[0] in context.half_read]
    backwards = graph.reverse(copy=False)
    reached = set(roots).union(*(nx.descendants(backwards, root) for root in roots))
    return (reached | set(SYSTEM)) - {("never", 1)}


def _revisable(clauses: Sequence[Clause], open_: Collection[Indicator]) -> set[Indicator]:
    """Predicates that can lose rows as open ones gain some, or that depend on the situation: both undo a clash.

    What only gains rows leaves a constraint that the facts break broken, so an ontology whose classes get their
    members later is checked all the same.
    """
    import networkx as nx

    graph = needs_graph(clauses)
    denied = {x.needed for c in clauses for x in c.body if x.is_strict}
    losing = {c.head.indicator for c in clauses if any(x.is_strict and x.needed in open_ for x in c.body)}
    roots = [i for i in graph if i in SYSTEM or i in losing or (i in denied and i in open_)]
    backwards = graph.reverse(copy=False)
    return (set(roots).union(*(nx.descendants(backwards, root) for root in roots)) | set(SYSTEM)) - {("never", 1)}


def _against_facts(
    kb: KnowledgeBase, sound: Sequence[Clause], open_: Collection[Indicator], revisable: Collection[Indicator]
) -> Iterator[Finding]:
    if not len(kb):
        return
    rules = [c for c in sound if c.body and not c.is_constraint]
    yield from rules_that_give_nothing(kb, rules, open_)
    yield from broken_constraints(kb, [c for c in sound if c.is_constraint], revisable)
