"""The methods of a served domain: what each gives, and that it is what the schema says."""

import json
import subprocess
import sys
from itertools import count

import jsonschema
import pytest

from casper.engine.domain.domain import Domain
from casper.server.methods import METHODS
from casper.server.protocol import Message, Request
from casper.server.schema import document
from casper.server.serving import Server

METHODS_OF = {method["name"]: method for method in document()["methods"]}


class Client:
    """Asks a server of its own, and holds every parameter and result against the schema."""

    def __init__(self, domain: str = "kitchen") -> None:
        self.server, self.ids = Server(Domain.load(domain)), count()

    def __call__(self, method: str, **params):
        known = {parameter["name"]: parameter["schema"] for parameter in METHODS_OF[method]["params"]}
        for name, value in params.items():
            jsonschema.validate(value, known[name])
        (answer,) = self.server.answers(Message((Request(next(self.ids), method, params),)))
        assert "error" not in answer, answer["error"]["message"]
        answer = json.loads(json.dumps(answer))
        jsonschema.validate(answer["result"], METHODS_OF[method]["result"]["schema"])
        return answer["result"]


@pytest.fixture
def client() -> Client:
    return Client()


def test_questions_have_the_answers_of_the_knowledge_base(client: Client) -> None:
    kb = Domain.load("kitchen").kb
    assert client("ask", statement="wash(tiago, plate, sink)") is True
    assert client("truth", statement="eat(tiago, meal, plate)") == "false"
    assert client("why_not", statement="eat(tiago, meal, plate)") == ["tiago is not a human"]
    assert client("why_not", statement="eat(human, meal, plate)") is None
    assert client("why", statement="eat(tiago, meal, plate)") is None
    assert client("why", statement="agent(tiago)")["text"] == str(kb.why("agent(tiago)"))
    assert client("repair", statement="eat(tiago, meal, plate)", limit=1)[0]["add"] == ["human(tiago)"]


def test_a_query_gives_as_many_answers_as_are_wanted_and_says_whether_there_are_more(client: Client) -> None:
    everything = client("query", goal="valid(S)")
    assert everything["more"] is False
    first = client("query", goal="valid(S)", limit=2)
    assert first == {"answers": everything["answers"][:2], "more": True}
    assert client("query", goal="valid(S)", limit=len(everything["answers"]))["more"] is False


def test_values_are_numbers_text_and_null(client: Client) -> None:
    assert client("query", goal="X = 2.5, Y = f(a), Z = \"it's\", W = V")["answers"] == [
        {"X": 2.5, "Y": "f(a)", "Z": "it's", "W": None, "V": None}
    ]


def test_verify_gives_what_the_command_prints(client: Client) -> None:
    for statement in ("eat(human, meal, plate)", "eat(tiago, meal, plate)"):
        command = [sys.executable, "-m", "casper", "verify", "kitchen", statement, "--json"]
        printed = subprocess.run(command, capture_output=True, text=True).stdout
        told = json.loads(printed)
        assert client("verify", statement=statement, proof=True) == told
        assert client("verify", statement=statement) == {**told, "proof": None}


def test_facts_come_and_go(client: Client) -> None:
    assert client("assert", fact="human(eve)") and not client("assert", fact="human(eve)")
    assert client("ask", statement="agent(eve)")
    assert client("retract", fact="human(eve)") and not client("retract", fact="human(eve)")
    assert not client("ask", statement="agent(eve)")


def test_what_was_asked_before_is_answered_anew_when_a_fact_has_changed(client: Client) -> None:
    asked = {"statement": "eat(eve, meal, plate)"}
    before = {method: client(method, **asked) for method in ("ask", "truth", "verify", "why", "why_not", "repair")}
    client("assert", fact="human(eve)")
    now = {method: client(method, **asked) for method in before}
    assert (before["truth"], now["truth"]) == ("false", "true")
    assert all(now[method] != before[method] for method in before)
    client("retract", fact="human(eve)")
    assert {method: client(method, **asked) for method in before} == before


def test_a_reading_is_what_it_is_in_python(client: Client) -> None:
    reading = Domain.load("kitchen").reading()
    for action in ("pick_and_place(meal, hobs)", "cook(meal, hobs)"):
        reading.observe(action)
        told = client("observe", action=action)
        assert told["explanations"] == reading.count and told["posterior"] == dict(reading.posterior)
    assert client("frontier") == ["pick_and_place(meal, plate)", "eat(meal, plate)", "pick_and_place(plate, sink)", "wash(plate, sink)"]
    assert client("plan_for") == reading.plan_for("tiago").to_json() == client("plan_for", agent="tiago")
    assert client("explain", top=1) == json.loads(json.dumps(reading.to_json(1)))
    assert client("undo") == 1 and client("posterior") == dict(reading.posterior)


def test_before_anything_is_seen_nobody_has_a_plan(client: Client) -> None:
    assert client("plan_for") is None and client("frontier") == []


def test_readings_by_name_go_their_own_ways(client: Client) -> None:
    assert client("open", reading="ann", verification=False) == "ann"
    client("observe", reading="ann", action="eat")
    assert client("fork", reading="ann", into="what if") == "what if"
    client("observe", reading="what if", action="wash")
    assert client("posterior", reading="ann") != client("posterior", reading="what if")
    assert client("observe", action="sip")["observations"] == 1  # the partner's own
    assert client("close", reading="ann") and not client("close", reading="ann")


def test_an_action_may_be_uncertain(client: Client) -> None:
    client("open", verification=False)
    told = client("observe", action={"eat": 0.7, "sip": 0.2})
    assert told["explanations"] == 3 and told["outcome"] is None


def test_check_finds_nothing_wrong_with_the_kitchen_but_notes(client: Client) -> None:
    assert all(finding["severity"] != "error" for finding in client("check"))


def test_the_schema_names_every_method_and_is_what_the_command_prints() -> None:
    assert set(METHODS_OF) == {*METHODS, "cancel"}
    printed = subprocess.run([sys.executable, "-m", "casper", "serve", "--schema"], capture_output=True, text=True)
    assert json.loads(printed.stdout) == document()
    for method in METHODS_OF.values():
        assert method["summary"]
        for schema in (method["result"]["schema"], *(parameter["schema"] for parameter in method["params"])):
            jsonschema.Draft202012Validator.check_schema(schema)
