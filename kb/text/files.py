"""Files that others wrote, read with care: regular ones only, and up to a size; and texts written.

A folder of text may hold whatever a file system can: a pipe on which nothing ever comes, a device without an end, a
link that leads in a circle. Each is refused in a sentence before anything is waited for.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable, Mapping
from contextlib import suppress
from io import FileIO
from pathlib import Path

from casper.kb.errors import CasperError, DomainError

MOST_BYTES = 64 * 2**20  # of one file
_CALM = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_CHUNK = 2**20
_ABSENT = (errno.ENOENT, errno.ENOTDIR, errno.ENAMETOOLONG)
_KINDS = {
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFDIR: "a folder",
    stat.S_IFSOCK: "a socket",
}


DRAFTS: dict[Path, str] = {}
"""Texts that an editor has not saved, read instead of the files; empty but in the process that checks for it."""


class Unreadable(OSError):
    """A file whose content is no text for us; ``str()`` says what it is instead."""


def is_there(path: Path) -> bool:
    """Whether there is anything of that name, readable or not: a link that leads nowhere counts."""
    if path in DRAFTS:
        return True
    try:
        os.lstat(path)
    except OSError as mistake:
        return mistake.errno not in _ABSENT
    except ValueError:  # a name that no file can have
        return False
    return True


def oddity(path: Path) -> str | None:
    """What stands there for a regular file, such as ``a pipe``; None for a regular one, or where nobody may look."""
    if path in DRAFTS:
        return None
    try:
        return _kind(os.stat(path).st_mode)
    except FileNotFoundError:
        return "a link to nothing" if os.path.islink(path) else "nothing"
    except OSError as mistake:
        return "a circle of links" if mistake.errno == errno.ELOOP else None


def _kind(mode: int) -> str | None:
    return None if stat.S_ISREG(mode) else _KINDS.get(stat.S_IFMT(mode), "no regular file")


def read_bytes(path: Path) -> bytes:
    """The content of a regular file of at most `MOST_BYTES`.

    Raises:
        Unreadable: it is no regular file, or larger. OSError: it cannot be read.
    """
    if path in DRAFTS:
        return DRAFTS[path].encode("utf-8", "replace")
    odd = oddity(path)  # looked at before it is opened: opening some devices does something
    if odd is not None:
        raise Unreadable(f"it is {odd}, and only regular files are read")
    descriptor = os.open(path, os.O_RDONLY | _CALM)
    with open(descriptor, "rb", buffering=0) as file:
        odd = _kind(os.fstat(descriptor).st_mode)  # and again: it may have been exchanged
        if odd is not None:
            raise Unreadable(f"it is {odd}, and only regular files are read")
        return _bounded(file)


def _bounded(file: FileIO) -> bytes:
    parts, left = [], MOST_BYTES
    while part := file.read(_CHUNK):
        left -= len(part)
        if left < 0:
            raise Unreadable(f"it is larger than {MOST_BYTES // 2**20} MiB, the most that is read of one file")
        parts.append(part)
    return b"".join(parts)


def read_utf8(path: Path) -> str:
    """The text of a regular file, each end of a line a plain newline.

    Raises:
        Unreadable: it is no regular file, too large, or no UTF-8. OSError: it cannot be read.
    """
    try:
        text = read_bytes(path).decode("utf-8")
    except UnicodeDecodeError as mistake:
        raise Unreadable(f"it is no UTF-8 text: byte {mistake.start + 1} begins no character") from None
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def real(path: Path) -> Path:
    """The path without links and dots; as far as there are any, where links lead in a circle."""
    return Path(os.path.realpath(path))


def is_within(file: Path, folders: Iterable[Path]) -> bool:
    """Whether the file really lies in one of the folders, whatever links lead to it."""
    return any(real(file).is_relative_to(real(folder)) for folder in folders)


def unwritable(path: Path) -> str | None:
    """Why no file can be written there, as far as can be told without writing it; None if nothing is against it."""
    from tempfile import TemporaryFile  # slow to import, and seldom needed

    folder = path.parent
    if os.path.isdir(path):
        return "it is a folder"
    if os.path.exists(path):
        return None if os.access(path, os.W_OK) else "writing to it is not allowed"
    if not os.path.isdir(folder):
        return f"there is no folder {folder}"
    try:
        with suppress(FileNotFoundError):
            os.lstat(path)  # fails at a name that is too long
        with TemporaryFile(dir=folder):  # the only way to know: rights, disks and file systems all have a say
            return None
    except OSError as mistake:
        return mistake.strerror or str(mistake)


def check_writable(path: Path) -> None:
    """Refuse a place where no file can be written, before anything is done for it.

    Raises:
        CasperError: why not, as `unwritable`.
    """
    reason = unwritable(path)
    if reason is not None:
        raise CasperError(f"cannot write {path} ({reason}); choose another place")


def write_texts(folder: Path, texts: Mapping[str, str], *, replace: bool = False) -> None:
    """Write texts by the names of their files into a folder, which is made where there is none.

    Raises:
        DomainError: the folder has such files already, and they are not to be replaced, or it cannot be written.
    """
    there = [name for name in texts if (folder / name).exists()]
    if there and not replace:
        raise DomainError(f"{folder / there[0]} is there already; choose another folder, or write --replace")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
    except OSError as mistake:
        raise DomainError(f"cannot write to {folder} ({mistake}); choose another folder") from None
