"""The built-ins on long lists, as goals and answers: length, member, append."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound, Variable, list_items, make_list

from ..bounds import Bound
from ..figures import OURS, Amounts, Figure, Found, Sizes, attempt, fingerprint, per_call
from ..peers import prolog

TITLE = "Lists"
TIMED = (
    "All answers of one goal, warm. casper's `instances` takes the list as a term and gives a term for each answer; "
    "SWI-Prolog makes the list beforehand and runs the goal in its own process."
)
X, Y = Variable("X"), Variable("Y")


@dataclass(frozen=True, slots=True)
class Goal:
    """A goal as a term and as text about a list L, which another goal makes; and what is compared of an answer.

    ``told`` is a number or an element of an answer, ``X`` the same in Prolog after ``more``.
    """

    term: Compound
    told: Callable[[Compound], Any]
    made: str
    text: str
    more: str = "true"


def goals(sizes: Sizes) -> dict[str, Goal]:
    """By task."""
    long, short = make_list(range(1, sizes.length + 1)), make_list(range(1, sizes.splits))
    made = f"numlist(1, {sizes.length}, L)"
    return {
        "length(L, 2)": Goal(
            Compound(("length", X, 2)), _unknowns, "true", "length(M, 2)", "term_variables(M, V), length(V, X)"
        ),
        f"length of a list of {sizes.length:,}": Goal(
            Compound(("length", long, X)), lambda a: a[2], made, "length(L, X)"
        ),
        f"member of a list of {sizes.length:,}, every answer": Goal(
            Compound(("member", X, long)), lambda a: a[1], made, "member(X, L)"
        ),
        f"append backwards, {sizes.splits:,} answers": Goal(
            Compound(("append", X, Y, short)),
            lambda a: len(list_items(a[1])[0]),
            f"numlist(1, {sizes.splits - 1}, L)",
            "append(A, _, L)",
            "length(A, X)",
        ),
    }


def _unknowns(answer: Compound) -> int:
    """How many different variables the list of an answer has."""
    return len({item for item in list_items(answer[1])[0] if isinstance(item, Variable)})


def measure(sizes: Sizes) -> Found:
    """Every goal by both."""
    kb = KnowledgeBase()
    for task, goal in goals(sizes).items():
        seconds, found = per_call(lambda g=goal: list(kb.instances(g.term)), sizes=sizes)
        yield Figure(task, OURS, seconds, fingerprint([goal.told(answer)] for answer in found))
        yield attempt(task, "swipl", partial(_prolog, goal, sizes))


def _prolog(goal: Goal, sizes: Sizes) -> tuple[float, tuple[int, int]] | str:
    text = f":- initialization(({goal.made}, nb_setval(kept, L)), now)."
    asked = f"nb_getval(kept, L), {goal.text}"
    return prolog.enumerated(text, asked, ["X"], sizes, query=f"{asked}, {goal.more}")


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """They are answered, and as SWI-Prolog answers them: a task with other answers has no amount."""
    for task in goals(sizes):
        answered = (task, OURS) in amounts and (task, "swipl") in amounts
        yield Bound(f"{task}: as SWI-Prolog", 1.0 if answered else None, 1, "answered", at_least=True)
