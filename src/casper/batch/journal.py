"""A run's journal: results as they come, one JSON object a line, so that a killed run goes on where it was.

The first line says what the run is about; another run does not mix with it. A last line that is not whole is dropped.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from hashlib import sha256
from operator import itemgetter
from pathlib import Path
from typing import IO, Any

from casper.batch.rows import Row
from casper.batch.tasks import Result
from casper.batch.workers import Job
from casper.kb.errors import CasperError

FORMAT = 1


def about(job: Job, rows: Sequence[Row], domain: str) -> dict[str, Any]:
    """What a run is about: the task, the options, and digests of the domain and the rows."""
    given = json.dumps([[row.number, dict(row.given), row.mistake] for row in rows], default=str, ensure_ascii=False)
    return {
        "casper batch": FORMAT,
        "task": job.task,
        "options": json.loads(json.dumps(dict(job.options))),
        "domain": domain,
        "rows": sha256(given.encode("utf-8", "surrogateescape")).hexdigest(),
    }


class Journal:
    """Results on file: `done` has those that are there, `add` appends some."""

    def __init__(
        self,
        file: Path,
        header: Mapping[str, Any],
        key: Callable[[Result], Any] = itemgetter("row"),
        differs: str = "other rows, options or domain",
        advice: str = "delete it, or write to another file",
    ) -> None:
        """Open a journal, or begin one.

        Args:
            file: where.
            header: what the run is about.
            key: by which results are kept in `done`; by default their row's number.
            differs, advice: what may be another run's, and what to do then, for the sentence that refuses it.

        Raises:
            CasperError: it belongs to another run, one that is under way uses it, or it cannot be read or written.
        """
        self.file, self.done = file, dict[Any, Result]()
        self._key, self._refusal = key, f"is the journal of another run ({differs}); {advice}"
        try:
            self._out: IO[bytes] = os.fdopen(os.open(file, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
            self._lock()
            whole = self._read(header)
            self._out.truncate(whole)
            self._out.seek(whole)
            if not whole:
                self._write([header])
        except OSError as mistake:
            raise CasperError(f"cannot keep the journal {file} ({mistake.strerror or mistake})") from None

    def _lock(self) -> None:
        """Keep other processes from writing to it, where the system can; the lock goes with the process."""
        try:
            import fcntl

            fcntl.flock(self._out, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._out.close()
            sentence = f"another run that is under way writes to {self.file}"
            raise CasperError(f"{sentence}; wait for it, or write to another place") from None
        except (ImportError, OSError):
            return  # no such locks here; two runs at once are then the user's care

    def _read(self, header: Mapping[str, Any]) -> int:
        """Take in what is there; how many bytes of it are whole."""
        whole = 0
        for line, value in _whole_lines(self.file):
            if not whole and value != header:
                self._out.close()
                raise CasperError(f"{self.file} {self._refusal}")
            if whole:
                self.done[self._key(value)] = value
            whole += len(line)
        return whole

    def add(self, results: Sequence[Result]) -> None:
        """Append results; they are on disk when this returns.

        Raises:
            CasperError: the file cannot be written.
        """
        try:
            self._write(results)
        except OSError as mistake:
            why = mistake.strerror or mistake
            raise CasperError(f"cannot write {self.file} ({why}); the next run goes on from there") from None
        self.done.update((self._key(result), result) for result in results)

    def _write(self, values: Sequence[Mapping[str, Any]]) -> None:
        text = "".join(json.dumps(value, ensure_ascii=False) + "\n" for value in values)
        self._out.write(text.encode("utf-8", "surrogateescape"))
        self._out.flush()
        os.fsync(self._out.fileno())

    def close(self, finished: bool) -> None:
        """Close it; what is finished needs no journal any more."""
        self._out.close()
        if finished:
            self.file.unlink(missing_ok=True)


def _whole_lines(file: Path) -> Iterator[tuple[bytes, Any]]:
    with file.open("rb") as lines:
        for line in lines:
            if not line.endswith(b"\n"):
                return
            try:
                yield line, json.loads(line)
            except ValueError:
                return
