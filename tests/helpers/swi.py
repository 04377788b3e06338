"""SWI-Prolog as an oracle: one process answers for many programs."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_query

needs_swi = pytest.mark.skipif(shutil.which("swipl") is None, reason="SWI-Prolog (swipl) is not installed")
MANY = 10_000 if os.environ.get("HYPOTHESIS_PROFILE") == "thorough" else 200

_ASK = """
:- style_check(-singleton), style_check(-discontiguous), style_check(-no_effect).
:- set_prolog_flag(table_space, 4000000000).
run(Last, Out) :- open(Out, write, O), forall(between(0, Last, N), one(N, O)), close(O).
one(N, O) :- preds(Ps), forall(member(P/A, Ps), ask(N, P, A, O)), write(O, 'end\\n').
ask(N, P, A, O) :-
  atomic_list_concat([P, '_', N], F), functor(G, F, A),
  catch((findall(T-As, (call_delays(G, D), G =.. [_|As], (D == true -> T = t ; T = u)), L0), sort(L0, L)), E, true),
  (   nonvar(E) -> format(O, "error~n", [])
  ;   forall(member(T-As, L), (X =.. [P|As], format(O, "~w ", [T]), write_canonical(O, X), nl(O)))
  ).
"""


def answers(programs: list[list[str]], tabled: dict[str, int], given: dict[str, int], folder: Path) -> list[Answers]:
    """What SWI-Prolog says of each program's tabled predicates: (atoms that hold, undefined ones, whether it failed).

    Args:
        programs: clauses; ``\\+`` of a tabled predicate is asked for as ``tnot``.
        tabled: the predicates of the rules, with their arities.
        given: those of the facts.
        folder: for the files that go to and fro.
    """
    name = "|".join(f"{name}(?=[(])" if arity else rf"{name}\b" for name, arity in {**tabled, **given}.items())
    lines = [_ASK, f"preds([{', '.join(f'{name}/{arity}' for name, arity in tabled.items())}])."]
    for number, program in enumerate(programs):
        own = ", ".join(f"{n}_{number}/{arity}" for n, arity in tabled.items())
        facts = ", ".join(f"{n}_{number}/{arity}" for n, arity in given.items())
        lines.append(f":- table {own}.\n:- dynamic {own}, {facts}.")
        lines += [re.sub(rf"\b({name})", rf"\1_{number}", clause) for clause in program]
    source, out = folder / "programs.pl", folder / "answers"
    source.write_text("\n".join(lines) + "\n", encoding="utf-8")
    command = ["swipl", "-q", "-g", f"run({len(programs) - 1}, '{out}')", "-t", "halt", str(source)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=3000, check=False)
    assert done.returncode == 0 and not done.stderr.strip(), done.stderr[-2000:]
    return _read(out.read_text(encoding="utf-8"))


Answers = tuple[set[Compound], set[Compound], bool]


def _read(text: str) -> list[Answers]:
    found: list[Answers] = []
    true: set[Compound] = set()
    undefined: set[Compound] = set()
    failed = False
    for line in text.splitlines():
        if line == "end":
            found.append((true, undefined - true, failed))
            true, undefined, failed = set(), set(), False
        elif line == "error":
            failed = True
        else:
            ((literal,),) = read_query(line[2:])
            (true if line[0] == "t" else undefined).add(literal.atom)
    return found
