"""The reader of world states never dies on a bad line: it reports it and goes on."""

import json


def state(t, **changed):
    world = {
        "t": t,
        "agents": {"human": {"x": 0.0, "y": 0.0, "heading": 0.0, "holding": None}},
        "objects": {"plate": {"x": 0.5, "y": 0.0, "z": 0.7}},
    }
    return {**world, **changed}


def watch(casper, *lines):
    text = "\n".join(line if isinstance(line, str) else json.dumps(line) for line in lines)
    return casper("watch", "kitchen", "--json", stdin=text)


def warnings(told):
    return [event["message"] for event in told.json if event["type"] == "warning"]


def test_good_lines_become_focus_and_movement_events_and_a_summary(casper):
    told = watch(casper, state(1), state(2))
    assert [event["type"] for event in told.json] == ["focus", "movement", "focus", "movement", "summary"]
    assert told.json[-1]["predicted"] is None


def test_a_line_that_is_not_json_is_left_out(casper):
    told = watch(casper, state(1), "{oops", state(2))
    assert warnings(told) == [m for m in warnings(told) if m.startswith("line 2 is left out: this is not a line of JSON")]
    assert len(warnings(told)) == 1
    assert told.json[-2]["t"] == 2


def test_time_running_backwards_is_left_out_and_the_watch_goes_on(casper):
    told = watch(casper, state(5), state(4), state(6))
    assert len(warnings(told)) == 1
    assert "4" in warnings(told)[0]
    assert told.json[-2]["t"] == 6


def test_a_nan_coordinate_names_the_object_and_the_time(casper):
    text = json.dumps(state(2)).replace("0.5", "NaN")
    (message,) = warnings(watch(casper, state(1), text, state(3)))
    assert "object plate at t=2" in message


def test_a_missing_coordinate_names_the_key(casper):
    (message,) = warnings(watch(casper, state(1, objects={"plate": {"x": 1.0}})))
    assert 'object plate at t=1 has no number under "y"' in message


def test_an_object_that_vanishes_for_a_while_stays_where_it_was(casper):
    told = watch(casper, state(1), state(2, objects={}), state(3))
    scores = [event["scores"] for event in told.json if event["type"] == "focus"]
    assert all("plate" in known for known in scores)
    assert warnings(told) == []


def test_a_partner_who_is_not_there_yet_is_waited_for(casper):
    told = watch(casper, state(1, agents={}), state(2))
    assert [event["type"] for event in told.json] == ["focus", "movement", "summary"]


def test_needless_actions_and_several_goals_can_be_allowed(casper):
    told = casper("watch", "kitchen", "--noise", "0.1", "--goals", "2", "--stop", "--json", stdin=json.dumps(state(1)))
    assert (told.code, told.json[-1]["type"]) == (0, "summary")


def test_a_price_that_is_none_is_refused_in_a_sentence(casper):
    told = casper("watch", "kitchen", "--noise", "-1", stdin="")
    assert told.code == 2
    assert "the price of a needless observation is a factor above 0 and at most 1, not -1" in told.err


def test_a_file_is_watched_as_standard_input_is(casper, tmp_path):
    text = "\n".join(json.dumps(state(t)) for t in (1, 1.5, 2))
    (tmp_path / "seen.jsonl").write_text(text)
    assert casper("watch", "kitchen", str(tmp_path / "seen.jsonl"), "--json").json == casper("watch", "kitchen", "--json", stdin=text).json


def test_a_late_state_is_put_in_its_place_where_a_window_is_given(casper):
    lines = "\n".join(json.dumps(state(t)) for t in (1, 2, 1.5, 2.5))
    told = casper("watch", "kitchen", "--window", "1", "--json", stdin=lines)
    assert [event["t"] for event in told.json if event["type"] == "focus"] == [1, 1.5, 2, 2.5]


def test_a_window_that_is_none_is_refused(casper):
    told = casper("watch", "kitchen", "--window", "-1", stdin="")
    assert (told.code, "the window is a finite number of seconds" in told.err) == (2, True)


def test_a_file_that_is_not_there_is_refused(casper):
    told = casper("watch", "kitchen", "nowhere.jsonl")
    assert (told.code, told.err) == (2, "casper: cannot read nowhere.jsonl (No such file or directory)\n")
