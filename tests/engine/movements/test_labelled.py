"""Labelled recordings to learn movements from: lines and tables, trials and sensors, labels between two steps."""

import json

import pytest

from casper import Domain
from casper.engine.movements.labelled import read_labelled
from casper.engine.movements.watching import Recording, label_between, lasting, samples_of
from casper.engine.perception.world import AgentState, ObjectState, WorldState, world_state_to_json
from casper.kb.errors import DomainError, TraceError, WorldStateError

ROWS = Domain.load("kitchen").kb.rows


def walk(steps=12, dt=0.5, start=-3.0):
    """Who walks to a plate and takes it."""
    for at in range(1, steps + 1):
        x = min(start + 0.4 * at, 0.0)
        held = "plate" if at > steps - 3 else None
        label = "walk" if x < 0 else "pick"
        yield WorldState(at * dt, {"human": AgentState(x, 0.0, 0.0, held)}, {"plate": ObjectState(0.4, 0.0, 0.8)}), label


def lines(**more):
    return [json.dumps({**world_state_to_json(state), "movement": label, **more}) for state, label in walk()]


def table(**more):
    rows = []
    for state, label in walk():
        agent = state.agents["human"]
        cells = {"t": state.t, "name": "human", "x": agent.x, "y": agent.y, "heading": agent.heading}
        rows.append({**cells, "holding": agent.holding or "", "movement": label, **more})
        rows.append({"t": state.t, "name": "plate", "x": 0.4, "y": 0.0, "heading": "", "holding": "", "movement": "", **more})
    return rows


def csv_text(rows):
    return "\n".join([",".join(rows[0]), *(",".join(str(cell) for cell in row.values()) for row in rows)])


def samples(recordings):
    return [(sample.trial, sample.level, sample.features, sample.label) for sample in samples_of(recordings, ROWS, "human")]


def test_lines_are_watched_as_a_mind_watches(tmp_path):
    (tmp_path / "a.jsonl").write_text("\n".join(lines()))
    found = samples(read_labelled([tmp_path / "a.jsonl"], "human"))
    assert len(found) == 11  # the first step has no motion yet
    assert {label for *_, label in found} == {"walk", "pick"}
    assert {seen.mos for *_, seen, label in found if label == "walk"} == {"moving"}


def test_a_table_says_the_same_as_lines(tmp_path):
    (tmp_path / "a.jsonl").write_text("\n".join(lines()))
    (tmp_path / "a.csv").write_text(csv_text(table()))
    of_lines, of_table = (samples(read_labelled([tmp_path / name], "human")) for name in ("a.jsonl", "a.csv"))
    assert of_lines == of_table


def test_a_parquet_file_says_the_same_as_a_table(tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    import pyarrow.parquet as parquet

    cleaned = [{key: (None if value == "" else value) for key, value in row.items()} for row in table()]
    parquet.write_table(pyarrow.Table.from_pylist(cleaned), tmp_path / "a.parquet")
    (tmp_path / "a.csv").write_text(csv_text(table()))
    of_parquet, of_table = (samples(read_labelled([tmp_path / name], "human")) for name in ("a.parquet", "a.csv"))
    assert of_parquet == of_table


def test_files_and_trials_in_them_are_numbered_through_and_sensors_keep_their_names(tmp_path):
    (tmp_path / "a.jsonl").write_text("\n".join(lines(trial="one", level="good") + lines(trial="two", level="good")))
    (tmp_path / "b.csv").write_text(csv_text(table(trial="one", level="poor")))
    found = read_labelled([tmp_path / "a.jsonl", tmp_path / "b.csv"], "human")
    assert [(each.trial, each.level) for each in found] == [(0, "good"), (1, "good"), (2, "poor")]


def test_a_step_has_the_label_of_most_of_its_time():
    labels = [(0.1, "a"), (0.2, "a"), (0.3, "b"), (0.4, "b"), (0.5, "b"), (0.6, None)]
    assert label_between(labels, 0.0, 0.5) == "b" and label_between(labels, 0.0, 0.2) == "a"
    assert label_between(labels, 0.5, 0.6) is None and label_between(labels, None, 0.05) is None
    assert label_between(labels, None, 0.3) == "b"


def test_what_is_told_later_is_compared_with_what_was_done_then():
    states = [state for state, _ in walk(40, 2.0, -20.0)]  # so rarely that it is filtered, and told later
    labels = [(state.t, f"at {state.t:g}") for state in states]
    found = list(samples_of([Recording(0, states, labels)], ROWS, "human"))
    assert found and any(sample.label != f"at {states[-1].t:g}" for sample in found[-1:])


@pytest.mark.parametrize(
    ("name", "text", "kind", "sentence"),
    [
        ("a.jsonl", "{", WorldStateError, "a.jsonl:1: this is not a line of JSON"),
        ("a.jsonl", json.dumps({**json.loads(lines()[0]), "movement": 3}), DomainError, "a.jsonl:1: 3 is no movement"),
        ("a.jsonl", json.dumps(world_state_to_json(next(walk())[0])), DomainError, 'no labels: say what was done under "movement"'),
        ("a.csv", "t,name,x,y,movement\n1,human,0,0,walk\n", TraceError, "human has no heading"),
        ("a.csv", "t,name,x,y,heading,movement\n1,human,zero,0,0,walk\n", TraceError, "a.csv:2 has 'zero' under x"),
        ("a.csv", "t,name,x,y,movement\n1,plate,0,0,walk\n", TraceError, "human is not in the trace"),
        ("a.parquet", "nonsense", TraceError, "cannot be read as Parquet"),
    ],
)
def test_a_mistake_is_told_with_its_place(tmp_path, name, text, kind, sentence):
    (tmp_path / name).write_text(text)
    with pytest.raises(kind) as mistake:
        read_labelled([tmp_path / name], "human")
    assert sentence in str(mistake.value)


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(DomainError, match="cannot be read"):
        read_labelled([tmp_path / "none.jsonl"], "human")


def test_durations_are_of_movements_that_were_seen_to_begin_and_end():
    labels = [(1.0, "still"), (2.0, "walk"), (3.0, "walk"), (4.0, "pick"), (5.0, None), (6.0, "walk"), (7.0, "pick")]
    assert lasting([Recording(0, [], labels), Recording(0, [], labels, "another eye")]) == {"walk": [2.0]}
