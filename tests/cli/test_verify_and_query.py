import pytest


def test_a_valid_statement_comes_with_its_proof_and_exit_code_0(casper):
    told = casper("verify", "kitchen", "eat(human, biscuits, plate)", "--json")
    assert told.code == 0
    (answer,) = told.json
    assert answer["valid"] is True
    assert answer["proof"]["fact"] == "eat(human, biscuits, plate)"
    assert answer["proof"]["place"].startswith("ontology.pl:")
    assert answer["proof"]["because"][0]["fact"] == "human(human)"
    assert set(answer) >= {"statement", "valid", "proof", "reasons", "repair"}


def test_the_failed_condition_is_named_and_the_exit_code_is_1(casper):
    told = casper("verify", "kitchen", "eat(tiago, meal, plate)", "--json")
    assert told.code == 1
    assert told.json[0]["reasons"] == ["tiago is not a human"]


def test_a_broken_constraint_is_told_in_its_own_sentence(casper):
    told = casper("verify", "kitchen", "pick_and_place(human, biscuits, hobs)", "--json")
    assert told.json[0]["reasons"] == ["the biscuits go on the plate only"]


def test_one_invalid_statement_among_valid_ones_gives_exit_code_1(casper):
    assert casper("verify", "kitchen", "wash(tiago, plate, sink)", "sip(tiago, glass, bottle)").code == 1


def test_an_unknown_part_is_filled_in_where_only_one_value_will_do(casper):
    told = casper("verify", "kitchen", "wash(human, plate, _)", "--json")
    assert told.json[0]["completed"] == "wash(human, plate, sink)"


def test_an_action_the_ontology_does_not_know_is_invalid(casper):
    told = casper("verify", "kitchen", "fly(human)", "--json")
    assert (told.code, told.json[0]["valid"]) == (1, False)
    assert told.json[0]["reasons"] == ["there is no action fly/1 here"]


def test_a_repair_is_offered_that_makes_it_valid(casper):
    told = casper("verify", "kitchen", "eat(human, bottle, plate)", "--json")
    assert told.json[0]["repair"] == [{"add": ["eatable(bottle)"], "remove": []}]


def test_a_person_sees_the_proof_tree(casper):
    told = casper("verify", "kitchen", "wash(tiago, plate, sink)")
    assert "└─ tiago(tiago)   [given]" in told.out


def test_query_answers_with_every_part_free(casper):
    told = casper("query", "kitchen", "eat(A, T, D)", "--json")
    assert told.json == [
        {"A": "human", "T": "biscuits", "D": "plate"},
        {"A": "human", "T": "meal", "D": "plate"},
    ]


def test_query_lists_every_valid_statement(casper):
    told = casper("query", "kitchen", "valid(S)", "--json")
    statements = {line["S"] for line in told.json}
    assert "wash(tiago, glass, sink)" in statements
    assert "pick_and_place(human, biscuits, sink)" not in statements
    assert all(casper("verify", "kitchen", s).code == 0 for s in sorted(statements)[:3])


def test_plans_are_relations_too(casper):
    told = casper("query", "kitchen", "uses(G, plate)", "--json")
    assert {line["G"] for line in told.json} == {"breakfast(biscuits)", "lunch(meal)"}


def test_limit_bounds_the_answers(casper):
    assert len(casper("query", "kitchen", "valid(S)", "--limit", "4", "--json").json) == 4


@pytest.mark.parametrize(("goal", "answer"), [("human(human)", "yes"), ("human(tiago)", "no")])
def test_a_closed_question_is_answered_yes_or_no(casper, goal, answer):
    assert casper("query", "kitchen", goal).out.strip() == answer


@pytest.mark.parametrize(
    ("goal", "sentence"),
    [("foo(X)", "did you mean food?"), ("eat(X)", "eat takes 3 arguments, not 1"), ("eat(A T)", "does not belong here")],
)
def test_a_mistake_in_a_query_is_one_sentence_and_exit_code_2(casper, goal, sentence):
    told = casper("query", "kitchen", goal)
    assert told.code == 2
    assert sentence in told.err
