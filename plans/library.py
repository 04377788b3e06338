"""The plan library L = {Sigma, NT, G, T} (paper section III-E): productions and goals, and the plans they expand to.

    >>> library = PlanLibrary()
    >>> library.plan("tea(Cup)", "boil", "pour(Cup)")
    >>> library.goal("tea(mug)")
    >>> [str(leaf) for leaf in library.plans[0].leaves]
    ['boil', 'pour(mug)']
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from casper.kb.errors import Place, PlanError
from casper.kb.terms.clauses import Clause, Production, Sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import renamed, substitute, unify, variables_of
from casper.kb.text.lines import Shown, text_of
from casper.kb.text.reader import read_statement, read_text
from casper.kb.text.writer import program_lines, program_text
from casper.plans.grammar.expansion import MOST_PLANS, Unlisted, expand, labels
from casper.plans.grammar.shapes import items_in
from casper.plans.grammar.simple import simple_term
from casper.plans.networks.grammar import Grammar
from casper.plans.networks.tables import NEVER, Tables
from casper.plans.trees.plan import Plan
from casper.plans.trees.spelling import spelled_out

GOAL = ("goal", 1)
RECURSION = ("setting", "plans", "recursion")


class PlanLibrary(Shown):
    """Productions and goals in the author's order.

    ``ways`` holds a `Plan` for each goal, with its shapes (choices, optional, unordered and partly ordered steps) kept
    as they are: what the engine works on. Only alternatives that settle a parameter outside of them make several plans
    of a goal. ``plans`` spells everything out: one `Plan` for each choice, order and set of optional steps.
    """

    def __init__(self, sentences: Iterable[Sentence] = (), most_plans: int = MOST_PLANS) -> None:
        self._productions: list[Production] = []
        self._goals: list[Clause] = []
        self._most_plans = most_plans
        self._recursion: Clause | None = None
        self._plans: tuple[Plan, ...] | None = None
        self._ways: tuple[Plan, ...] | None = None
        self._unlisted: tuple[str, Place | None] | None = None  # why there are no ways to be had
        self._tables: Tables | None = None
        self.add(sentences)

    def __getstate__(self) -> dict[str, Any]:
        """The grammar alone: it is expanded anew where it arrives."""
        return {**self.__dict__, "_plans": None, "_ways": None, "_tables": None}

    @classmethod
    def from_text(cls, text: str, file: str = "<text>") -> PlanLibrary:
        """A library from the language's text.

        Raises:
            ReadError, PlanError: with the place of the first mistake.
        """
        library = cls(read_text(text, file))
        library.check()
        return library

    def add(self, sentences: Iterable[Sentence]) -> None:
        """Add productions and clauses of goal/1; other clauses are the knowledge base's and are left to it."""
        for sentence in sentences:
            if isinstance(sentence, Production):
                self._productions.append(sentence)
            elif isinstance(sentence, Clause) and sentence.head.indicator == GOAL:
                self._goals.append(sentence)
            elif isinstance(sentence, Clause) and sentence.head[:-1] == RECURSION:
                _depth(sentence)
                self._recursion = sentence
        self._plans = self._ways = self._unlisted = self._tables = None

    def plan(self, head: str, *body: str) -> None:
        """State a production: ``library.plan("clean(V)", "pick_and_place(V, sink)", "wash(V, sink)")``."""
        terms = [simple_term(text) for text in (head, *body)]
        if None in terms or not body:
            self.add(read_text(f"{head} --> {', '.join(body)}."))
        else:  # plain names and parameters need no parser
            items = [as_term(term) for term in terms[1:] if term is not None]
            self.add([Production(terms[0] or Compound(), items[0] if len(items) == 1 else Compound((",", *items)))])

    def goal(self, head: str) -> None:
        """State that a head of productions is a goal."""
        self.add([Clause(Compound(("goal", as_term(simple_term(head) or read_statement(head)))))])

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
        if not self.is_listed:
            return dict(self.tables.reached(tuple([goal.indicator for goal, _ in self.goal_terms])))
        found: dict[tuple[str, int], Place] = {}
        for action in (action for plan in self.ways for action in plan.actions):
            found.setdefault(action.term.indicator, action.place)
        return found

    @property
    def plans(self) -> tuple[Plan, ...]:
        """As `ways`, with every choice, every order and every set of optional parts spelled out.

        Raises:
            PlanError: as `ways`, and where there are too many.
        """
        if self._plans is None:
            self._plans = tuple(self._spelled_out())
        return self._plans

    def _spelled_out(self) -> Iterator[Plan]:
        numbers: Counter[str] = Counter()
        for plan in (plain for way in self.ways for plain in spelled_out(way)):
            yield plan if plan.way == numbers[plan.label] else replace(plan, way=numbers[plan.label])
            numbers[plan.label] += 1
            if numbers.total() > self._most_plans:
                sentence = f"the library has more than {self._most_plans} plans when all orders are spelled out"
                raise PlanError(f"{sentence}; {plan.label} alone has {numbers[plan.label]}", plan.place)

    @property
    def ways(self) -> tuple[Plan, ...]:
        """Every plan of every goal, goals in the order of their clauses (or, with none, of their productions).

        A plan keeps its shapes: a task of seventeen partly ordered steps is one plan.

        Raises:
            PlanError: a goal or task without production, an empty library, a goal that can only go on for ever.
            Unlisted: there is no end to the plans, or there are too many (`is_listed` says whether there are any).
        """
        if self._unlisted is not None:
            raise Unlisted(*self._unlisted)
        if self._ways is None:
            depth, stated = _depth(self._recursion), self._recursion is not None
            if stated:
                self._check_ends()
            try:
                self._ways = tuple(expand(self.goal_terms, self._productions, self._most_plans, recursion=depth))
            except Unlisted as mistake:
                self._unlisted = None if stated else (mistake.sentence, mistake.place)
                raise
        return self._ways

    @property
    def is_listed(self) -> bool:
        """Whether `ways` can be had: not of recursion without a stated bound, nor of too many plans.

        What is not listed is read as the grammar it is (`tables`). The attempt takes time linear in the text.

        Raises:
            PlanError: as `ways`, but for what is too large.
        """
        try:
            return self.ways is not None
        except Unlisted:
            if self._unlisted is None:  # the text says how far to unroll
                raise
            return False

    @property
    def tables(self) -> Tables:
        """The productions as the grammar they are, and what is known of its tasks; nothing is unrolled."""
        if self._tables is None:
            self._tables = Tables(Grammar(self._productions))
        return self._tables

    def check(self) -> None:
        """Refuse a library that means nothing.

        Raises:
            PlanError: with the place of the first mistake.
        """
        if self.is_listed:
            return
        grammar = self.tables.grammar
        for goal, place in self.goal_terms:
            if goal.indicator not in grammar:
                shown = term_text(as_term(goal))
                raise PlanError(f"the goal {shown} has no production: write {goal.functor} --> …", place)
            if not any(unify(renamed([m.head], 1)[0], goal, {}) is not None for m in grammar.methods(goal.indicator)):
                raise PlanError(f"no production fits the goal {term_text(as_term(goal))}", place)
        _ = grammar.everything  # every body is read
        self._check_ends()
        for goal, place in self.goal_terms:
            if not self.tables.contained[goal.indicator]:
                raise PlanError(f"a plan of {goal.functor} has no action at all", place)

    def _check_ends(self) -> None:
        """Refuse goals that nobody could ever finish."""
        least = self.tables.least
        for goal, _ in self.goal_terms:
            if least.get(goal.indicator) == NEVER:
                circle, place = self.tables.circle_of(goal.indicator)
                raise PlanError(endless_sentence(circle), place)

    @property
    def goals(self) -> tuple[str, ...]:
        """The labels of the goals, in order."""
        if not self.is_listed:
            return tuple(labels([goal for goal, _ in self.goal_terms]))
        return tuple(dict.fromkeys(plan.label for plan in self.ways))

    def to_text(self) -> str:
        """The library as text that reads in as the same one."""
        settings = [] if self._recursion is None else [self._recursion]
        return program_text([*settings, *self._goals, *self._productions])

    @property
    def goal_terms(self) -> list[tuple[Compound, Place]]:
        """The stated goals; where none is stated, every task that no production uses."""
        if self._goals:
            stated: dict[Compound, tuple[Compound, Place]] = {}
            for clause in self._goals:  # several clauses may state conditions of one goal
                goal = goal_of(clause)
                stated.setdefault(_general_names(goal), (goal, clause.place))
            return list(stated.values())
        used: set[tuple[str, int]] = set()
        for production in self._productions:
            used.update(other for other in _mentioned(production.body) if other != production.head.indicator)
        heads = {p.head.indicator: p for p in reversed(self._productions) if p.head.indicator not in used}
        if self._productions and not heads:
            place = self._productions[0].place
            raise PlanError("every task is part of another one: say which are goals, with goal(Name).", place)
        ordered = [p for p in self._productions if heads.get(p.head.indicator) is p]
        times = Counter(p.head.indicator for p in self._productions)
        return [(p.head if times[p.head.indicator] == 1 else _general(p.head), p.place) for p in ordered]

    def __len__(self) -> int:
        return len(self.ways) if self.is_listed else len(self.goals)

    def __str__(self) -> str:
        return text_of(program_lines([*self._goals, *self._productions]))

    def __repr__(self) -> str:
        try:
            plans = f"{len(self.ways)} plans" if self.is_listed else "plans without end"
            return f"<PlanLibrary: {len(self.goals)} goals, {plans}>"
        except PlanError:  # not yet whole
            return f"<PlanLibrary: {len(self._productions)} productions>"


