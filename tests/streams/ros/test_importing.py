"""Recordings of ROS 2 become world states; whatever of them cannot be used is a finding."""

import json
import math

import pytest

pytest.importorskip("mcap_ros2")

from hypothesis import given
from hypothesis import strategies as st
from mcaps import Bag, detection, transform

from casper.engine.perception.filters.association import Associator
from casper.engine.perception.tracking import Tracker, TrackerSettings
from casper.engine.perception.world import world_state_from_json
from casper.kb.checks.finding import Severity
from casper.kb.errors import CasperError, DomainError, ReadError
from casper.streams.ros.frames import Frames, Pose, pose_from
from casper.streams.ros.importing import Recordings
from casper.streams.ros.names import Names, read_names

T = 1_700_000_000.0
NAMES = Names(
    agents={"person_1": "human", "base": "tiago"},
    objects={"cup": "glass", "plate_link": "plate"},
    hands={"right_hand": "human"},
    is_complete=True,
)
QUARTER = {"x": 0.0, "y": 0.0, "z": math.sin(math.pi / 4), "w": math.cos(math.pi / 4)}


def kitchen(path, seconds=4.0, walks=0.5, **options):
    """A person walks along x, a robot with a camera stands at (0, 2) turned to the left and sees a cup 1 m ahead."""
    bag = Bag(path, **options)
    bag.tf(T, transform(T, "base", "camera", (0.0, 0.0, 1.0)), topic="/tf_static")
    for step in range(int(seconds * 20) + 1):
        t = T + step / 20
        bag.tf(
            t,
            transform(t, "map", "base", (0.0, 2.0, 0.0), QUARTER),
            transform(t, "map", "person_1", (walks * step / 20, 0.0, 0.0), QUARTER),
            transform(t, "map", "plate_link", (3.0, 0.0, 0.8)),
        )
        if step % 4 == 0:
            bag.seen(t, "camera", detection(t, "camera", "cup", (1.0, 0.0, -0.2)), detection(t, "camera", "shoe", (2, 0, 0)))
            bag.text(t, "hello")
    return bag.close()


def convert(file, names=NAMES, period=0.1):
    """The world states, and the findings' severities and messages."""
    findings = Recordings([file], names, period).write(file.parent / "out")
    lines = (file.parent / "out" / f"{file.stem}.jsonl").read_text().splitlines()
    return [world_state_from_json(json.loads(line)) for line in lines], [(f.severity, f.message) for f in findings]


def said(findings, severity):
    return [message for kind, message in findings if kind is severity]


def test_frames_and_detections_become_world_states(tmp_path):
    worlds, findings = convert(kitchen(tmp_path / "a.mcap"))
    assert [world.t for world in worlds] == pytest.approx([0.1 * n for n in range(41)])
    last = worlds[-1]
    assert set(last.agents) == {"human", "tiago"} and set(last.objects) == {"glass", "plate"}
    assert (last.agents["human"].x, last.agents["human"].heading) == pytest.approx((2.0, math.pi / 2))
    glass = last.objects["glass"]
    assert (glass.x, glass.y, glass.z) == pytest.approx((0.0, 3.0, 0.8))
    assert said(findings, Severity.ERROR) == said(findings, Severity.WARNING) == []
    assert said(findings, Severity.NOTE) == [
        "detections without a name are left out: shoe",
        "/chatter (std_msgs/msg/String) is not read: 21 messages",
        "41 world states in the frame map; t counts from 1700000000.000 s",
    ]


def test_a_place_between_two_transforms_lies_between_both(tmp_path):
    worlds, _ = convert(kitchen(tmp_path / "a.mcap"), period=0.07)
    assert [w.agents["human"].x for w in worlds] == pytest.approx([0.5 * w.t for w in worlds], abs=1e-6)


