"""A recording replayed gives the same events, bit for bit; where it cannot be the same, a sentence says why."""

import gzip
import json
import shutil

import pytest
from streamed import KITCHEN, line, state

from casper import Domain
from casper.engine.domain.domain import SHIPPED
from casper.engine.live import Partners
from casper.kb.errors import CasperError
from casper.streams.recordings.header import header_of
from casper.streams.recordings.replaying import Replay
from casper.streams.recordings.writing import check_recording, recording
from casper.streams.watching import recorded, watched

SETTINGS = {"verification": True, "policy": "strict", "noise": None, "goals": 1}


def carries():
    """A partner who walks to the meal, takes it and puts it on the hobs, and a robot that reports."""
    places = {"meal": (1.6, 0.0), "hobs": (6.0, 0.0), "plate": (-3.0, 3.0)}
    t = 0.0
    for step in range(60):
        x = min(0.3 * step, 1.2) if step < 12 else min(1.2 + 0.3 * (step - 12), 5.6)
        held = "meal" if 8 <= step < 30 else None
        if held:
            places = {**places, "meal": (x + 0.3, 0.0)}
        t += 0.5
        world = state(t, human=(x, 0.0), **places)
        world["agents"]["human"]["holding"] = held
        yield world
    yield {"type": "robot", "t": t, "action": "wash(plate, sink)", "status": "failed"}


def noted(tmp_path, *lines, name="a.jsonl", domain=KITCHEN):
    """The events of a watch that is recorded, and the file."""
    file = tmp_path / name
    with recording(file, header_of(domain, None, SETTINGS)) as writer:
        events = list(writer.heard(watched(Partners(domain, **SETTINGS), map(line, lines), window=1, kept=writer)))
    return [event.to_json() for event in events], file


def replayed(file, domain=None):
    again = Replay(file, domain)
    return [event.to_json() for event in again.events()], again


def test_a_watch_is_replayed_bit_for_bit_warnings_included(tmp_path):
    lines = list(carries())
    lines[20:20] = ["{oops", lines[18], state(1e9), {"type": "scan", "t": 1}]
    lines.insert(40, state(3.0))
    events, file = noted(tmp_path, *lines)
    again, replay = replayed(file)
    assert json.dumps(again) == json.dumps(events)
    assert (replay.is_same, replay.end, replay.differences) == (True, "", [])
    assert {"prediction", "plan", "warning", "episode", "summary"} <= {event["type"] for event in events}


def test_a_compressed_recording_is_the_same(tmp_path):
    plain, file = noted(tmp_path, *carries())
    packed, other = noted(tmp_path, *carries(), name="a.jsonl.gz")
    assert (plain, gzip.decompress(other.read_bytes())) == (packed, file.read_bytes())
    assert replayed(other)[0] == plain


@pytest.mark.parametrize("share", [0.6, 0.8])
@pytest.mark.parametrize("name", ["a.jsonl", "a.jsonl.gz"])
def test_a_recording_that_is_cut_off_is_replayed_up_to_there_and_says_so(tmp_path, share, name):
    events, file = noted(tmp_path, *carries(), name=name)
    whole = file.read_bytes()
    file.write_bytes(whole[: int(len(whole) * share)])
    again, replay = replayed(file)
    seen = [event for event in again if event["type"] == "movement"]
    assert seen and seen == [event for event in events if event["type"] == "movement"][: len(seen)]
    assert replay.is_same is None
    assert "cut off" in replay.end
    assert again[-1]["type"] == "summary"


def test_a_line_that_was_spoilt_is_told_and_passed_over(tmp_path):
    _, file = noted(tmp_path, *carries())
    text = file.read_text().splitlines()
    text[5] = text[5][:30]
    file.write_text("\n".join(text) + "\n")
    again, replay = replayed(file)
    (told,) = (event["message"] for event in again if event["type"] == "warning")
    assert told.startswith("a.jsonl:6 is left out: this is not a line of JSON")
    assert replay.is_same is False


def test_a_domain_that_has_changed_is_told(tmp_path):
    home = tmp_path / "home"
    shutil.copytree(SHIPPED / "kitchen", home)
    _, file = noted(tmp_path, *carries(), domain=Domain.load(home))
    (home / "ontology.pl").open("a").write("% a remark says nothing\n")
    assert Replay(file).differences == []
    (home / "ontology.pl").open("a").write("fragile(glass).\n")
    assert Replay(file).differences == ["the domain home says something else than when a.jsonl was recorded"]
    shutil.rmtree(home)
    with pytest.raises(CasperError, match=r"a\.jsonl is of the domain .*home.*say with --domain"):
        Replay(file)
    assert replayed(file, "kitchen")[1].is_same


def test_other_versions_are_told(tmp_path):
    _, file = noted(tmp_path, *carries())
    text = file.read_text().replace('"casper": "', '"casper": "0.0.').replace('"python": "3.', '"python": "2.')
    file.write_text(text)
    told = Replay(file).differences
    assert "was recorded by casper 0.0." in told[0] and "was recorded on Python 2." in told[1]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "it is empty"),
        (json.dumps(state(1.0)), "its first line does not say of what; casper watch reads world states"),
        ("{oops", "this is not a line of JSON"),
        ('{"type": "recording", "format": 99, "digest": ""}', "of format 99, and this version of casper reads 1"),
        ('{"type": "recording", "format": 1, "domain": "kitchen", "digest": "", "settings": {"helps": 3}}', "none that minds have"),
        ('{"type": "recording", "format": 1, "domain": "kitchen", "digest": "", "settings": {"like": 3}}', "none that minds have"),
    ],
)
def test_what_is_no_recording_is_refused(tmp_path, text, said):
    (tmp_path / "a.jsonl").write_text(text)
    with pytest.raises(CasperError, match=said):
        Replay(tmp_path / "a.jsonl")


def test_a_recording_is_never_written_over(tmp_path):
    (tmp_path / "a.jsonl").write_text("precious")
    with pytest.raises(CasperError, match="is there already"):
        check_recording(tmp_path / "a.jsonl")
    with pytest.raises(CasperError, match="cannot write"):
        check_recording(tmp_path / "nowhere" / "a.jsonl")


def test_what_was_recorded_without_minds_is_read_as_a_watch_would_have_read_it(tmp_path):
    lines = [*carries(), state(3.0)]
    with recording(tmp_path / "b.jsonl", header_of(KITCHEN, None, SETTINGS)) as writer:
        told = list(recorded(writer, map(line, lines), KITCHEN, 1.0))
    events, _ = noted(tmp_path, *lines)
    again, replay = replayed(tmp_path / "b.jsonl")
    assert (again, replay.is_same, len(told)) == (events, None, 1)


def test_a_recording_is_watched_like_any_other_file(tmp_path):
    events, file = noted(tmp_path, *carries())
    again = [event.to_json() for event in watched(Partners(KITCHEN, **SETTINGS), file.read_text().splitlines())]
    assert again == events
