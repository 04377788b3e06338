"""The laws that every domain should keep: `contract` and the pytest plugin hold a domain to them.

In: a domain. Out: nothing, or an AssertionError with the smallest counterexample that was found.
"""

from casper.testing.laws.law import Law as Law
from casper.testing.laws.law import NotApplicable as NotApplicable
from casper.testing.laws.plans import goals_are_recognised, order_of_goals_is_nothing, plans_can_be_done
from casper.testing.laws.readings import (
    marks_stand_in_order,
    robot_plans_are_valid,
    shares_add_up,
    taking_back_is_not_having_seen,
)
from casper.testing.laws.rules import (
    changes_are_followed,
    constraints_can_fire,
    rejections_name_what_to_mend,
    texts_read_back,
)

LAWS = tuple(
    Law(check.__name__, check)
    for check in (
        texts_read_back,
        plans_can_be_done,
        goals_are_recognised,
        constraints_can_fire,
        rejections_name_what_to_mend,
        changes_are_followed,
        order_of_goals_is_nothing,
        shares_add_up,
        marks_stand_in_order,
        taking_back_is_not_having_seen,
        robot_plans_are_valid,
    )
)
