"""``casper run`` with several goals: what is asked for is checked before anything is built."""

import pytest

pytest.importorskip("mujoco")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--goal", "drink", "--goal", "lunch", "--goals-in-a-row", "1"), "2 goals are asked for, so it takes as many in a row, not 1"),
        (("--goal", "drink,lunch", "--goals-in-a-row", "1"), "2 goals are asked for, so it takes as many in a row, not 1"),
        (("--goals-in-a-row", "0"), "0 goals in a row are too few: it takes 1 or more"),
        (("--goal", "drink,tea"), "there is no goal 'tea': choose breakfast, drink, lunch"),
        (("--goals-in-a-row", "1", "--changes-mind"), "1 goals in a row are too few: it takes 2 or more"),
    ],
)
def test_a_day_that_makes_no_sense_is_one_sentence(casper, arguments, said):
    told = casper("run", "kitchen", *arguments)
    assert (told.code, told.err) == (2, f"casper: {said}\n")
