"""What conditions know of a past that is longer than is kept observation by observation."""

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.remembering import MOST_MOMENTS, Failed
from casper.engine.episodes.past import MOST
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound

KB = KnowledgeBase.from_text("a(_, _). done(X) :- did(a(_, X), _).")


def after(*things: str) -> Asking:
    asking = Asking(KB)
    for thing in things:
        asking.observed(Compound(("a", "ann", thing)), None)
    return asking


def holds(asking: Asking, thing: str, moment: int = -1) -> object:
    settled = asking.settled((asking.due(("done", thing), moment=moment),), {})
    return False if isinstance(settled, Failed) else not settled[1] or None


def test_what_happened_long_ago_still_happened() -> None:
    asking = after("cup", *["pot"] * 3 * MOST_MOMENTS)
    assert holds(asking, "cup") is True
    assert holds(asking, "pan") is False


def test_what_had_happened_by_a_moment_long_ago_is_not_known() -> None:
    asking = after("cup", *["pot"] * 3 * MOST_MOMENTS)
    assert holds(asking, "pan", moment=MOST_MOMENTS) is None


def test_by_a_moment_that_is_kept_it_is() -> None:
    asking = after(*["pot"] * 3 * MOST_MOMENTS, "cup", "pot")
    assert holds(asking, "cup", moment=3 * MOST_MOMENTS) is False
    assert holds(asking, "cup", moment=3 * MOST_MOMENTS + 1) is True


def test_at_first_nothing_had_happened() -> None:
    asking = Asking(KB)
    (due,) = (asking.due(("done", "pot")),)
    for _ in range(2 * MOST_MOMENTS):
        asking.observed(Compound(("a", "ann", "pot")), None)
    assert isinstance(asking.settled((due,), {}), Failed)


def test_the_past_does_not_grow_with_the_day() -> None:
    asking = after(*["pot", "cup"] * MOST)
    assert len(asking.past) == MOST_MOMENTS
    assert len(asking.__reduce__()[1][2]) <= MOST
    assert asking.now == 2 * MOST
