"""Names and places that cannot be are told, once, and the watch goes on."""

import json

from streamed import state, times, warnings, watch

AT = {"x": 0.0, "y": 0.0, "heading": 0.0, "holding": None}


def test_an_object_the_domain_does_not_know_is_told_once():
    events = watch(state(1, spon=(1, 1)), state(2, spon=(1, 1)))
    assert warnings(events) == ["line 1: spon is in view and nothing the domain knows; what is done with it is not valid"]
    assert times(events) == [1, 2]


def test_an_agent_that_is_an_object_too_is_an_agent():
    events = watch(state(1, human=(0, 0)) | {"objects": {"human": {"x": 1, "y": 1}}}, state(2))
    assert warnings(events) == ["line 1: human is an agent and an object at once; the object of that name is left out"]
    assert "human" not in next(e for e in events if e.type == "focus").data["scores"]


def test_a_name_that_is_there_twice_leaves_its_line_out():
    doubled = json.dumps(state(2)).replace('"plate": ', '"plate": {"x": 9, "y": 9}, "plate": ')
    events = watch(state(1), doubled, state(3))
    assert warnings(events) == ['line 2 is left out: "plate" is there twice, and which of both is meant cannot be known']
    assert times(events) == [1, 3]


def test_a_coordinate_that_is_there_twice_leaves_its_line_out():
    (message,) = warnings(watch(json.dumps(state(2)).replace('"x": 3.0', '"x": 3.0, "x": 4.0')))
    assert '"x" is there twice' in message


def test_an_agent_who_is_suddenly_elsewhere_is_told():
    events = watch(state(1), state(1.5, human=(5, 0)), state(2, human=(5, 0)))
    assert warnings(events) == ["line 2: human is suddenly 5.0 m from where it was 0.5 s before"]
    assert times(events) == [1, 1.5, 2]


def test_a_thing_that_nobody_can_have_moved_is_told_when_it_is_seen_there_twice():
    away = [state(t, bottle=(7, 7)) for t in (1, 1.5, 2)]
    assert warnings(watch(*away, state(2.5, bottle=(7, 3)), state(3, bottle=(7, 3)))) == [
        "line 5: bottle is suddenly 4.0 m from where it was, with nobody near"
    ]


def test_one_wrong_detection_of_a_thing_is_no_news():
    assert warnings(watch(state(1, bottle=(7, 7)), state(2, bottle=(7, 3)), state(3, bottle=(7, 7)))) == []


def test_a_thing_that_somebody_near_moves_is_no_news():
    assert warnings(watch(*(state(t, human=(7, 7), bottle=(7, 7 - t)) for t in (0.0, 0.7, 1.4)))) == []


def test_a_thing_that_is_long_unseen_is_told_once_and_again_when_it_went_once_more():
    seen = [state(float(t), bottle=None if 5 < t < 90 or t > 95 else (7, 7)) for t in range(0, 240, 2)]
    told = warnings(watch(*seen))
    assert [w.split(": ")[1] for w in told] == [
        "bottle was not seen since t=4; it is taken to be where it was, at (7.00, 7.00)",
        "bottle was not seen since t=94; it is taken to be where it was, at (7.00, 7.00)",
    ]


def test_an_unknown_type_is_told_and_the_lines_of_recordings_are_passed_over():
    events = watch({"type": "recording", "version": 1}, state(1), {"type": "pointcloud", "t": 2}, state(3))
    assert times(events) == [1, 3]
    assert warnings(events) == [
        "line 3 is left out: its type, 'pointcloud', is unknown; reports have the type \"robot\", world states have none"
    ]


def test_names_without_end_are_not_followed_without_end():
    events = watch(*(state(float(n), **{f"thing_{n}_{k}": (9, 9) for k in range(300)}) for n in range(5)))
    assert sum("are left out" in w for w in warnings(events)) == 1
    assert len([e for e in events if e.type == "focus"][-1].data["scores"]) <= 1000


def test_who_comes_and_goes_is_read_when_there():
    events = watch(state(1), state(2, agents={}), state(9, agents={}), state(10, agents={"human": AT}))
    assert times(events)[0] == 1 and times(events)[-1] == 10
