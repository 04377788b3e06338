"""What a mistake in a domain's text looks like: file, line, what is wrong, what to do."""

import pytest

ONTOLOGY = "human(ann).\nwave(A) :- human(A).\n"
PLANS = "goal(greet).\ngreet --> wave.\n"


def domain(folder, **files):
    for name, text in files.items():
        (folder / f"{name}.pl").write_text(text)
    return str(folder)


def test_a_folder_of_two_small_files_is_a_domain(casper, tmp_path):
    told = casper("explain", domain(tmp_path, ontology=ONTOLOGY, plans=PLANS), "wave", "--json")
    assert told.json[0]["outcome"] == "greet"


def test_without_an_ontology_a_domain_only_explains(casper, tmp_path):
    folder = domain(tmp_path, plans="goal(tea(C)) :- cup(C).\ntea(C) --> boil, pour(C).\n")
    assert casper("explain", folder, "boil", "pour(mug)", "--json").json[-1]["outcome"] == "tea"
    assert "verifies nothing" in casper("verify", folder, "boil(ann)").err


def test_actions_of_any_arity_are_observed_by_name_or_in_full(casper, tmp_path):
    folder = domain(tmp_path, plans="tea --> boil, pour(milk, cup, slowly).\n")
    assert casper("explain", folder, "boil", "pour(milk, cup, slowly)", "--json").json[-1]["outcome"] == "tea"
    assert casper("explain", folder, "boil", "pour(milk, pot, slowly)", "--json").json[-1]["explanations"] == 0


@pytest.mark.parametrize(
    ("files", "sentence"),
    [
        ({"ontology": "human(ann)"}, "ontology.pl:1:11: the text ends here"),
        ({"ontology": "human(ann).\nwave(A) :- humn(A).\n"}, "ontology.pl:2:12: nothing defines humn/1; did you mean human?"),
        ({"ontology": ONTOLOGY, "plans": "goal(greet).\ngreet --> wavee.\n"}, "plans.pl:2"),
        ({"ontology": ONTOLOGY, "plans": "goal(greet).\ngreet --> wavee.\n"}, "did you mean wave?"),
        ({"ontology": ONTOLOGY, "plans": "goal(greet).\n"}, "plans.pl:1:1: the goal greet has no production"),
        ({"ontology": ONTOLOGY, "plans": "goal(g).\ng --> h.\nh --> g.\n"}, "the task g can only go on for ever (g needs h needs g)"),
        ({"ontology": "p(X) :- q(Y), X is Y + foo.\nq(1).\n"}, "nothing computes foo/0"),
        ({"ontology": "never(\"x\").\n"}, "always broken"),
    ],
)
def test_a_mistake_is_told_with_its_place(casper, tmp_path, files, sentence):
    told = casper("query", domain(tmp_path, **files), "human(X)")
    assert told.code == 2
    assert sentence in told.err
    assert "Traceback" not in told.err


def test_an_empty_folder_is_no_domain(casper, tmp_path):
    assert "holds no domain" in casper("query", str(tmp_path), "human(X)").err


def test_a_domain_without_perception_cannot_be_watched_and_says_what_is_missing(casper, tmp_path):
    told = casper("watch", domain(tmp_path, ontology=ONTOLOGY, plans=PLANS))
    assert told.code == 2
    assert "movement" in told.err or "transition" in told.err


def test_a_goal_nobody_knows_is_refused(casper):
    pytest.importorskip("mujoco")
    told = casper("run", "kitchen", "--goal", "supper")
    assert told.code == 2
    assert "choose breakfast, drink, lunch" in told.err
