"""SWI-Prolog as an oracle: many programs and goals in one process."""

from __future__ import annotations

import shutil
import subprocess

import pytest

needs_swipl = pytest.mark.skipif(shutil.which("swipl") is None, reason="SWI-Prolog (swipl) is not installed")


def answers_of(programs: list[tuple[str, str, str]], tabled: str = "") -> list[list[str]]:
    """For every (text, goal, template) the sorted texts of the goal's answers; the programs are modules of one file.

    A goal that raises gives ``["error"]``. Texts are written with ``print_message`` off and ``writeq``.
    """
    lines = [":- set_prolog_flag(double_quotes, atom).", ":- style_check(-singleton).", ":- style_check(-discontiguous)."]
    for number, (text, goal, template) in enumerate(programs):
        lines += [
            f"load({number}) :- atom_to_memory_file({_quoted(text)}, F), open_memory_file(F, read, S), "
            f"load_files(m{number}:x{number}, [stream(S)]), close(S).",
            f"goal({number}, T) :- term_to_atom(t({template}, {goal}), _), "
            f"catch(findall({template}, m{number}:({goal}), L0), _, L0 = [error]), sort(L0, T).",
        ]
    lines.append(
        f"main :- forall(between(0, {len(programs) - 1}, N), "
        "(load(N), goal(N, L), length(L, K), format(\"~d~n\", [K]), "
        "forall(member(X, L), (write_term(X, [quoted(true), numbervars(false), dotlists(true)]), nl)))).\n"
    )
    done = subprocess.run(
        ["swipl", "-q", "-f", "/dev/stdin", "-g", "use_module(library(memfile)),main", "-t", "halt"],
        input="\n".join([":- use_module(library(memfile)).", *lines]),
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    shown = iter(done.stdout.splitlines())
    return [[next(shown) for _ in range(int(next(shown)))] for _ in programs]


def _quoted(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'").replace("\n", "\\n") + "'"