def test_what_hangs_on_an_agent_is_held(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(40):
        t, parent = T + step / 20, "map" if step < 20 else "person_1"
        bag.tf(t, transform(t, "map", "person_1", (0, 0, 0)), transform(t, parent, "plate_link", (0.3, 0, 1.0)))
    worlds, _ = convert(bag.close())
    held = [w.agents["human"].holding for w in worlds]
    assert held[2] is None and held[-1] == "plate"


def test_what_is_where_a_hand_is_is_held(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(40):
        t, gap = T + step / 20, max(0.05, 1.0 - step / 20)
        bag.tf(
            t,
            transform(t, "map", "person_1", (0, 0, 0)),
            transform(t, "person_1", "right_hand", (0.5, 0, 1.0)),
            transform(t, "map", "plate_link", (0.5 + gap, 0, 1.0)),
        )
    worlds, _ = convert(bag.close())
    held = [w.agents["human"].holding for w in worlds]
    assert held[2] is None and held[-1] == "plate"


@pytest.mark.parametrize("compression", ["NONE", "ZSTD", "LZ4"])
def test_a_file_that_is_cut_off_is_read_up_to_there(tmp_path, compression):
    from mcap.writer import CompressionType

    whole = kitchen(tmp_path / "whole.mcap", compression=CompressionType[compression], chunk_size=20_000)
    (tmp_path / "cut.mcap").write_bytes(whole.read_bytes()[: whole.stat().st_size * 4 // 10])
    all_of_it, _ = convert(whole)
    worlds, findings = convert(tmp_path / "cut.mcap")
    assert 10 < len(worlds) < len(all_of_it)
    assert worlds[:-6] == all_of_it[: len(worlds) - 6]
    assert any("cut off" in message for message in said(findings, Severity.WARNING))


def test_a_spoilt_chunk_is_passed_over_and_the_rest_is_read(tmp_path):
    whole = kitchen(tmp_path / "a.mcap", chunk_size=20_000)
    data = bytearray(whole.read_bytes())
    at = data.index(b"\x28\xb5\x2f\xfd", len(data) // 5) + 20  # within what was compressed
    data[at : at + 40] = bytes(40)
    whole.write_bytes(data)
    worlds, findings = convert(whole)
    assert worlds[-1].t == pytest.approx(4.0, abs=0.2)
    assert any("is passed over" in message for message in said(findings, Severity.WARNING))


def test_nobody_of_that_name_is_an_error(tmp_path):
    _, findings = convert(kitchen(tmp_path / "a.mcap"), Names({"ann": "ann"}))
    (message,) = said(findings, Severity.ERROR)
    assert message == "nobody is in it: no frame and no detection is called ann; say with --names who is"


def test_frames_and_classes_that_never_come_are_told(tmp_path):
    _, findings = convert(kitchen(tmp_path / "a.mcap"), Names({"person_1": "human"}, {"pot": "hobs"}, is_complete=True))
    assert "no frame and no detection is called pot" in said(findings, Severity.WARNING)


def test_a_missing_transform_is_told_and_counted(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(20):
        t = T + step / 10
        bag.tf(t, transform(t, "map", "person_1", (0, 0, 0)))
        bag.seen(t, "camera", detection(t, "camera", "cup", (1, 0, 0)))
    worlds, findings = convert(bag.close())
    assert "20 times: detection without a transform from camera to map" in said(findings, Severity.WARNING)
    assert all("glass" not in world.objects for world in worlds)


def test_poses_that_are_none_are_told_and_left_out(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(20):
        t = T + step / 10
        x = math.nan if step == 7 else 0.0
        bag.tf(t, transform(t, "map", "person_1", (x, 0, 0)))
    worlds, findings = convert(bag.close(), Names({"person_1": "human"}))
    assert len(worlds) == 20
    assert said(findings, Severity.WARNING) == ["once: pose on /tf is none: NaN or infinite"]


def test_of_two_detections_of_one_name_the_surest_is_taken(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(20):
        t = T + step / 10
        bag.tf(t, transform(t, "map", "person_1", (0, 0, 0)))
        two = [detection(t, "map", "cup", (x, 0, 0), score) for x, score in ((1.0, 0.4), (2.0, 0.8), (3.0, 0.6))]
        bag.seen(t, "map", *two)
    worlds, findings = convert(bag.close())
    assert worlds[-1].objects["glass"].x == 2.0
    assert any("the surest is taken" in message for message in said(findings, Severity.WARNING))


def test_several_of_one_class_are_numbered_as_they_are_detected_and_the_nearest_is_the_same(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(40):
        t = T + step / 10
        bag.tf(t, transform(t, "map", "person_1", (0, 0, 0)))
        places = [1.0, 2.0, 3.0] if step % 4 == 0 else [3.0, 1.0, 2.0] if step % 4 == 2 else [2.0, 3.0]
        if step % 2 == 0 or step % 8 == 1:
            bag.seen(t, "map", *(detection(t, "map", "cup", (x, 0, 0)) for x in places))
    names = Names({"person_1": "human"}, several={"cup": "glass"}, is_complete=True)
    worlds, findings = convert(bag.close(), names)
    assert {len(world.objects) for world in worlds} == {2, 3} and set(worlds[-1].objects) <= {"glass_1", "glass_2", "glass_3"}
    notes = said(findings, Severity.NOTE)
    assert any(note.startswith("glass is numbered as it is detected; read it by a domain with setting(") for note in notes)
    assert said(findings, Severity.WARNING) == []
    tracks = Tracker(TrackerSettings(association="nearest"), associator=Associator(lambda name: False))
    for world in worlds:
        (state,) = tracks.steps(world)
        assert {name: round(thing.x) for name, thing in state.objects.items()} == {"glass_1": 1, "glass_2": 2, "glass_3": 3}


def test_a_stamp_that_jumps_does_not_fill_the_file(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    for step in range(20):
        t = T + step / 10
        bag.tf(t, transform(t + (1e8 if step == 9 else 0.0), "map", "person_1", (0, 0, 0)))
    worlds, findings = convert(bag.close(), Names({"person_1": "human"}))
    assert len(worlds) == 20
    assert said(findings, Severity.WARNING) == ["once: stamp is far ahead of those around it"]


def test_a_file_that_says_nothing_is_an_error(tmp_path):
    bag = Bag(tmp_path / "a.mcap")
    bag.text(T, "hello")
    worlds, findings = convert(bag.close())
    assert worlds == []
    assert "nothing in it tells where anybody or anything is" in said(findings, Severity.ERROR)[0]


def test_what_is_no_mcap_is_refused_and_nothing_is_written(tmp_path):
    (tmp_path / "a.mcap").write_text("not at all")
    with pytest.raises(CasperError, match="is no MCAP file"):
        Recordings([tmp_path / "a.mcap"], NAMES).write(tmp_path / "out")
    assert not list((tmp_path / "out").iterdir())


def test_what_is_there_already_is_not_written_over(tmp_path):
    file = kitchen(tmp_path / "a.mcap", seconds=0.5)
    convert(file)
    with pytest.raises(DomainError, match="is there already"):
        Recordings([file], NAMES).write(tmp_path / "out")


# --- names -----------------------------------------------------------------------------------------------------------------


def test_names_are_facts(tmp_path):
    (tmp_path / "names.pl").write_text("fixed(odom).\nagent(human, 'p/1').\nhand(human, h).\nobject(plate, a).\nobject(plate, b).\nobjects(cup, c).\n")
    names = read_names(tmp_path / "names.pl")
    assert names == Names({"p/1": "human"}, {"a": "plate", "b": "plate"}, {"h": "human"}, "odom", is_complete=True, several={"c": "cup"})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("agent(human, a).\nthing(b, c).", "names.pl:2:.*only facts of fixed/1, agent/2, hand/2, object/2"),
        ("agent(human, a).\nobject(b, 3).", "names.pl:2:.*a frame is a name"),
        ("agent(human, a).\nagent(ann, a).", "names.pl:2:.*a is named twice"),
        ("object(cup, a).", "names nobody who acts"),
    ],
)
def test_a_mistake_in_the_names_is_told_with_its_line(tmp_path, text, said):
    (tmp_path / "names.pl").write_text(text)
    with pytest.raises((ReadError, DomainError), match=said):
        read_names(tmp_path / "names.pl")


# --- frames ----------------------------------------------------------------------------------------------------------------

number = st.floats(-10, 10)
poses = st.builds(
    pose_from, st.tuples(number, number, number), st.tuples(*[st.floats(-1, 1).map(lambda v: v + 0.01)] * 4)
)


@given(poses, poses, poses)
def test_poses_within_poses_may_be_put_together_in_any_order(a, b, c):
    left, right = a.of(b).of(c), a.of(b.of(c))
    assert left.place == pytest.approx(right.place, abs=1e-6)


@given(poses, poses)
def test_a_pose_keeps_the_gaps_within_it(a, b):
    assert a.of(b).gap(a) == pytest.approx(b.gap(Pose()), abs=1e-6)


def test_frames_in_a_circle_have_no_pose():
    frames = Frames()
    frames.add(1.0, "a", "b", Pose())
    frames.add(1.0, "b", "a", Pose())
    assert frames.pose("a", "map", 1.0) is None
    assert len(frames.above("a")) == 2


def test_a_transform_holds_for_a_second():
    frames = Frames()
    frames.add(1.0, "map", "a", Pose(1.0))
    assert frames.pose("a", "map", 1.9) == Pose(1.0)
    assert frames.pose("a", "map", 2.5) is None
    assert frames.pose("a", "map", 0.5) is None
