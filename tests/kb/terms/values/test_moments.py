"""Times without a clock: their order is known, seconds are not."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound
from casper.kb.terms.values.moments import Moment, moment_after

TAKEN, BREWED = Compound(("take", "pills")), Compound(("brew",))
FIRST = moment_after(())
SECOND = moment_after([(TAKEN, FIRST)])
IN_ORDER = [(TAKEN, FIRST), (BREWED, SECOND)]


def truth(body: str, history: list[tuple[Compound, float | Moment]] | None = None) -> bool | None:
    base = KnowledgeBase.from_text(f"asked :- {body}.")
    return base.verify("asked", IN_ORDER if history is None else history).valid


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("did(take(_), T), did(brew, T2), T < T2", True),
        ("did(take(_), T), did(brew, T2), T >= T2", False),
        ("did(take(_), T), did(brew, T2), T =\\= T2", True),
        ("did(take(_), T), did(_, T2), T =:= T2", True),
        ("did(take(_), T), \\+ (did(_, T2), T2 < T)", True),
        ("aggregate_all(max(T), did(_, T), M), did(brew, M)", True),
        ("did(brew, T), number(T)", True),
    ],
)
def test_which_came_first_is_known(body: str, expected: bool) -> None:
    assert truth(body) is expected


@pytest.mark.parametrize(
    "body",
    [
        "did(take(_), T), did(brew, T2), T2 - T >= 60",
        "did(take(_), T), did(brew, T2), T2 - T < 60",
        "did(take(_), T), \\+ (did(brew, T2), D is T2 - T, D >= 60)",
        "did(take(_), T), T > 3600",
        "did(take(_), T), T =:= 5",
        "did(_, T), max(T, 3) > 2",
        "aggregate_all(sum(T), did(_, T), S), S > 1",
    ],
)
def test_how_long_it_took_is_not(body: str) -> None:
    assert truth(body) is None


def test_what_has_no_order_is_not_compared() -> None:
    apart = [(TAKEN, Moment(0)), (BREWED, Moment(1))]
    assert truth("did(take(_), T), did(brew, T2), T < T2", apart) is None
    assert truth("did(take(_), T), did(brew, T2), T =:= T2", apart) is None


def test_it_is_later_than_the_seconds_before_it() -> None:
    after: list[tuple[Compound, float | Moment]] = [(TAKEN, 100.0)]
    after.append((BREWED, moment_after(after)))
    assert truth("did(take(_), T), did(brew, T2), T < T2", after) is True
    assert truth("did(brew, T), T > 60", after) is True
    assert truth("did(brew, T), T > 160", after) is None


def test_a_sentence_says_why_there_is_no_value() -> None:
    said = KnowledgeBase.from_text("asked :- did(brew, T), T - 1 > 2.").verify("asked", IN_ORDER)
    assert "moment 1 is known by its order only, not in seconds" in said.reasons[0]
