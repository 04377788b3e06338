"""Verification: provable, and no constraint broken when it is claimed; repairs."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import Undefined
from casper.kb.reasons.validity import valid_instances
from casper.kb.terms.terms import Compound, Variable

HOME = """
human(ann). robot(tia). food(egg). food(bread). plate(plate). vessel(plate). vessel(mug). sink(sink).
move(A, T, D) :- agent(A), item(T), vessel(D), T \\= D.
agent(X) :- human(X).
agent(X) :- robot(X).
item(X) :- food(X).
item(X) :- vessel(X).
eat(A, F, D) :- human(A), food(F), plate(D).
wash(A, V, D) :- agent(A), vessel(V), sink(D).
rest(_).
say(A, _) :- human(A).
never("bread goes on the plate only") :- claim(move(_, bread, D)), \\+ plate(D).
never("nobody eats twice the same") :- claim(eat(A, F, _)), did(eat(A, F, _), _).
never("wait ten seconds before washing") :- claim(wash(_, _, _)), did(eat(_, _, _), T), T > 10.
never("nobody says a secret") :- claim(say(_, W)), secret(W).
never("nobody shouts") :- claim(say(_, W)), W = shout(_).
never("say no numbers over nine") :- claim(say(_, W)), W > 9.
secret(7).
"""


def home(more=""):
    return KnowledgeBase.from_text(HOME + more)


def verdict(statement, history=(), more=""):
    return home(more).verify(statement, history)


def test_a_provable_statement_that_breaks_nothing_is_valid():
    assert verdict("move(ann, egg, mug)").valid is True


def test_a_statement_that_is_not_provable_is_invalid_with_its_reason():
    found = verdict("eat(tia, egg, plate)")
    assert found.valid is False
    assert found.reasons == ("tia is not a human",)


def test_a_claim_that_breaks_a_constraint_is_invalid_with_the_constraints_sentence():
    found = verdict("move(tia, bread, mug)")
    assert found.valid is False
    assert found.reasons == ("bread goes on the plate only",)


def test_a_broken_constraint_shows_the_conditions_that_clash():
    (violation,) = verdict("move(tia, bread, mug)").refusal.violations
    assert [str(x.atom) for x in violation.clash] == ["claim(move(tia, bread, mug))", "plate(mug)"]


def test_an_unprovable_statement_may_break_a_constraint_as_well():
    found = verdict("move(egg, bread, mug)")
    assert found.reasons == ("egg is not an agent", "bread goes on the plate only")


EATEN = Compound(("eat", "ann", "egg", "plate"))


@pytest.mark.parametrize("earlier", ["eat(ann, egg, plate)", EATEN, tuple(EATEN)], ids=["text", "term", "tuple"])
def test_what_happened_earlier_can_break_a_constraint(earlier):
    assert verdict("eat(ann, egg, plate)", [(earlier, 3.0)]).reasons == ("nobody eats twice the same",)


def test_what_happened_earlier_to_others_does_not():
    assert verdict("eat(ann, bread, plate)", [(EATEN, 3.0)]).valid is True


@pytest.mark.parametrize(("seconds", "valid"), [(3.0, True), (12.0, False)])
def test_the_time_of_what_happened_is_known(seconds, valid):
    assert verdict("wash(tia, mug, sink)", [(EATEN, seconds)]).valid is valid


def test_a_rule_may_ask_what_happened_earlier():
    rule = "serve(F) :- did(cook(F), _)."
    assert verdict("serve(egg)", [("cook(egg)", 1.0)], rule).valid is True
    assert verdict("serve(egg)", [("cook(bread)", 1.0)], rule).valid is False
    assert verdict("serve(egg)", (), rule).reasons == ("did(cook(egg), _) does not hold",)


def test_a_part_with_one_valid_value_is_filled_in():
    assert str(verdict("wash(tia, mug, D)").completed) == "wash(tia, mug, sink)"


def test_a_part_with_several_valid_values_stays_open():
    assert str(verdict("wash(tia, V, _)").completed) == "wash(tia, V, sink)"


def test_a_constraint_narrows_what_can_be_filled_in():
    assert str(verdict("move(ann, bread, D)").completed) == "move(ann, bread, plate)"


def test_no_value_that_does_is_invalid():
    assert verdict("eat(tia, F, D)").valid is False


def test_a_part_that_may_be_anything_is_not_broken_by_a_constraint_on_some_value():
    found = verdict("say(ann, W)")
    assert found.valid is True
    assert str(found.completed) == "say(ann, W)"


def test_a_part_that_may_be_anything_is_not_broken_because_nothing_is_known_of_it():
    rules = "human(ann). say(X, W) :- human(X), odd(W, _). odd(_, _). allowed(hi). shown(x)."
    constraint = 'never("only what is allowed") :- claim(say(_, W)), \\+ allowed(W).'
    base = KnowledgeBase.from_text(f'{rules} {constraint} never("done") :- claim(S), \\+ did(S, _), S = say(_, bye).')
    assert base.verify("say(ann, W)").valid is True
    assert [base.verify(f"say(ann, {w})").valid for w in ("hi", "ho", "bye")] == [True, False, False]


def test_the_value_that_breaks_it_is_invalid():
    assert verdict("say(ann, 7)").reasons == ("nobody says a secret",)
    assert verdict("say(ann, shout(hey))").reasons == ("nobody shouts",)
    assert verdict("say(ann, 12)").reasons == ("say no numbers over nine",)


def test_an_undefined_predicate_is_invalid_with_a_reason():
    found = verdict("jump(ann)")
    assert found.valid is False
    assert found.reasons == ("there is no action jump/1 here",)


def test_the_wrong_number_of_parts_is_invalid_with_a_reason():
    assert verdict("eat(ann, egg)").reasons == ("eat takes 3 arguments, not 2",)


def test_a_constraint_that_the_facts_break_spoils_every_statement():
    found = verdict("eat(ann, egg, plate)", (), 'never("no mugs") :- vessel(mug).')
    assert found.valid is False
    assert found.reasons == ("no mugs",)


def test_a_statement_without_parts_is_one_too():
    assert verdict("nap", (), 'nap. never("no naps after food") :- claim(nap), did(eat(_, _, _), _).').valid is True
    assert verdict("nap", [(EATEN, 1.0)], 'nap. never("no naps") :- claim(nap), did(eat(_, _, _), _).').valid is False


def test_a_search_without_end_is_unknown():
    found = verdict("loop(a)", (), "loop(X) :- loop(s(X)), Open = Open. loop(_) :- loop(_).")
    assert found.valid is None
    assert "the answer is unknown" in found.reasons[0]


def test_a_statement_known_to_be_valid_for_some_value_is_not_unknown():
    found = verdict("n(Y, X)", (), "n(a, z). n(a, s(X)) :- n(a, X).")
    assert found.valid is True


def test_a_constraint_that_asks_for_validity_without_end_is_unknown_too():
    assert verdict("nap", (), 'nap. never("hm") :- claim(C), \\+ valid(C).').valid is None


def test_a_constraint_may_rest_on_another():
    base = KnowledgeBase.from_text('p(a). never("x") :- p(a). never("y") :- never("x"). bad(S) :- never(S).')
    assert base.verify("p(a)").reasons == ("x", "y")
    assert list(base.query("bad(S)")) == [{"S": "x"}]


def test_a_verdict_follows_the_facts():
    kb = KnowledgeBase.from_text(HOME)
    asked = ("eat", "eve", "egg", "plate")
    assert kb.verify(asked).valid is False
    kb.assert_("human(eve)")
    assert kb.verify(asked).valid is True and kb.verify(asked) == kb.verify("eat(eve, egg, plate)")
    kb.assert_("robot(eve)")
    kb.retract("human(eve)")
    assert kb.verify(asked).reasons == KnowledgeBase.from_text(HOME + "robot(eve).").verify(asked).reasons


def test_a_verdict_on_the_facts_is_not_one_after_something_happened():
    kb = KnowledgeBase.from_text(HOME)
    asked, done = "eat(ann, egg, plate)", [(Compound(("eat", "ann", "egg", "plate")), 1.0)]
    assert [kb.verify(asked).valid, kb.verify(asked, done).valid, kb.verify(asked).valid] == [True, False, True]


def test_a_number_is_judged_as_it_was_written():
    kb = KnowledgeBase.from_text(HOME)
    assert [str(kb.verify(("say", "ann", n)).statement) for n in (8, 8.0)] == ["say(ann, 8)", "say(ann, 8.0)"]


def test_valid_lists_every_valid_statement():
    base = home()
    base.declare_statements([("eat", 3), ("wash", 3)])
    listed = {str(answer["S"]) for answer in base.query("valid(S)")}
    assert listed == {f"eat(ann, {f}, plate)" for f in ("egg", "bread")} | {
        f"wash({a}, {v}, sink)" for a in ("ann", "tia") for v in ("plate", "mug")
    }


def test_a_refusal_of_validity_is_the_refusal_of_the_statement():
    assert home().why_not("valid(move(tia, bread, mug))").reasons == ("bread goes on the plate only",)


@pytest.mark.parametrize(
    ("statement", "repairs"),
    [
        ("eat(ann, mug, plate)", ["add food(mug)"]),
        ("human(bob)", ["add human(bob)"]),
        ("wash(bob, mug, sink)", ["add human(bob)", "add robot(bob)"]),
        ("move(ann, bread, mug)", ["add plate(mug)"]),
        ("move(bob, bread, mug)", ["add human(bob) and add plate(mug)", "add plate(mug) and add robot(bob)"]),
        ("say(ann, 7)", ["remove secret(7)"]),
        ("eat(ann, egg, plate)", []),
        ("move(ann, mug, mug)", []),
        ("jump(ann)", []),
    ],
)
def test_a_repair_is_the_smallest_change_of_facts(statement, repairs):
    assert [str(repair) for repair in home().repair(statement)] == repairs


def test_a_repair_takes_away_what_a_derived_obstacle_rests_on():
    base = KnowledgeBase.from_text("cracked(mug). broken(X) :- cracked(X). mug(mug). use(X) :- mug(X), \\+ broken(X).")
    assert [str(repair) for repair in base.repair("use(mug)")] == ["remove cracked(mug)"]


def test_a_repair_breaks_no_constraint_that_held():
    base = KnowledgeBase.from_text('robot(tia). :- dynamic(human/1). eat(A) :- human(A). never("both") :- human(X), robot(X).')
    (repair,) = base.repair("eat(tia)")
    assert repair.to_json() == {"add": ["human(tia)"], "remove": ["robot(tia)"]}
    assert [str(repair) for repair in base.repair("eat(ann)")] == ["add human(ann)"]


def test_a_repair_leaves_the_knowledge_base_as_it_is():
    base = home()
    before = base.to_text()
    base.repair("eat(ann, mug, plate)")
    assert base.to_text() == before


def test_a_constraint_that_cannot_be_evaluated_leaves_the_verdict_open_with_its_reason():
    found = verdict("say(ann, x)")
    reason = 'whether this is broken is undefined: "say no numbers over nine" (x is not a number)'
    assert (found.valid, found.reasons) == (None, (reason,))
    assert home().why_not("say(ann, x)").reasons == (reason,)
    assert home().truth("valid(say(ann, x))") == "undefined"


def test_a_constraint_that_is_broken_for_certain_outweighs_one_that_may_be():
    base = KnowledgeBase.from_text('p(x). never("no numbers") :- claim(p(X)), X > 9. never("no x") :- claim(p(x)).')
    assert (base.verify("p(x)").valid, base.verify("p(x)").reasons) == (False, ("no x",))


def test_facts_that_may_break_a_constraint_leave_every_verdict_open():
    base = KnowledgeBase.from_text('never("too many") :- size(X), X > 9. size(x). p(a).')
    assert base.verify("p(a)").valid is None
    assert base.truth("never(S)") == "undefined"
    assert base.verify("p(b)").valid is False


def test_a_constraint_that_may_be_broken_and_is_broken_otherwise_is_broken():
    base = KnowledgeBase.from_text('never("much") :- size(X), X > 9. never("much") :- size(y). size(x). size(y).')
    assert [str(answer) for answer in base.instances("never(S)")] == ["never(much)"]


def test_what_is_valid_besides_something_undefined_is_told_first():
    text = 'p(X) :- n(X). q(X) :- n(X). n(a). n(1). never("big") :- claim(p(X)), X > 9. never("big") :- claim(q(X)), X > 9.'
    base, found = KnowledgeBase.from_text(text), []
    with pytest.raises(Undefined):
        found.extend(str(answer) for answer in base.instances("valid(S)"))
    assert {"valid(p(1))", "valid(q(1))"} <= set(found) and "valid(p(a))" not in found
    assert base.truth("valid(p(a))") == "undefined" and base.truth("valid(7)") == "false"


def test_what_is_valid_is_told_again_when_it_is_asked_again():
    base = KnowledgeBase.from_text('p(X) :- n(X). n(1). n(2). n(30). never("big") :- claim(p(X)), X > 9.')
    answers = [[str(answer) for answer in base.instances("valid(p(X))")] for _ in range(3)]
    assert answers == [["valid(p(1))", "valid(p(2))"]] * 3


def test_a_clash_leaves_open_what_a_negation_leaves_open():
    base = KnowledgeBase.from_text('never("no witness") :- claim(p(X)), \\+ saw(X, _). :- dynamic(saw/2). p(a).')
    [violation] = base.why_not("p(a)").violations
    assert str(violation.clash[1].atom) == "saw(a, _)"


def test_what_is_valid_in_several_ways_is_listed_once():
    base = KnowledgeBase.from_text(
        'q(a). r(a). q(b). p(X, _) :- q(X). p(X, _) :- r(X). never("no b") :- claim(p(b, _)).'
    )
    base.declare_statements([("p", 2)])
    assert [str(x) for x in valid_instances(Compound(("p", Variable("X"), 1)), base.solver(), base._model.constraints)] == ["p(a, 1)"]


RATIO = 'n(0). n(1). n(2). p(1). p(5). w(X) :- p(X). never("too much") :- claim(w(X)), n(Y), Z is X / Y, Z > 2. '


def test_a_constraint_that_is_broken_and_has_no_value_elsewhere_is_told_once():
    assert KnowledgeBase.from_text(RATIO).verify("w(5)").reasons == ("too much",)
    with pytest.raises(Undefined):
        KnowledgeBase.from_text(RATIO).ask("valid(w(1))")
    assert KnowledgeBase.from_text(RATIO.replace("n(0). ", "")).ask("valid(w(1))")
