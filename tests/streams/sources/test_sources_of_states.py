"""Standard input, files and sockets give lines; where one ends too soon, a sentence says so."""

import gzip
import io
import json
import socket
import threading

import pytest
from streamed import Watched, state, times, warnings

from casper.kb.errors import CasperError
from casper.streams.sources import lines
from casper.streams.sources.files import File, Standard
from casper.streams.sources.sockets import Socket, address_of
from casper.streams.sources.source import source_of

TEXT = "".join(json.dumps(state(float(t))) + "\n" for t in range(1, 6))


def watch(source):
    return Watched(source.items())


def test_a_file_is_watched_and_its_name_and_line_are_told(tmp_path):
    file = tmp_path / "seen.jsonl"
    file.write_text(TEXT + "{oops\n" + json.dumps(state(6.0)))
    events = watch(File(file))
    assert times(events) == [1, 2, 3, 4, 5, 6]
    (message,) = warnings(events)
    assert message.startswith("seen.jsonl:6 is left out: this is not a line of JSON")


def test_a_compressed_file_says_the_same_as_a_plain_one(tmp_path):
    (tmp_path / "a.jsonl.gz").write_bytes(gzip.compress(TEXT.encode()))
    assert times(watch(File(tmp_path / "a.jsonl.gz"))) == [1, 2, 3, 4, 5]


def test_a_file_that_ends_in_the_middle_of_a_line_is_told(tmp_path):
    (tmp_path / "seen.jsonl").write_text(TEXT + TEXT[:40])
    (message,) = warnings(watch(File(tmp_path / "seen.jsonl")))
    assert message.startswith("seen.jsonl:6 is left out: it is cut off, and so is what should follow")


def test_a_compressed_file_that_is_cut_off_is_read_up_to_there(tmp_path):
    text = "".join(json.dumps(state(t / 10, human=(t % 7 / 10, t % 11 / 100))) + "\n" for t in range(2000))
    whole = gzip.compress(text.encode())
    (tmp_path / "a.gz").write_bytes(whole[: len(whole) // 2])
    events = watch(File(tmp_path / "a.gz"))
    assert 100 < len(times(events)) < 2000
    assert any("a.gz cannot be read behind line" in w and "it is cut off" in w for w in warnings(events))


def test_a_file_that_is_not_compressed_though_its_name_says_so_is_told(tmp_path):
    (tmp_path / "a.gz").write_text(TEXT)
    assert "a.gz cannot be read behind line 0" in warnings(watch(File(tmp_path / "a.gz")))[0]


@pytest.mark.parametrize("name", ["nothing.jsonl", "."])
def test_a_file_that_cannot_be_read_is_refused(tmp_path, name):
    with pytest.raises(CasperError, match="cannot read"):
        File(tmp_path / name)


def test_a_line_that_is_too_long_is_left_out_and_not_kept(monkeypatch):
    monkeypatch.setattr(lines, "LONGEST", 1000)
    text = json.dumps(state(1.0)) + "\n" + "x" * 5000 + "\n" + json.dumps(state(2.0)) + "\n"
    events = watch(Standard(io.StringIO(text)))
    assert times(events) == [1, 2]
    assert warnings(events) == ["line 2 is left out: it is longer than 1,000 characters"]


# --- sockets ---------------------------------------------------------------------------------------------------------------


def served(*connections):
    """A server that hands each text to one who connects, and its name."""
    server = socket.create_server(("127.0.0.1", 0))

    def serve():
        for text, rude in connections:
            connection, _ = server.accept()
            connection.sendall(text.encode())
            if rude:  # a reset instead of an end
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\x01\0\0\0\0\0\0\0")
            connection.close()
        server.close()

    threading.Thread(target=serve, daemon=True).start()
    return f"tcp://127.0.0.1:{server.getsockname()[1]}"


def test_states_come_over_a_socket_and_its_end_is_the_end():
    source = Socket(served((TEXT, False)))
    assert times(watch(source)) == [1, 2, 3, 4, 5]
    assert not source.lost


def test_a_connection_that_ends_in_the_middle_of_a_line_is_lost():
    source = Socket(served((TEXT + TEXT[:40], False)))
    told = warnings(watch(source))
    assert source.lost
    assert any("was lost (in the middle of a line) behind line 6" in w for w in told)


def test_a_lost_connection_is_taken_up_again_and_the_lines_are_counted_on():
    half = TEXT.index('{"t": 4')
    source = Socket(served((TEXT[:half], False), (TEXT[half:], False)), reconnect=0.6)
    events = watch(source)
    assert times(events) == [1, 2, 3, 4, 5]
    assert "ended behind line 3; waiting 0.6 s" in warnings(events)[0]
    assert "nobody came back" in warnings(events)[-1] and source.lost


def test_one_who_connects_is_listened_to():
    said = []
    source = Socket("tcp://127.0.0.1:0", listens=True, tell=said.append)
    port = int(said[0].rpartition(":")[2])

    def robot():
        with socket.create_connection(("127.0.0.1", port)) as connection:
            connection.sendall(TEXT.encode())

    threading.Thread(target=robot, daemon=True).start()
    assert times(watch(source)) == [1, 2, 3, 4, 5]


def test_nobody_there_is_refused_in_a_sentence():
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(CasperError, match=f"nobody can be reached at tcp://127.0.0.1:{port}"):
        Socket(f"tcp://127.0.0.1:{port}")


def test_a_port_that_is_taken_is_refused_in_a_sentence():
    with socket.create_server(("127.0.0.1", 0)) as server, pytest.raises(CasperError, match="cannot listen at"):
        Socket(f"tcp://127.0.0.1:{server.getsockname()[1]}", listens=True)


@pytest.mark.parametrize(("name", "address"), [("tcp://a:1", ("a", 1)), ("tcp://[::1]:70", ("::1", 70)), ("tcp://:9", ("localhost", 9))])
def test_addresses(name, address):
    assert address_of(name) == address


@pytest.mark.parametrize("name", ["tcp://a", "tcp://a:b", "tcp://a:70000", "tcp://a:-1"])
def test_what_is_no_address_is_refused(name):
    with pytest.raises(CasperError, match="tcp://HOST:PORT"):
        address_of(name)


def test_options_of_sockets_are_refused_for_files(tmp_path):
    with pytest.raises(CasperError, match="--listen is about sockets"):
        source_of("seen.jsonl", listens=True)


