import math

import pytest

from casper.engine.perception.world import world_state_from_json
from casper.engine.reading.priors import priors_of
from casper.engine.settings import number
from casper.engine.verification.observation import seen_of
from casper.kb.errors import CasperError
from casper.kb.terms.numbers import as_float

HUGE = 10**400


def test_what_is_no_number_of_use_compares_with_nothing():
    assert [as_float(value) for value in (1, 2.5, -3)] == [1.0, 2.5, -3.0]
    assert all(math.isnan(as_float(value)) for value in (True, "1", None, HUGE, -HUGE, math.nan))


@pytest.mark.parametrize(
    "use",
    [
        lambda: world_state_from_json({"t": HUGE, "agents": {}, "objects": {}}),
        lambda: world_state_from_json({"t": 1, "agents": {}, "objects": {"cup": {"x": HUGE, "y": 0}}}),
        lambda: number(HUGE, "setting(focus, sigma, …)"),
        lambda: priors_of([("g", HUGE)], ["g"], lambda row: None),
        lambda: priors_of([("g", 1e308), ("h", 1e308)], ["g", "h"], lambda row: None),
        lambda: seen_of({"a": HUGE}, [("a", 0)]),
        lambda: seen_of({"a": 1e308, "b": 1e308}, [("a", 0), ("b", 0)]),
    ],
)
def test_a_number_too_large_is_one_sentence(use):
    with pytest.raises(CasperError) as told:
        use()
    assert len(str(told.value)) < 200
