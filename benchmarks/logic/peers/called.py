"""SWI-Prolog as a Python user calls it: janus-swi, pyswip, and swiplserver, each in a fresh process of its own.

janus-swi and pyswip hold SWI-Prolog inside the Python process, swiplserver talks to one over a socket. What is timed is
what the user waits for: from the call to a list of answers in Python. A package that is not installed, does not fit the
swipl that is there, crashes or takes too long gives a reason.
"""

import importlib.util
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeAlias

from ..figures import OURS, PROCESSOR, Figure, Found, Sizes, Skipped, clock, fingerprint, per_call
from . import prolog
from .fresh import fresh

Ask: TypeAlias = Callable[[str], Iterable[Any]]
Answers: TypeAlias = dict[str, tuple[float, tuple[int, int]]]  # by task: seconds, fingerprint of the answers


@contextmanager
def _janus(program: Path) -> Iterator[Ask]:
    import janus_swi as janus

    janus.consult(str(program))
    yield lambda goal: [{n: v for n, v in x.items() if n != "truth"} for x in janus.query(goal)]


@contextmanager
def _pyswip(program: Path) -> Iterator[Ask]:
    from pyswip import Prolog

    engine = Prolog()
    engine.consult(str(program))
    yield lambda goal: list(engine.query(goal))


@contextmanager
def _swiplserver(program: Path) -> Iterator[Ask]:
    from swiplserver import PrologMQI

    with PrologMQI() as engine, engine.create_thread() as thread:
        thread.query(f"consult('{program}')")

        def ask(goal: str) -> list[Any]:
            found = thread.query(goal)
            return ([{}] if found else []) if isinstance(found, bool) else found

        yield ask


WAYS: Mapping[str, tuple[str, Callable[[Path], Any]]] = {  # by package: its module, and how a program is held by it
    "janus-swi": ("janus_swi", _janus),
    "pyswip": ("pyswip", _pyswip),
    "swiplserver": ("swiplserver", _swiplserver),
}
OVER_A_SOCKET = "swiplserver"
NEEDS = {"janus-swi": " (it needs SWI-Prolog 9.1.12 or later)"}


def calls(text: str, goals: Mapping[str, str], sizes: Sizes) -> Found:
    """The seconds of each goal by each package, all answers in a Python list, or reasons."""
    for package, (module, _) in WAYS.items():
        found = _of(package, module, text, goals, sizes)
        if isinstance(found, str):
            yield Skipped(next(iter(goals)), package, found)
            continue
        for task, (seconds, answers) in found.items():
            yield Figure(task, package, seconds, answers)


def _of(package: str, module: str, text: str, goals: Mapping[str, str], sizes: Sizes) -> Answers | str:
    if not prolog.is_installed():
        return prolog.ABSENT
    if package == OVER_A_SOCKET and clock() == PROCESSOR:
        return "most of its time is another process's, which this run does not count"
    if importlib.util.find_spec(module) is None:
        return f"the Python package {package} is not installed{NEEDS.get(package, '')}"
    try:
        return fresh(_measured, package, text, dict(goals), sizes, limit=sizes.limit)
    except TimeoutError as late:
        return str(late)
    except BrokenProcessPool:
        return "its process crashed"
    except Exception as mistake:  # whatever a package raises is its own line of the report
        return f"it failed: {type(mistake).__name__}: {str(mistake)[:200]}"


def _measured(package: str, text: str, goals: dict[str, str], sizes: Sizes) -> Answers:
    """Runs in the fresh process."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "program.pl"
        program.write_text(prolog.QUIET + text)
        with WAYS[package][1](program) as ask:
            return {task: _timed(ask, goal, sizes) for task, goal in goals.items()}


def _timed(ask: Ask, goal: str, sizes: Sizes) -> tuple[float, tuple[int, int]]:
    seconds, found = per_call(ask, goal, sizes=sizes)
    return seconds, answers(found)


def answers(found: Iterable[Any]) -> tuple[int, int]:
    """The fingerprint of answers that are dictionaries by variable."""
    return fingerprint([f"{name}={value}" for name, value in sorted(answer.items())] for answer in found)


def ours(ask: Ask, goals: Mapping[str, str], sizes: Sizes, engine: str = OURS) -> Iterator[Figure]:
    """The same goals by a knowledge base's `query`."""
    for task, goal in goals.items():
        seconds, found = per_call(lambda g=goal: list(ask(g)), sizes=sizes)
        yield Figure(task, engine, seconds, answers(found))
