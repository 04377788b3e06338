"""SWI-Prolog as an oracle: many programs and goals in one process."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

needs_swipl = pytest.mark.skipif(shutil.which("swipl") is None, reason="SWI-Prolog (swipl) is not installed")
MAIN = """
:- set_prolog_flag(verbose, silent).
:- set_prolog_flag(double_quotes, atom).
shown(T, S) :- copy_term(T, C), numbervars(C, 0, _), format(atom(S), "~W", [C, [quoted(true), numbervars(true)]]).
ask(M, Goal, Vars) :-
    catch((findall(S, (M:Goal, shown(Vars, S)), L0), L = L0), E, (print_message(error, E), L = [error])),
    sort(L, Sorted), length(Sorted, N), format("~d~n", [N]), forall(member(X, Sorted), (write(X), nl)).
"""


def answers_of(questions: list[tuple[str, str]]) -> list[list[str]]:
    """For every (program text, goal) the sorted, distinct texts of the goal's answers; ``["error"]`` where it raises.

    An answer is the list of the goal's variables' values in order of occurrence, without spaces, open ones as ``A``,
    ``B`` …
    """
    with tempfile.TemporaryDirectory() as folder:
        main = [MAIN]
        for number, (text, goal) in enumerate(questions):
            file = Path(folder) / f"m{number}.pl"
            file.write_text(f":- module(m{number}, []).\n:- style_check([-singleton, -discontiguous]).\n{text}\n")
            names = ", ".join(dict.fromkeys(re.findall(r"\b[A-Z]\w*", goal)))
            main.append(f":- load_files('{file}', [silent(true)]).\nq({number}) :- ask(m{number}, ({goal}), [{names}]).")
        main.append(f":- forall(between(0, {len(questions) - 1}, N), q(N)), halt.")
        (Path(folder) / "main.pl").write_text("\n".join(main))
        done = subprocess.run(
            ["swipl", "-q", "-f", str(Path(folder) / "main.pl")], capture_output=True, text=True, timeout=300
        )
    lines = iter(done.stdout.splitlines())
    return [[re.sub(r"\s", "", next(lines)) for _ in range(int(next(lines)))] for _ in questions]
