"""The plan library L = {Sigma, NT, G, T} (paper section III-E): productions and goals, and the plans they expand to.

    >>> library = PlanLibrary()
    >>> library.plan("tea(Cup)", "boil", "pour(Cup)")
    >>> library.goal("tea(mug)")
    >>> [str(leaf) for leaf in library.plans[0].leaves]
    ['boil', 'pour(mug)']
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from casper.kb.clauses import Clause, Production, Sentence
from casper.kb.errors import Place, PlanError
from casper.kb.reader import read_statement, read_text
from casper.kb.terms import Compound, Term, Variable, as_term, predication, substitute, variables_of
from casper.kb.writer import program_text, term_text
from casper.plans.expansion import MOST_PLANS, SHAPES, expand
from casper.plans.plan import Plan

GOAL = ("goal", 1)


class PlanLibrary:
    """Productions and goals in the author's order.

    ``plans`` holds every way to pursue every goal: one `Plan` for each choice among alternatives.
    """

    def __init__(self, sentences: Iterable[Sentence] = (), most_plans: int = MOST_PLANS) -> None:
        self._productions: list[Production] = []
        self._goals: list[Clause] = []
        self._most_plans = most_plans
        self._plans: tuple[Plan, ...] | None = None
        self.add(sentences)

    @classmethod
    def from_text(cls, text: str, file: str = "<text>") -> PlanLibrary:
        """A library from the language's text.

        Raises:
            ReadError, PlanError: with the place of the first mistake.
        """
        library = cls(read_text(text, file))
        _ = library.plans
        return library

    def add(self, sentences: Iterable[Sentence]) -> None:
        """Add productions and clauses of goal/1; other clauses are the knowledge base's and are left to it."""
        for sentence in sentences:
            if isinstance(sentence, Production):
                self._productions.append(sentence)
            elif isinstance(sentence, Clause) and sentence.head.indicator == GOAL:
                self._goals.append(sentence)
        self._plans = None

    def plan(self, head: str, *body: str) -> None:
        """State a production: ``library.plan("clean(V)", "pick_and_place(V, sink)", "wash(V, sink)")``."""
        self.add(read_text(f"{head} --> {', '.join(body)}."))

    def goal(self, head: str) -> None:
        """State that a head of productions is a goal."""
        self.add([Clause(Compound(("goal", as_term(read_statement(head)))))])

    @property
    def productions(self) -> Sequence[Production]:
        """The grammar, in the author's order."""
        return tuple(self._productions)

    @property
    def goal_clauses(self) -> Sequence[Clause]:
        """The clauses of goal/1; their bodies are conditions for the knowledge base."""
        return tuple(self._goals)

    @property
    def tasks(self) -> frozenset[tuple[str, int]]:
        """Name and arity of everything that has a production: goals and the non-terminals NT."""
        return frozenset(p.head.indicator for p in self._productions)

    @property
    def actions(self) -> dict[tuple[str, int], Place]:
        """The terminals Sigma by name and arity, with the place of the first production that names each."""
        found: dict[tuple[str, int], Place] = {}
        for action in (action for plan in self.plans for action in plan.actions):
            found.setdefault(action.term.indicator, action.place)
        return found

    @property
    def plans(self) -> tuple[Plan, ...]:
        """Every plan of every goal, goals in the order of their clauses (or, with none, of their productions).

        Raises:
            PlanError: a goal or task without production, a task that contains itself, an empty or endless library.
        """
        if self._plans is None:
            self._plans = tuple(expand(self._goal_terms(), self._productions, self._most_plans))
        return self._plans

    @property
    def goals(self) -> tuple[str, ...]:
        """The labels of the goals, in order."""
        return tuple(dict.fromkeys(plan.label for plan in self.plans))

    def to_text(self) -> str:
        """The library as text that reads in as the same one."""
        return program_text([*self._goals, *self._productions])

    def _goal_terms(self) -> list[tuple[Compound, Place]]:
        """The stated goals; where none is stated, every task that no production uses."""
        if self._goals:
            stated: dict[Compound, tuple[Compound, Place]] = {}
            for clause in self._goals:  # several clauses may state conditions of one goal
                goal = _goal_of(clause)
                stated.setdefault(_general_names(goal), (goal, clause.place))
            return list(stated.values())
        used = {indicator for p in self._productions for indicator in _mentioned(p.body)}
        heads = {p.head.indicator: p for p in reversed(self._productions) if p.head.indicator not in used}
        if self._productions and not heads:
            place = self._productions[0].place
            raise PlanError("every task is part of another one: say which are goals, with goal(Name).", place)
        ordered = [p for p in self._productions if heads.get(p.head.indicator) is p]
        return [(p.head if _is_general(p, self._productions) else _general(p.head), p.place) for p in ordered]

    def __len__(self) -> int:
        return len(self.plans)

    def __repr__(self) -> str:
        return f"<PlanLibrary: {len(self.goals)} goals, {len(self.plans)} plans>"


def _goal_of(clause: Clause) -> Compound:
    try:
        return predication(clause.head[1])
    except TypeError:
        shown = term_text(clause.head[1])
        sentence = f"goal({shown}) does not name a goal: write goal(name) or goal(name(Parameter))"
        raise PlanError(sentence, clause.place) from None


def _general_names(goal: Compound) -> Compound:
    """The goal with its parameters numbered: equal for goals that differ in names only."""
    named: Compound = substitute(goal, {v: Variable("Parameter", at) for at, v in enumerate(variables_of(goal), 1)})
    return named


def _is_general(production: Production, productions: Sequence[Production]) -> bool:
    return sum(p.head.indicator == production.head.indicator for p in productions) == 1


def _general(head: Compound) -> Compound:
    """The most general term of the head's name and arity: several productions may each bind its parameters."""
    return Compound([head.functor, *(Variable(f"Parameter{at}") for at in range(1, head.arity + 1))])


def _mentioned(body: Term) -> Iterable[tuple[str, int]]:
    """Name and arity of every item of a production's body, through brackets, shapes and alternatives."""
    if isinstance(body, str):
        yield body, 0
    elif isinstance(body, Compound):
        yield body.indicator
        if body.functor in SHAPES or body.functor in (".", ":"):  # the lists and labels of steps
            for arg in body.args:
                yield from _mentioned(arg)
