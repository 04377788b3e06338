import pytest


def test_needless_actions_are_told_with_their_price(casper):
    told = casper("explain", "kitchen", "pick_and_place", "sip", "eat", "--noise", "0.1", "--no-verification", "--json")
    assert told.json[-1]["best"][0]["needless"] == [2]
    shown = casper("explain", "kitchen", "pick_and_place", "sip", "eat", "--noise", "0.1", "--no-verification")
    assert "needless: sip" in shown.out


def test_several_goals_are_told_as_such(casper):
    told = casper("explain", "kitchen", "pick_and_place", "sip", "eat", "--goals", "2", "--json")
    assert told.json[-1]["best"][0]["goals"] == ["breakfast", "drink"]
    assert told.json[-1]["posterior"]["drink"] == 1.0
    assert "goals" not in casper("explain", "kitchen", "eat", "--json").json[0]["best"][0]


def test_the_best_explanations_are_drawn(casper, tmp_path):
    pytest.importorskip("matplotlib")
    file = tmp_path / "eat.svg"
    told = casper("explain", "kitchen", "eat", "--picture", str(file))
    assert (told.code, file.read_text().startswith("<?xml")) == (0, True)


def test_the_question_that_tells_most_is_asked(casper):
    seen = ("explain", "kitchen", "pick_and_place", "pick_and_place", "wash", "--no-verification", "--questions", "1")
    assert casper(*seen, "--json").json[-1]["questions"][0]["question"] == "is the goal lunch?"
    assert "ask: is the goal lunch? (0.97 bits, yes 0.40)" in casper(*seen).out
    assert "questions" not in casper(*seen[:-2], "--json").json[-1]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--noise", "-1"], "the price of a needless observation is a factor above 0 and at most 1, not -1"),
        (["--goals", "0"], "the number of goals pursued at once is a whole number from 1, not 0"),
        (["--picture", "eat.gif"], "a picture is written as .svg, .png, .pdf"),
    ],
)
def test_a_mistake_is_one_sentence(casper, arguments, sentence):
    told = casper("explain", "kitchen", "eat", *arguments)
    assert told.code == 2
    assert sentence in told.err
