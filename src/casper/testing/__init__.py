"""For test suites of people with a domain or an engine of their own (docs/testing.md; needs ``casper-hri[testing]``).

Here: asserts, which need no hypothesis. Beside them: `strategies` of statements, facts, observations and programs,
`oracles`, `machines`, `profiles`, and `contract`: test classes that hold a domain, a recogniser or a planner to laws.

    from casper.testing import assert_recognises, assert_rejected
    assert_rejected(kitchen, "eat(tiago, meal, plate)", because="not a human")
    assert_recognises(kitchen, ["pick_and_place(meal, hobs)", "cook(meal, hobs)"], "lunch", by=1)
"""

from casper.testing.asserts import assert_explains as assert_explains
from casper.testing.asserts import assert_recognises as assert_recognises
from casper.testing.asserts import assert_rejected as assert_rejected
from casper.testing.asserts import assert_same_answers as assert_same_answers
from casper.testing.asserts import assert_valid as assert_valid
