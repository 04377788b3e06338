import pytest

from casper.kb.errors import ReadError
from casper.plans.library import PlanLibrary


def test_a_step_that_is_no_plain_term_is_read_by_the_parser_and_not_lost():
    library = PlanLibrary()
    library.plan("tea", "boil", "optional((milk, stir))", "drink")
    (plan,) = library.ways
    assert [leaf.functor for leaf in plan.leaves] == ["boil", "milk", "stir", "drink"]


def test_a_production_of_nothing_is_refused():
    with pytest.raises(ReadError):
        PlanLibrary().plan("tea")
