"""What kind of term something is. A kind is asked for once the term is known well enough to have one.

In Prolog ``atom(X)`` fails of an open X that may become an atom yet; here it waits, so that the order of conditions
never changes what holds.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.kb.terms.values.moments import Moment
from casper.kb.top_down.builtins.builtin import Builtin, Outcome, has_end, is_ground, is_known, walked_list


def _is_number(term: Any) -> bool:
    return type(term) in (int, float, Moment)


def _test(holds: Callable[[Any], bool], ready: Callable[[Any], bool] = is_known) -> Builtin:
    def run(term: Any) -> Outcome:
        return (None,) if holds(term) else None

    return Builtin(run, ready)


KINDS = {
    ("number", 1): _test(_is_number),
    ("integer", 1): _test(lambda term: type(term) is int),
    ("float", 1): _test(lambda term: type(term) in (float, Moment)),
    ("atom", 1): _test(lambda term: type(term) is str),
    ("atomic", 1): _test(lambda term: not isinstance(term, tuple)),
    ("compound", 1): _test(lambda term: isinstance(term, tuple)),
    ("callable", 1): _test(lambda term: isinstance(term, tuple) or type(term) is str),
    ("nonvar", 1): _test(lambda _: True),
    ("var", 1): _test(lambda _: False),
    ("ground", 1): _test(lambda _: True, is_ground),
    ("is_list", 1): _test(lambda term: bool(walked_list(term)[1] == "[]"), has_end),
}
