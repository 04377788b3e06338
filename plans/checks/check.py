"""All that is wrong with a plan library, not only the first thing."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from difflib import get_close_matches
from typing import TYPE_CHECKING

from casper.kb.checks.finding import Finding, Severity, error, finding_of, warning
from casper.kb.errors import CasperError, Place, PlanError
from casper.kb.terms.clauses import Clause, Indicator, Production, Sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, as_term, predication
from casper.kb.terms.unification import variables_of
from casper.plans.grammar.conditions import condition_clauses, is_condition
from casper.plans.grammar.shapes import BY, items_in
from casper.plans.library import GOAL, RECURSION, PlanLibrary, endless_sentence

if TYPE_CHECKING:
    import networkx as nx

_MARK = "_production"  # an action that no text can see: it tells which productions a plan was made of


def items_of(body: Term) -> Iterator[Compound]:
    """Every action and task that a production's body mentions, through brackets, shapes and alternatives."""
    for item in items_in(body):
        done = item[2] if isinstance(item, Compound) and item.indicator == BY else item
        if isinstance(done, (str, Compound)) and done != NIL and not is_condition(done):
            yield predication(done)


def check_plans(sentences: Iterable[Sentence], is_action: Callable[[Indicator], bool] | None) -> list[Finding]:
    """Everything that is wrong with a grammar.

    Args:
        sentences: a domain's; only productions, goals and the settings of plans count.
        is_action: whether a rule says when an action of this name and arity (its agent left out) is valid; None when
            nobody can tell.
    """
    grammar = _Grammar(sentences)
    findings = [*_unknown_items(grammar, is_action), *_goals_without_production(grammar), *_unbound(grammar)]
    findings += _unexpandable(grammar) or _endless(grammar)
    if not any(finding.severity is Severity.ERROR for finding in findings):
        unused = list(_unused_tasks(grammar))
        findings += [*unused, *_dead_productions(grammar, {finding.place for finding in unused})]
    return findings


class _Grammar:
    """Productions, goals and settings of a plan library."""

    def __init__(self, sentences: Iterable[Sentence]) -> None:
        found = list(sentences)
        clauses = [s for s in found if isinstance(s, Clause)]
        self.productions = [s for s in found if isinstance(s, Production)]
        self.goals = [c for c in clauses if c.head.indicator == GOAL]
        self.settings = [c for c in clauses if c.head[:2] == RECURSION[:2]]
        self.tasks = {p.head.indicator: p for p in reversed(self.productions)}  # each with its first production

    def graph(self) -> nx.DiGraph:
        """An edge from each task to every task its productions mention."""
        import networkx as nx

        graph: nx.DiGraph = nx.DiGraph()
        graph.add_nodes_from(self.tasks)
        pairs = ((p.head.indicator, i.indicator) for p in self.productions for i in items_of(p.body))
        graph.add_edges_from(pair for pair in pairs if pair[1] in self.tasks)
        return graph


def _endless(grammar: _Grammar) -> list[Finding]:
    """Tasks that can only go on for ever, once for each circle; no goal is done by them alone."""
    library = PlanLibrary([*grammar.goals, *grammar.productions, *grammar.settings])
    return [warning(place, endless_sentence(circle)) for circle, place in library.tables.endless()]


def _unbound(grammar: _Grammar) -> Iterator[Finding]:
    """Conditions with a variable that nothing binds: neither the task, nor an action or task beside them, nor they."""
    for production in grammar.productions:
        items = list(items_in(production.body))
        conditions = [item for item in items if is_condition(item)]
        known = set(variables_of(production.head, *(item for item in items if not is_condition(item))))
        try:
            rules = list(condition_clauses([production]))
        except PlanError as mistake:
            yield finding_of(mistake)
            continue
        known.update(variable for rule in rules for literal in rule.body for variable in literal.binds())
        for item in conditions:
            alone = [v.name for v in variables_of(item) if not v.is_anonymous and v not in known]
            if alone:
                sentence = f"nothing binds {' and '.join(alone)} of the condition {term_text(item)}"
                fix = "use it in an action or a task, or bind it by a condition"
                yield error(production.place, f"{sentence}: {fix}")


