"""SWI-Prolog as a peer: programs and goals are timed inside one swipl process, without any pipe."""

import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..figures import Sizes, clock, fingerprint

STACK = ("--stack-limit=6g", "--table-space=6g")
ABSENT = "swipl is not on the PATH"
QUIET = ":- style_check([-singleton, -discontiguous, -no_effect]).\n:- use_module(library(statistics)).\n"
DERIVE = """
seconds(S) :-
    abolish_all_tables, garbage_collect,
    call_time(forall(counted(G), aggregate_all(count, G, _)), D), S = D.CLOCK.
main(Repeats, Rows) :-
    length(Times, Repeats), maplist(seconds, Times), msort(Times, Sorted),
    Middle is Repeats // 2, nth0(Middle, Sorted, S), format("~15f~n", [S]),
    setup_call_cleanup(open(Rows, write, Out), write_rows(Out), close(Out)).
write_rows(Out) :- forall((counted(G), call(G)), (G =.. L, row(L, Out))).
row(L, Out) :- atomic_list_concat(L, ' ', A), writeln(Out, A).
"""
ENUMERATE = """
seconds(S) :- abolish_all_tables, garbage_collect, call_time(forall(asked, true), D), S = D.CLOCK.
main(Repeats, Rows) :-
    length(Times, Repeats), maplist(seconds, Times), msort(Times, Sorted),
    Middle is Repeats // 2, nth0(Middle, Sorted, S), format("~15f~n", [S]),
    setup_call_cleanup(open(Rows, write, Out), forall(row(Row), row(Row, Out)), close(Out)).
row(Row, Out) :- atomic_list_concat(Row, ' ', A), writeln(Out, A).
"""
FIRST = """
main(Rows) :-
    garbage_collect, call_time(once(asked(X)), D), S = D.CLOCK, format("~15f~n", [S]),
    setup_call_cleanup(open(Rows, write, Out), writeln(Out, X), close(Out)).
"""
LOOPS = """
calls(S, G, N, Runs, Middle) :-
    length(Times, Runs), maplist(run(S, G, N), Times), msort(Times, Sorted),
    M is Runs // 2, nth0(M, Sorted, Middle).
run(_, G, N, S) :- garbage_collect, call_time(loop(G, N), D), S is D.CLOCK / N.
main(Seconds, Runs) :-
    Most is max(1000, truncate(Seconds * 6.0e6)), calls(Seconds, 0, Most, Runs, Empty),
    forall(between(1, {last}, G), timed(G, Seconds, Most, Runs, Empty)).
timed(G, Seconds, Most, Runs, Empty) :-
    loop(G, 1), call_time(loop(G, 1), D), N is max(1, min(Most, truncate(Seconds / max(D.CLOCK, 1.0e-7)))),
    calls(Seconds, G, N, Runs, S), Net is S - Empty,
    aggregate_all(count, goal(G), Count), format("~15f ~d~n", [Net, Count]).
"""


def is_installed() -> bool:
    """Whether there is a swipl to run."""
    return shutil.which("swipl") is not None


def version() -> str:
    """The name and the version."""
    shown = subprocess.run(["swipl", "--version"], capture_output=True, text=True).stdout
    return " ".join(shown.split()[:3]).replace(" version", "")


def derive(
    text: str, tabled: Sequence[tuple[str, int]], counted: Sequence[tuple[str, int]], mode: str, sizes: Sizes
) -> tuple[float, tuple[int, int]] | None:
    """Median seconds to table all answers, and their fingerprint; None when the time limit is hit.

    Args:
        text: facts and rules.
        tabled: predicates under ``:- table``.
        counted: predicates whose answers are wanted.
        mode: ``variant`` or ``subsumptive``.
        sizes: repeats, and the limit of the process.
    """
    as_mode = " as subsumptive" if mode == "subsumptive" else ""
    tables = "".join(f":- table {name}/{arity}{as_mode}.\n" for name, arity in tabled)
    goals = "".join(f"counted({_open(name, arity)}).\n" for name, arity in counted)
    dynamic = "".join(f":- dynamic {name}/{arity}.\n" for name, arity in counted if (name, arity) not in tabled)
    with tempfile.TemporaryDirectory() as folder:
        rows = Path(folder) / "rows.txt"
        source = f"{QUIET}{dynamic}{tables}{text}{goals}{DERIVE}"
        lines = _run(source, f"main({sizes.repeats}, '{rows}')", folder, sizes.limit)
        if lines is None:
            return None
        with rows.open() as found:
            return float(lines[0]), fingerprint(line.split() for line in found)