def goal_of(clause: Clause) -> Compound:
    """The goal that a clause of goal/1 states."""
    try:
        return predication(clause.head[1])
    except TypeError:
        shown = term_text(clause.head[1])
        sentence = f"goal({shown}) does not name a goal: write goal(name) or goal(name(Parameter))"
        raise PlanError(sentence, clause.place) from None


def endless_sentence(circle: Sequence[tuple[str, int]]) -> str:
    """That a circle of tasks has no end, and what to do."""
    shown = " needs ".join(name for name, _ in (*circle, circle[0]))
    task = circle[0][0]
    return f"the task {task} can only go on for ever ({shown}): give it a production that ends, such as {task} --> []"


def _general_names(goal: Compound) -> Compound:
    """The goal with its parameters numbered: equal for goals that differ in names only."""
    named: Compound = substitute(goal, {v: Variable("Parameter", at) for at, v in enumerate(variables_of(goal), 1)})
    return named


def _depth(setting: Clause | None) -> int:
    """The bound of ``setting(plans, recursion, N)``; 0 when it is not stated."""
    if setting is None:
        return 0
    bound = setting.head[-1]
    if not isinstance(bound, int) or bound < 0 or setting.body:
        raise PlanError("setting(plans, recursion, N) takes a whole number, the depth to unroll to", setting.place)
    return bound


def _general(head: Compound) -> Compound:
    """The most general term of the head's name and arity: several productions may each bind its parameters."""
    return Compound([head.functor, *(Variable(f"Parameter{at}") for at in range(1, head.arity + 1))])


def _mentioned(body: Term) -> Iterable[tuple[str, int]]:
    """Name and arity of every item of a production's body, through brackets, shapes and alternatives."""
    return [predication(item).indicator for item in items_in(body) if isinstance(item, (str, Compound))]
