"""Files that others wrote: only regular ones are read, up to a size, and nothing is waited for."""

import os
import socket
from pathlib import Path

import pytest

from casper.kb.text import files
from casper.kb.text.files import Unreadable, is_there, is_within, oddity, read_utf8, unwritable

needs_pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this platform has no pipes with a name")


def odd_places(folder):
    """Everything that is no regular file, and what it is called."""
    os.mkfifo(folder / "fifo")
    (folder / "folder").mkdir()
    (folder / "circle").symlink_to("circle")
    (folder / "lost").symlink_to("gone")
    (folder / "to fifo").symlink_to("fifo")
    with socket.socket(socket.AF_UNIX) as open_socket:
        here = Path.cwd()
        os.chdir(folder)  # the names of sockets are short
        open_socket.bind("socket")
        os.chdir(here)
    return {
        folder / "fifo": "a pipe",
        folder / "to fifo": "a pipe",
        folder / "folder": "a folder",
        folder / "circle": "a circle of links",
        folder / "circle" / "x.pl": "a circle of links",
        folder / "lost": "a link to nothing",
        folder / "socket": "a socket",
        Path("/dev/zero"): "a device",
        Path("/dev/stdin"): None,  # whatever it is
    }


@needs_pipes
def test_what_is_no_regular_file_is_called_by_its_name_and_not_read(tmp_path):
    for path, name in odd_places(tmp_path).items():
        if name is not None:
            assert is_there(path), path
            assert oddity(path) == name
            with pytest.raises(Unreadable, match=f"it is {name}, and only regular files are read"):
                read_utf8(path)


def test_a_regular_file_is_read_with_plain_ends_of_lines(tmp_path):
    file = tmp_path / "a.pl"
    file.write_bytes("p(é).\r\nq.\rr.\n".encode())
    assert oddity(file) is None
    assert read_utf8(file) == file.read_text(encoding="utf-8") == "p(é).\nq.\nr.\n"


def test_what_is_no_utf8_is_told_with_its_place(tmp_path):
    (tmp_path / "a.pl").write_bytes(b"p(\xff).")
    with pytest.raises(Unreadable, match="it is no UTF-8 text: byte 3 begins no character"):
        read_utf8(tmp_path / "a.pl")


def test_a_file_is_read_up_to_a_size(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "MOST_BYTES", 2**20)
    file = tmp_path / "a.pl"
    file.write_text(" " * 2**20)
    assert len(read_utf8(file)) == 2**20
    file.write_text(" " * (2**20 + 1))
    with pytest.raises(Unreadable, match="it is larger than 1 MiB, the most that is read of one file"):
        read_utf8(file)


def test_a_file_without_an_end_is_given_up(tmp_path):
    """A sparse file says it is as large as no memory: it is not read beyond the limit."""
    with open(tmp_path / "a.pl", "wb") as file:
        file.truncate(2**40)
    with pytest.raises(Unreadable, match="larger than 64 MiB"):
        read_utf8(tmp_path / "a.pl")


@pytest.mark.parametrize("name", ["gone", "gone/gone", "x" * 5000, "a\0b", "file/x"])
def test_what_no_file_has_as_its_name_is_not_there(tmp_path, name):
    (tmp_path / "file").write_text("")
    assert not is_there(tmp_path / name)


def test_a_link_out_of_a_folder_is_not_within_it(tmp_path):
    inner, outer = tmp_path / "inner", tmp_path / "outer"
    inner.mkdir()
    outer.mkdir()
    (outer / "a.pl").write_text("")
    (inner / "link.pl").symlink_to(outer / "a.pl")
    (inner / "b.pl").write_text("")
    (outer / "inner").symlink_to(inner)
    assert is_within(inner / "b.pl", [inner])
    assert is_within(outer / "inner" / "b.pl", [inner])
    assert not is_within(inner / "link.pl", [inner])
    assert is_within(inner / "link.pl", [inner, outer])
    assert not is_within(inner / ".." / "outer" / "a.pl", [inner])


def test_where_a_file_can_be_written_nothing_is_said_and_nothing_left(tmp_path):
    assert unwritable(tmp_path / "new.svg") is None
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "old.svg").write_text("before")
    assert unwritable(tmp_path / "old.svg") is None
    assert (tmp_path / "old.svg").read_text() == "before"


def test_where_none_can_be_written_the_reason_is_told(tmp_path):
    assert unwritable(tmp_path) == "it is a folder"
    assert unwritable(tmp_path / "gone" / "a.svg") == f"there is no folder {tmp_path / 'gone'}"
    assert unwritable(tmp_path / ("x" * 5000) / "a.svg") is not None


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="needs a folder in which nobody can write")
def test_rights_alone_do_not_make_a_folder_writable():
    assert unwritable(Path("/proc/a.svg")) is not None
