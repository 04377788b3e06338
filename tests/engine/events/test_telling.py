"""What the robot announces, in the words of the domain."""

import pickle

import pytest

from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.events.entries import Names
from casper.engine.events.phrases import PHRASES
from casper.engine.events.timeline import Timeline
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError, ProgramError
from casper.kb.reasons.phrases import PHRASES as OF_THE_BASE
from casper.kb.text.lines import text_of


@pytest.fixture(scope="module")
def french():
    return Domain.load("kitchen", "fr")


@pytest.fixture(scope="module")
def names(french):
    return Names(french.partner, french.robot, french.kb.words)


def shown(event, names):
    return "\n".join("".join(span.text for span in spans) for spans in event.lines(names))


def test_an_announcement_is_told_in_words(names):
    data = {"agent": "tiago", "goal": "lunch", "waiting": ["eat(meal, plate)"], "actions": ["wash(plate, sink)"]}
    told = shown(Event("plan", 3.0, data), names)
    assert "Tiago attend ceci : la personne mange le repas dans l'assiette" in told
    assert "et ensuite : Tiago lave l'assiette dans l'évier" in told


def test_a_refused_statement_says_that_it_cannot_be(names):
    data = {"statement": "eat(tiago, meal, plate)", "valid": False, "completed": "", "reasons": ["…"]}
    assert "✘ Tiago ne peut pas manger le repas dans l'assiette" in shown(Event("verdict", 3.0, data), names)


def test_what_is_given_up_is_told_in_words(french, names):
    data = {"agent": "tiago", "goal": "lunch", "because": "…"}
    assert "✗ Tiago retire sa part de ce but : le déjeuner" in shown(Event("withdrawn", 3.0, data), names)


def test_what_the_robot_stopped_is_a_line_like_any_other():
    assert "○ tiago stopped wash(plate, sink)" in shown(
        Event("robot", 3.0, {"action": "wash(plate, sink)", "status": "stopped"}), Names("human", "tiago")
    )


def test_questions_are_asked_in_words_and_their_subject_stays_a_term(french):
    reading = french.reading()
    reading.observe("pick_and_place(meal, hobs)")
    told = {question.about: str(question) for question in reading.questions()}
    assert told["lunch"] == "le but est-il celui-ci : le déjeuner ?"
    assert told["cook(meal, hobs)"].endswith("cuire le repas sur la cuisinière ?")
    again = pickle.loads(pickle.dumps(reading))
    assert [str(q) for q in again.questions()] == [str(q) for q in reading.questions()]


def test_why_a_goal_is_out_is_told_in_words(french):
    reading = french.reading()
    reading.observe("pick_and_place(meal, hobs)")
    assert "Food de « le petit-déjeuner » : les biscuits, pas le repas" in reading.rejected["breakfast"]
    reading.observe("sip")
    assert reading.rejected["lunch"] == ("« le déjeuner » n'a pas d'étape sip",)


def test_what_is_yet_to_come_names_nobody_who_may_not_do_it(french):
    reading = french.reading()
    reading.observe("pick_and_place(meal, hobs)")
    assert "reste à faire : cuire le repas sur la cuisinière, " in str(reading)


def test_without_a_language_the_kitchen_tells_terms():
    assert not Domain.load("kitchen").kb.words


def test_a_language_in_which_nothing_is_said_is_refused():
    with pytest.raises(DomainError, match=r"nothing of kitchen is said in 'xx'; there are en, fr"):
        Domain.load("kitchen", "xx")


def test_a_sentence_that_cannot_be_told_is_refused_with_its_place():
    with pytest.raises(ProgramError, match=r"ontology.pl:1:14: the sentence has \{Y\}"):
        Domain.from_text(ontology='person(ann). say(person(X), "{Y}").')


@pytest.mark.parametrize("table", [PHRASES, OF_THE_BASE])
def test_every_language_has_every_phrase_with_the_same_values(table):
    for phrases in table.values():
        assert phrases.keys() == table["en"].keys()
        for name, phrase in phrases.items():
            used = [n for n in "0123" if f"{{{n}}}" in phrase]
            assert used == [n for n in "0123" if f"{{{n}}}" in table["en"][name]] or name.startswith(
                ("robot", "nobody")
            )


def test_steps_that_are_waited_for_are_those_of_the_partner_whose_plan_it_is():
    kb = KnowledgeBase.from_text('human(ann). human(ben). say(eat(A, T), "{A} eats {T}"). eat(A, cake) :- human(A).')
    timeline = Timeline("ann", "tim", kb.words)
    plan = {"agent": "tim", "partner": "ben", "waiting": ["eat(cake)"], "actions": ["eat(cake)"]}
    told = text_of(timeline.lines(Event("plan", 15.0, plan)))
    assert "ben eats cake" in told and "ann" not in told
