"""A reading prints what `casper explain` shows; its parts print themselves."""

import pytest
from readings import domain, reading

PLATE = "pick_and_place(biscuits, plate)"
MARKED = "goal(tea('a:x:b')). goal(tea('[bold]')). goal(rest).\ntea(C) --> fill(C), sip(C).\nrest --> fill(mug), sit.\n"


def test_a_reading_prints_goals_outcome_trees_and_what_is_yet_to_come():
    assert str(reading("pick_and_place", "eat")).splitlines()[:12] == [
        "pick_and_place → eat ───────────────────────────────────────────────────────────",
        "3 explanations, confidence 0.53",
        "  breakfast    █████▎     0.53",
        "  drink                   0.00  not this: drink has no eat",
        "  lunch        ████▊      0.47",
        "outcome: breakfast",
        "score 0.500, share 0.53",
        "╙── breakfast(biscuits)",
        "    ├─╼ ● pick_and_place(biscuits, plate)",
        "    ├─╼ ● eat(biscuits, plate)",
        "    └─╼ clean(plate)",
        "        ├─╼ ○ pick_and_place(plate, sink)",
    ]
    assert str(reading("eat")).splitlines()[-1] == "yet to come: pick_and_place(plate, sink), wash(plate, sink)"


def test_before_anything_is_observed_it_says_so():
    told = str(reading()).splitlines()
    assert told[0].startswith("nothing observed ──")
    assert told[-1] == "outcome: undecided"


def test_a_long_row_of_observations_is_shown_in_full():
    seen = reading(*["pick_and_place(meal, hobs)", "cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)"])
    assert str(seen).splitlines()[0] == (
        "pick_and_place(meal, hobs) → cook(meal, hobs) → pick_and_place(meal, plate) → eat(meal, plate)"
    )


def test_of_many_goals_the_likeliest_are_shown_and_how_many_there_are_besides(tmp_path):
    many = domain(tmp_path, "".join(f"goal(g{n}). g{n} --> a, b{n}.\n" for n in range(50))).reading()
    many.observe("b7")
    told = str(many).splitlines()
    assert told[2].startswith("  g7           ██████████ 1.00")
    assert "  … and 20 goals that are no likelier" in told


def test_questions_are_printed_when_they_are_asked_for():
    asked = [spans for spans in reading("eat").lines(top=0, asked=1)][-1]
    assert "".join(span.text for span in asked).startswith("ask: ")


@pytest.mark.parametrize(
    ("observed", "shown"),
    [
        ((), "<Reading of 0 observations>"),
        (("pick_and_place(meal, hobs)",), "<Reading of 1 observation: lunch 1.00>"),
        (("pick_and_place", "eat"), "<Reading of 2 observations: breakfast 0.53, lunch 0.47>"),
        ((PLATE, "cook(meal, hobs)"), "<Reading of 2 observations: no explanation>"),
    ],
)
def test_the_repr_is_one_line_with_the_likeliest_goals(observed, shown):
    assert repr(reading(*observed)) == shown


def test_codes_of_markup_and_emoji_are_printed_as_they_are_and_the_column_is_as_wide_as_it_must_be(tmp_path):
    seen = domain(tmp_path, MARKED).reading()
    seen.observe("fill('a:x:b')")
    told = str(seen).splitlines()
    assert told[0].startswith("fill('a:x:b') ──")
    assert told[2:5] == [
        "  tea('a:x:b')  ██████████ 1.00",
        "  tea('[bold]')            0.00  not this: tea('[bold]') has fill('[bold]'), not fill('a:x:b')",
        "  rest                     0.00  not this: rest has fill(mug), not fill('a:x:b')",
    ]


def test_an_explanation_prints_score_share_and_tree():
    assert str(reading(PLATE).first).splitlines() == [
        "score 0.250, share 1.00",
        "╙── breakfast(biscuits)",
        "    ├─╼ ● pick_and_place(biscuits, plate)",
        "    ├─╼ ○ eat(biscuits, plate)",
        "    └─╼ clean(plate)",
        "        ├─╼ ○ pick_and_place(plate, sink)",
        "        └─╼ ○ wash(plate, sink)",
    ]


def test_the_repr_of_an_explanation_is_one_line():
    assert repr(reading("eat").first) == "<Explanation by breakfast: 1 seen, 1 missed, score 0.188, share 0.69>"


def test_a_needless_observation_is_told_by_its_number_alone_and_by_name_in_its_reading():
    seen = reading("pick_and_place", "sip", "eat", noise=0.1, verification=False)
    assert str(seen.first).splitlines()[-1] == "needless: observation 2"
    assert "needless: sip" in str(seen).splitlines()


def test_several_goals_print_a_tree_each():
    both = reading("pick_and_place", "sip", "eat", goals=2).first
    assert [line for line in str(both).splitlines() if "╙" in line] == ["╙── breakfast(biscuits)", "╙── drink(bottle)"]
    assert repr(both).startswith("<Explanation by breakfast + drink: 3 seen, ")


def test_the_robots_part_prints_what_it_waits_for_and_what_it_will_do():
    plan = reading("pick_and_place(meal, hobs)").plan_for("tiago")
    assert str(plan).splitlines() == [
        "tiago waits for cook(meal, hobs), pick_and_place(meal, plate), eat(meal, plate)",
        "and will then pick_and_place(plate, sink), then wash(plate, sink)",
    ]
    assert repr(plan).startswith("<CollaborativePlan for lunch: tiago waits for cook(meal, hobs), ")
    assert len(repr(plan).splitlines()) == 1


def test_an_agent_whose_turn_it_is_and_one_that_can_do_nothing():
    assert str(reading("eat").plan_for("tiago")) == "tiago's turn: pick_and_place(plate, sink), then wash(plate, sink)"
    assert str(reading("eat").plan_for("nobody")) == "nobody can do nothing of what is left"
