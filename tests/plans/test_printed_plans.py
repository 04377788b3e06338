"""Plans and libraries print themselves."""

from casper import PlanLibrary

LIBRARY = PlanLibrary.from_text("goal(tea(C)).\ntea(C) --> fill(C, 'a:x:b'), (sip(C) ; drink(C)).\n")


def test_a_plan_prints_as_a_tree_of_what_is_to_be_done():
    assert str(LIBRARY.ways[0]).splitlines() == [
        "╙── tea(C)",
        "    ├─╼ ○ fill(C, 'a:x:b')",
        "    ├─╼ ○ sip(C)",
        "    └─╼ ○ or drink(C)",
    ]


def test_the_repr_of_a_plan_is_one_line_with_its_actions():
    assert repr(LIBRARY.ways[0]) == "<Plan tea(C): fill(C, 'a:x:b'), sip(C), drink(C)>"


def test_the_repr_of_a_plan_of_many_actions_is_cut():
    long = PlanLibrary.from_text(f"g --> {', '.join(f'a{number}' for number in range(1000))}.")
    assert repr(long.ways[0]).endswith("…>")
    assert len(repr(long.ways[0])) < 200


def test_a_library_prints_its_productions_which_read_in_again_as_the_same():
    assert str(LIBRARY) == "goal(tea(C)).\ntea(C) --> fill(C, 'a:x:b'), (sip(C) ; drink(C))."
    assert PlanLibrary.from_text(str(LIBRARY)).ways == LIBRARY.ways


def test_a_large_library_prints_its_first_productions_and_how_many_more_there_are():
    large = PlanLibrary.from_text("".join(f"g{number} --> a, b.\n" for number in range(100)))
    told = str(large).splitlines()
    assert (told[0], told[-1], len(told)) == ("g0 --> a, b.", "% … and 60 more", 41)


def test_a_library_that_is_not_whole_yet_can_be_told_apart_and_printed():
    library = PlanLibrary()
    library.goal("tea")
    assert repr(library) == "<PlanLibrary: 0 productions>"
    assert str(library) == "goal(tea)."
