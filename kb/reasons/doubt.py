"""Why a statement is undefined: the evaluation that failed, or the circle that its negation runs in.

From an undefined atom some rule leads, through a condition that is undefined in turn, to the next; followed far enough,
that ends in an expression without a value, or comes back through a negation to where it was.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from casper.kb.terms.clauses import Clause, Literal, is_auxiliary
from casper.kb.terms.comparison import compare, is_ready
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify
from casper.kb.terms.unknown import DOUBT, UNKNOWN, closed, opened
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.text.lines import Shown
from casper.kb.text.writer import literal_text
from casper.kb.top_down.compiled.cells import serials as fresh_numbers
from casper.kb.top_down.solve import Solver

SHOWN_AT_ENDS = 4  # conditions at each end of a long way that a sentence names
MOST_ATOMS = 5_000  # looked at in search of a circle
MOST_WAYS = 200  # instances of its rules looked at for one atom


@dataclass(frozen=True, slots=True)
class Step:
    """One undefined atom: the rule that would give it, the body's instance, and its condition that is undefined.

    ``failure`` says why that condition has no value, where it is a comparison or an aggregate; otherwise ``needs`` is
    the undefined atom that it is about.
    """

    fact: Compound
    clause: Clause
    body: tuple[Literal, ...]
    literal: Literal
    failure: str = ""
    needs: Compound | None = None


@dataclass(frozen=True, slots=True)
class Doubt(Shown):
    """Why a statement is neither true nor false.

    ``steps`` lead from the statement on, each to the atom of the condition before; the last one ends in a failed
    evaluation, or leads back to the step number ``back``.
    """

    fact: Compound
    steps: tuple[Step, ...] = ()
    back: int | None = None
    remark: str = ""

    @property
    def sentence(self) -> str:
        """The reason in one sentence."""
        text = f"{_shown(self.fact, self.steps)} is undefined"
        if not self.steps:
            return f"{text}: {self.remark}" if self.remark else text
        last = self.steps[-1]
        needs = ", which needs ".join(_few([literal_text(step.literal) for step in self.steps]))
        text = f"{text}: it needs {needs}"
        if last.failure:
            shown = ", ".join(map(literal_text, last.body))
            place = f" at {_place(last.clause)}" if _place(last.clause) else ""
            head = "" if is_auxiliary(last.fact.indicator) else f"{_shown(last.fact, [last])} :- "
            return f"{text}, and {last.failure} (in {head}{shown}{place})"
        return f"{text}; that is a circle"

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        if not self.steps:
            yield self.sentence
            return
        yield f"{_shown(self.fact, self.steps)}   [undefined]{_mark(self.steps[0].clause)}"
        for depth, step in enumerate(self.steps):
            following = self.steps[depth + 1 : depth + 2]
            mark = "".join(_mark(each.clause) for each in following)
            yield f"{'   ' * depth}└─ {literal_text(step.literal)}   [{self._note(depth, step)}]{mark}"

    def _note(self, depth: int, step: Step) -> str:
        if step.failure:
            return step.failure
        if depth == len(self.steps) - 1 and self.back is not None:
            return f"undefined: back to {_shown(self.steps[self.back].fact, self.steps[self.back :])}"
        return "undefined"

    def premises_first(self) -> Iterator[Step]:
        """The steps, the last first."""
        return reversed(self.steps)

    def to_json(self) -> dict[str, Any]:
        """``{"fact", "by": "undefined", "reason", "back", "steps": [{"fact", "place", …}]}``."""
        steps = [
            {
                "fact": _shown(step.fact, [step]),
                "place": _place(step.clause) or None,
                "body": [literal_text(x) for x in step.body],
                "needs": literal_text(step.literal),
                "failure": step.failure or None,
            }
            for step in self.steps
        ]
        fact = term_text(as_term(self.fact))
        return {"fact": fact, "by": "undefined", "reason": self.sentence, "steps": steps, "back": self.back}


def doubt_of(atom: Compound, solver: Solver) -> Doubt | None:
    """Why an atom is undefined; None when it is true or false.

    Raises:
        BudgetExceeded: the search outlived the solver's budget.
    """
    remark = undefined_by(Literal(atom), solver)
    if remark is None:
        return None
    found = _Search(solver).run(atom) if is_ground(atom) else None
    return found or Doubt(atom, remark="" if "is undefined" in remark else remark)


def undefined_by(literal: Literal, solver: Solver) -> str | None:
    """What makes a condition undefined, in a few words; None when it is true or false."""
    remark = None
    for found in solver.possible([literal]):
        if DOUBT not in found:
            return None
        remark = remark or str(found[DOUBT])
    return remark


class _Search:
    """Breadth first over undefined atoms, until an evaluation has failed or a circle through a negation is closed."""

    def __init__(self, solver: Solver) -> None:
        self.solver = solver
        self.steps: dict[Compound, list[Step]] = {}  # of each atom looked at
        self.reached: dict[Compound, tuple[Compound, Step] | None] = {}  # from which atom, by which step

    def run(self, start: Compound) -> Doubt | None:
        """The shortest reason that is found first."""
        self.reached[start] = None
        waiting = [start]
        for atom in waiting:  # it grows
            if len(self.steps) >= MOST_ATOMS:
                break
            self.steps[atom] = []
            for step in self._ways(atom):
                self.steps[atom].append(step)
                if step.failure:
                    return Doubt(start, (*self._path(atom), step))
                following = step.needs
                assert following is not None
                if following not in self.reached:
                    self.reached[following] = (atom, step)
                    waiting.append(following)
                elif (circle := self._closed(atom, step)) is not None:
                    return Doubt(start, *circle)
        return self._any_circle(start)

    def _path(self, atom: Compound) -> list[Step]:
        """The steps from the start to an atom."""
        found: list[Step] = []
        came = self.reached[atom]
        while came is not None:
            found.append(came[1])
            came = self.reached[came[0]]
        return found[::-1]

    def _closed(self, atom: Compound, step: Step) -> tuple[tuple[Step, ...], int] | None:
        """The way to the atom and the step, where that leads back to a place on the way through a negation."""
        path = (*self._path(atom), step)
        facts = [each.fact for each in path]
        back = facts.index(step.needs) if step.needs in facts else None
        if back is None or not any(each.literal.negated for each in path[back:]):
            return None
        return path, back

    def _any_circle(self, start: Compound) -> Doubt | None:
        """A circle through any negation that was met."""
        for step in (s for steps in self.steps.values() for s in steps if s.literal.negated):
            home = None if step.needs is None else self._way(step.needs, step.fact)
            if home is not None:
                path = self._path(step.fact)
                return Doubt(start, (*path, step, *home), len(path))
        return None

    def _way(self, start: Compound, goal: Compound) -> list[Step] | None:
        """Steps from one atom to another among those that were looked at."""
        came: dict[Compound, Step | None] = {start: None}
        waiting = [start]
        for atom in waiting:  # it grows
            if atom == goal:
                found: list[Step] = []
                while (step := came[atom]) is not None:
                    found.append(step)
                    atom = step.fact
                return found[::-1]
            for step in self.steps.get(atom, ()):
                if step.needs is not None and step.needs not in came:
                    came[step.needs] = step
                    waiting.append(step.needs)
        return None

    def _ways(self, atom: Compound) -> Iterator[Step]:
        """Every condition that leaves the atom undefined, with the instance of its rule."""
        asked = opened(atom, fresh_numbers)
        for clause in self.solver.clauses.get(atom.indicator, ()):
            head, body = self.solver.fresh(clause)
            bindings = unify(head, asked, {})
            if bindings is None:
                continue
            for number, solution in enumerate(self.solver.possible(body, bindings)):
                if number >= MOST_WAYS:
                    break
                if DOUBT in solution:
                    yield from self._undefined_in(atom, clause, [x.instance(solution) for x in body])

    def _undefined_in(self, atom: Compound, clause: Clause, body: Sequence[Literal]) -> Iterator[Step]:
        shown = tuple(map(_with_unknowns, body))
        for literal, written in zip(body, shown):
            if literal.is_comparison:
                failure = _failure(literal)
                if failure:
                    yield Step(atom, clause, shown, written, failure)
            elif self.solver.next_of([literal], {}) is None:
                continue  # what it asks about came from a value that could not be worked out
            elif not (literal.is_strict or is_ground(literal.atom)):  # a row with an unknown value was met
                needs = self._undefined_atom(literal.atom)
                if needs is not None:
                    yield Step(atom, clause, shown, written, "", needs)
            elif (remark := undefined_by(literal, self.solver)) is not None:
                needs = self._undefined_atom(literal.atom[2] if literal.is_aggregate else literal.atom)
                if needs is not None:
                    yield Step(atom, clause, shown, written, "", needs)
                elif literal.is_aggregate:
                    yield Step(atom, clause, shown, written, remark)

    def _undefined_atom(self, atom: Compound) -> Compound | None:
        """An undefined atom that the given one can be; what could not be worked out is unknown in it."""
        for found in self.solver.possible([Literal(atom)]):
            instance: Compound = substitute(atom, found)
            if DOUBT not in found:
                continue
            if not is_ground(instance) or undefined_by(Literal(instance), self.solver) is not None:
                return Compound([closed(part) for part in instance])
        return None


def _with_unknowns(literal: Literal) -> Literal:
    """The condition with what could not be worked out as unknown; wildcards stay."""
    names: Bindings = {v: UNKNOWN for v in literal.variables() if not v.is_anonymous}
    return literal.instance(names) if names else literal


def _failure(literal: Literal) -> str:
    """Why a comparison has no value, or nothing; one with an open part is not to blame."""
    if not is_ready(literal, {}):
        return ""
    try:
        compare(literal, {})
    except EvaluationFailed as failure:
        return failure.sentence
    return ""


def _few(needs: Sequence[str]) -> Sequence[str]:
    """A long way by its ends."""
    if len(needs) <= 2 * SHOWN_AT_ENDS + 1:
        return needs
    left_out = len(needs) - 2 * SHOWN_AT_ENDS
    return [*needs[:SHOWN_AT_ENDS], f"… {left_out} more …", *needs[-SHOWN_AT_ENDS:]]


def _shown(atom: Compound, steps: Sequence[Step]) -> str:
    """An atom in words; one that stands for a goal inside a clause as that goal."""
    if is_auxiliary(atom.indicator) and steps:
        return ", ".join(map(literal_text, steps[0].body))
    return term_text(as_term(atom))


def _mark(clause: Clause) -> str:
    return f"   [{_place(clause)}]" if _place(clause) else ""


def _place(clause: Clause) -> str:
    return f"{clause.place.file.rsplit('/', 1)[-1]}:{clause.place.line}" if clause.place.line else ""


