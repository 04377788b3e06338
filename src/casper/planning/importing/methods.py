"""Methods and the initial task network as productions.

    method(m_deliver(P, L, V, A)) :- package(P), place(L), vehicle(V), place(A), holds(at(P, A), now).
    deliver(P, L) --> {method(m_deliver(P, L, V, A))}, {A \\= L}, get_to(V, A), load(V, A, P), get_to(V, L), drop(V, P).

A method's name, types and preconditions are one condition, so that readings and proofs can name it; nothing is
unrolled.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from unified_planning.model.htn import Task
from unified_planning.model.htn.ordering import PartialOrder, TotalOrder, ordering

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, make_list
from casper.planning.importing.alternatives import Row, Unsaid, all_of, rows_of
from casper.planning.importing.names import ACHIEVE, ACT, GOAL_STATE, NETWORK, outward
from casper.planning.importing.vocabulary import Vocabulary
from casper.planning.importing.wording import Wording, asked_now, clause_text, conjunction

FAILS = Compound(("{}", "fail"))


def method_lines(vocabulary: Vocabulary, method: Any) -> list[str]:
    """A method: its condition, and its production.

    Raises:
        Unsaid: something of it cannot be said; then none of it is.
    """
    wording = Wording(vocabulary, method.parameters)
    known = dict(zip((p.name for p in method.parameters), wording.arguments))
    achieved = method.achieved_task
    head = _term(outward(achieved.task.name), [known[p.name] for p in achieved.parameters])
    return [
        *condition_lines(vocabulary, outward(method.name), method.parameters, list(method.preconditions)),
        _production(vocabulary, wording, head, outward(method.name), method),
    ]


def network_lines(vocabulary: Vocabulary) -> list[str]:
    """The initial task network as a goal; after it the state that the problem wants, if it wants one.

    Raises:
        Unsaid: something of it cannot be said.
    """
    problem = vocabulary.problem
    network = problem.task_network
    wording = Wording(vocabulary, network.variables)
    return [
        clause_text(Compound(("goal", NETWORK)), ()),
        *condition_lines(vocabulary, NETWORK, network.variables, []),
        _production(vocabulary, wording, NETWORK, NETWORK, network, [asked(GOAL_STATE)] if problem.goals else []),
        *(goal_lines(vocabulary) if problem.goals else []),
    ]


def search_lines(vocabulary: Vocabulary, actions: Sequence[Any]) -> list[str]:
    """A problem without tasks: any actions, until the state is as it is wanted.

    Raises:
        Unsaid: that state cannot be said.
    """
    if not actions:
        return goal_lines(vocabulary)
    lines = [
        *goal_lines(vocabulary),
        clause_text(Compound(("goal", ACHIEVE)), ()),
        produced(ACHIEVE, [asked(GOAL_STATE)]),
        produced(ACHIEVE, [ACT, ACHIEVE]),
    ]
    for action in actions:
        arguments = Wording(vocabulary, action.parameters).arguments
        lines.append(produced(ACT, [vocabulary.step(action, arguments)]))
    return lines


def goal_lines(vocabulary: Vocabulary) -> list[str]:
    """The state that is wanted, as a relation without arguments."""
    goals = list(vocabulary.problem.goals)
    rows = all_of(goals) if goals else ()
    found = [clause_text(GOAL_STATE, Wording(vocabulary, ()).row(row) or ["true"]) for row in rows]
    return list(dict.fromkeys(found)) or [clause_text(GOAL_STATE, ["fail"] if goals else [])]


def signature(task: Task, vocabulary: Vocabulary) -> str:
    """A task with the types of its parameters."""
    types: list[Term] = [vocabulary.type_name(parameter.type) for parameter in task.parameters]
    return clause_text(Compound(("compound_task", _term(task.name, types))), ())


def impossible(task: Task) -> str:
    """The production of a task that no method does."""
    general = [f"_{number}" for number, _ in enumerate(task.parameters, 1)]
    head = term_text(outward(task.name)) + (f"({', '.join('_' for _ in general)})" if general else "")
    return f"{head} --> {term_text(FAILS)}."


def condition_lines(vocabulary: Vocabulary, name: str, parameters: Sequence[Any], conditions: list[Any]) -> list[str]:
    """When a method may be chosen: the types of its parameters and its preconditions, a clause for each alternative."""
    return list(dict.fromkeys(_condition(vocabulary, name, parameters, conditions)))


def _condition(vocabulary: Vocabulary, name: str, parameters: Sequence[Any], conditions: list[Any]) -> Iterator[str]:
    rows = all_of(conditions)
    for row in rows or (Row(),):
        wording = Wording(vocabulary, parameters)
        body = [*wording.types(parameters), *(wording.row(row) if rows else ["fail"])]
        yield clause_text(Compound(("method", _term(name, wording.arguments))), asked_now(body))


def _production(
    vocabulary: Vocabulary, wording: Wording, head: Term, name: str, network: Any, more: Sequence[Term] = ()
) -> str:
    items: list[Term] = [asked(Compound(("method", _term(name, wording.arguments))))]
    for constraint in network.non_temporal_constraints():
        rows = rows_of(constraint)
        items.append(asked(conjunction(wording.row(rows[0])) if len(rows) == 1 else wording.alternatives(rows)))
    return produced(head, [*items, *_steps(vocabulary, wording, network), *more])


def _steps(vocabulary: Vocabulary, wording: Wording, network: Any) -> list[Term]:
    """The subtasks in their order: in a row, or as they may follow on one another, with the pairs that are ordered."""
    subtasks = {subtask.identifier: _item(vocabulary, wording, subtask) for subtask in network.subtasks}
    order = ordering(list(subtasks), network.temporal_constraints())
    if not isinstance(order, PartialOrder):
        raise Unsaid("its order is more than what comes before what; take out the times")
    if isinstance(order, TotalOrder):
        return [subtasks[identifier] for identifier in order.order]
    pairs = list(dict.fromkeys(order.precedences))
    circle = _circle(list(subtasks), pairs)
    if circle:
        raise Unsaid(f"its order runs in a circle ({' < '.join(circle)}); take out one of these pairs")
    if not pairs:
        return [Compound(("unordered", *subtasks.values()))]
    numbers = {identifier: number for number, identifier in enumerate(_first_order(list(subtasks), pairs), 1)}
    labelled = [Compound((":", f"t{number}", subtasks[identifier])) for identifier, number in numbers.items()]
    ordered = [Compound(("<", f"t{a}", f"t{b}")) for a, b in sorted((numbers[a], numbers[b]) for a, b in pairs)]
    return [Compound(("steps", make_list(labelled), make_list(ordered)))]


def _first_order(labels: Sequence[str], pairs: Sequence[tuple[str, str]]) -> list[str]:
    """The first order, as they are written, that keeps the pairs: the one in which a problem has them again."""
    import networkx as nx

    graph = nx.DiGraph()
    graph.add_nodes_from(labels)
    graph.add_edges_from(pairs)
    return list(nx.lexicographical_topological_sort(graph, labels.index))


def _circle(labels: Sequence[str], pairs: Sequence[tuple[str, str]]) -> list[str]:
    import networkx as nx

    graph = nx.DiGraph(pairs)
    graph.add_nodes_from(labels)
    try:
        found = nx.find_cycle(graph)
    except nx.NetworkXNoCycle:
        return []
    return [a for a, _ in found] + [found[0][0]]


def _item(vocabulary: Vocabulary, wording: Wording, subtask: Any) -> Term:
    needed: list[Term] = []
    arguments: list[Term] = []
    for parameter in subtask.parameters:
        more, term = wording.value(parameter)
        needed += more
        arguments.append(term)
    if needed:
        raise Unsaid(f"{subtask} is about what a fluent is; make that a parameter of the method")
    if isinstance(subtask.task, Task):
        return _term(outward(subtask.task.name), arguments)
    return vocabulary.step(subtask.task, arguments)


def asked(condition: Term) -> Compound:
    """A condition in a plan."""
    return Compound(("{}", condition))


def produced(head: Term, items: Sequence[Term]) -> str:
    """A production as it is written."""
    body = ", ".join(term_text(item, 999, sequences=True) for item in items)
    return f"{term_text(head)} --> {body or '[]'}."


def _term(name: str, arguments: Sequence[Term]) -> Term:
    return Compound((name, *arguments)) if arguments else name