def _unknown_items(grammar: _Grammar, is_action: Callable[[Indicator], bool] | None) -> Iterator[Finding]:
    """Items that are neither a task nor an action anybody can do, with what may have been meant."""
    tasks, seen = set(grammar.tasks), dict[Indicator, Production]()
    for production in grammar.productions:
        for item in items_of(production.body):
            if item.indicator not in tasks and _is_name(item.functor):
                seen.setdefault(item.indicator, production)
    for (name, arity), production in seen.items():
        arities = sorted(a for n, a in tasks if n == name)
        if is_action is not None and not is_action((name, arity)):
            known = {*tasks, *(other for other in seen if is_action(other))}
            sentence = f"{name}/{arity} is no task, and no rule {name}/{arity + 1} says when it is valid as an action"
            yield error(production.place, f"{sentence}{_hint(name, arities, known)}")
        elif is_action is None and (arities or get_close_matches(name, {n for n, a in tasks if a == arity}, 1, 0.8)):
            sentence = f"{name}/{arity} has no production, so it counts as an action"
            yield warning(production.place, f"{sentence}{_hint(name, arities, tasks)}")


def _is_name(name: str) -> bool:
    return name[:1].isalpha() or name[:1] == "_"


def _hint(name: str, arities: Collection[int], known: Iterable[Indicator]) -> str:
    if arities:
        return f"; the task {name} takes {' or '.join(map(str, arities))}"
    close = get_close_matches(name, sorted({other for other, _ in known}), n=1)
    return f"; did you mean {close[0]}?" if close else ""


def _goals_without_production(grammar: _Grammar) -> Iterator[Finding]:
    for clause in grammar.goals:
        goal = _goal_of(clause)
        if goal is not None and goal.indicator not in grammar.tasks:
            arities = sorted(a for n, a in grammar.tasks if n == goal.functor)
            sentence = f"the goal {term_text(as_term(goal))} has no production: write {goal.functor} --> …"
            yield error(clause.place, f"{sentence}{_hint(goal.functor, arities, grammar.tasks)}")


def _goal_of(clause: Clause) -> Compound | None:
    """What a clause of goal/1 names; None for a number or a variable, which is told when it is expanded."""
    try:
        return predication(clause.head[1])
    except TypeError:
        return None


def _unexpandable(grammar: _Grammar) -> list[Finding]:
    """What keeps a goal from having a plan; where something does, each goal is expanded by itself."""
    try:
        PlanLibrary([*grammar.goals, *grammar.productions, *grammar.settings]).check()
        return []
    except CasperError as mistake:
        findings = [finding_of(mistake)] if not grammar.goals else []
    for goal in grammar.goals:
        named = _goal_of(goal)
        if named is not None and named.indicator not in grammar.tasks:
            continue  # told as a goal without production
        try:
            PlanLibrary([goal, *grammar.productions, *grammar.settings]).check()
        except CasperError as mistake:
            findings.append(finding_of(mistake, goal.place))
    return findings


def _unused_tasks(grammar: _Grammar) -> Iterator[Finding]:
    """Tasks that no goal leads to; where no goal is stated, every task nobody uses is one."""
    import networkx as nx

    graph, stated = grammar.graph(), {goal.indicator for goal in map(_goal_of, grammar.goals) if goal is not None}
    used = stated.union(*(nx.descendants(graph, goal) for goal in stated if goal in graph))
    for production in grammar.productions if stated else ():
        name, arity = production.head.indicator
        if (name, arity) not in used and grammar.tasks[name, arity] is production:
            pattern = f"{name}({', '.join('_' * arity)})" if arity else name
            sentence = f"no goal leads to the task {name}/{arity}"
            yield warning(production.place, f"{sentence}; use it in a plan, or state goal({pattern}).")


def _dead_productions(grammar: _Grammar, unused: Collection[Place]) -> Iterator[Finding]:
    """Productions that are part of no plan although their task is used: their parameters never agree."""
    marks = [f"{_MARK}{number}" for number in range(len(grammar.productions))]
    marked = [Production(p.head, Compound((",", mark, p.body)), p.place) for p, mark in zip(grammar.productions, marks)]
    try:
        ways = PlanLibrary([*grammar.goals, *marked, *grammar.settings]).ways
    except CasperError:
        return
    seen = {leaf.functor for plan in ways for leaf in plan.leaves}
    tasks = {p.head.indicator for p, mark in zip(grammar.productions, marks) if mark in seen}
    for production, mark in zip(grammar.productions, marks):
        if mark not in seen and production.head.indicator in tasks and production.place not in unused:
            head = term_text(as_term(production.head))
            sentence = f"this way to do {head} is part of no plan"
            yield warning(production.place, f"{sentence}: no use of it fits its parameters")