def _open(name: str, arity: int) -> str:
    return f"{name}({', '.join('_' * arity)})"


def calls(text: str, goals: Mapping[str, str], sizes: Sizes) -> dict[str, tuple[float, int]]:
    """For each named goal the seconds of finding all its answers once, and how many there are.

    Goals are compiled, as clauses; the empty loop's time is subtracted. The rules run as they are and
    under ``-O``, and the better figure counts.
    """
    loops = ["loop(0, N) :- between(1, N, _), fail.", "loop(0, _)."]
    for at, goal in enumerate(goals.values(), start=1):
        loops += [
            f"loop({at}, N) :- between(1, N, _), {goal}, fail.",
            f"loop({at}, _).",
            f"goal({at}) :- {goal}.",
        ]
    source = f"{QUIET}{text}\n" + "\n".join(sorted(loops)) + LOOPS.replace("{last}", str(len(goals)))
    best: dict[str, tuple[float, int]] = {}
    for options in ((), ("-O",)):
        with tempfile.TemporaryDirectory() as folder:
            lines = _run(source, f"main({sizes.loop_seconds}, {sizes.loops})", folder, sizes.limit, options)
        for name, line in zip(goals, lines or ()):
            seconds, count = float(line.split()[0]), int(line.split()[1])
            best[name] = min(best.get(name, (seconds, count)), (seconds, count))
    return best


def enumerated(
    text: str, goal: str, row: Sequence[str], sizes: Sizes, *, query: str = "", repeats: int | None = None
) -> tuple[float, tuple[int, int]] | str:
    """Median seconds of finding all answers to a goal, inside swipl, and their fingerprint; or why there are none.

    Args:
        text: facts, rules and directives. Tables are emptied before each run.
        goal: what is timed, as the body of a clause.
        row: the variables of an answer, each atomic.
        sizes: repeats, and the limit of the process.
        query: the goal that gives the rows, where it is another one than is timed.
        repeats: how often, where it is not as often as in ``sizes``.
    """
    if not is_installed():
        return ABSENT
    asked = f"asked :- {goal}.\nrow([{', '.join(row)}]) :- {query or goal}.\n"
    with tempfile.TemporaryDirectory() as folder:
        rows = Path(folder) / "rows.txt"
        lines = _run(
            f"{QUIET}{text}\n{asked}{ENUMERATE}", f"main({repeats or sizes.repeats}, '{rows}')", folder, sizes.limit
        )
        if lines is None:
            return f"it did not finish in {sizes.limit:.0f} s"
        with rows.open() as found:
            return float(lines[0]), fingerprint(line.split() for line in found)


def first(text: str, goal: str, variable: str, sizes: Sizes) -> tuple[float, str] | str:
    """Seconds of the very first call of a goal in a fresh swipl, and the value of a variable; or why there is none."""
    if not is_installed():
        return ABSENT
    with tempfile.TemporaryDirectory() as folder:
        value = Path(folder) / "value.txt"
        lines = _run(f"{QUIET}{text}\nasked({variable}) :- {goal}.\n{FIRST}", f"main('{value}')", folder, sizes.limit)
        return (
            f"it did not finish in {sizes.limit:.0f} s"
            if lines is None
            else (float(lines[0]), value.read_text().strip())
        )


def consulted(text: str, statement: str, sizes: Sizes) -> tuple[float, bool] | str:
    """Seconds of consulting a text from a file and asking for one statement, and the answer; or why there is none."""
    if not is_installed():
        return ABSENT
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "text.pl"
        file.write_text(text)
        goal = f"call_time((consult('{file}'), ({statement} -> A = yes ; A = no)), D), S = D.CLOCK"
        source = f"{QUIET}main :- {goal}, format('~15f ~w~n', [S, A]).\n"
        lines = _run(source, "main", folder, sizes.limit)
    if lines is None:
        return f"it did not finish in {sizes.limit:.0f} s"
    seconds, answer = lines[-1].split()
    return float(seconds), answer == "yes"


def _run(source: str, goal: str, folder: str, limit: float, options: Sequence[str] = ()) -> list[str] | None:
    """The lines a goal prints in a fresh process; None when it takes too long.

    Raises:
        RuntimeError: swipl reports an error or a failure.
    """
    program = Path(folder) / "program.pl"
    program.write_text(source.replace("D.CLOCK", f"D.{clock()}"))
    command = ["swipl", *STACK, *options, "-q", "-f", str(program), "-g", goal, "-t", "halt"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode or "rror" in done.stderr or "Warning" in done.stderr:
        raise RuntimeError(f"swipl: {done.stderr.strip()}")
    return done.stdout.splitlines()
