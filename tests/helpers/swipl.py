"""SWI-Prolog as an oracle: one process reads a batch of terms and says how it writes them, and what they are."""

from __future__ import annotations

import shutil
import subprocess

from casper.kb.terms.atoms import number_text
from casper.kb.terms.terms import Compound, Variable

SWIPL = shutil.which("swipl")

# Of each pair of lines (a term in canonical form, a text) it prints how the term is written, and whether the text is it.
_PROGRAM = r"""
:- set_prolog_flag(double_quotes, atom).
:- set_stream(user_input, encoding(utf8)), set_stream(user_output, encoding(utf8)).
options([quoted(true), numbervars(true), character_escapes_unicode(false)]).
loop :-
    read_line_to_string(user_input, Canonical),
    (   Canonical == end_of_file -> true
    ;   read_line_to_string(user_input, Text), written(Canonical), read_as(Canonical, Text), loop
    ).
written(Canonical) :-
    catch(( term_string(T, Canonical, [variable_names(Names)]), options(Options),
            with_output_to(string(Shown), write_term(T, [variable_names(Names)|Options])),
            format("~w~n", [Shown]) ), Error, (print(Error), nl)).
read_as(Canonical, Text) :-
    catch(( term_string(T, Canonical, [variable_names(A)]), term_string(U, Text, [variable_names(B)]),
            ( same_names(A, B), T-A =@= U-A -> writeln(same) ; writeln(different) ) ), Error, (print(Error), nl)).
same_names(A, B) :- msort(A, As), msort(B, Bs), forall(member(N=_, As), memberchk(N=_, Bs)), maplist(tied(Bs), As).
tied(Bs, N=V) :- memberchk(N=V, Bs).
:- initialization((loop, halt)).
"""


def canonical(term) -> str:
    """A term with every atom in quotes and no operator: it reads the same whatever the operators are."""
    if isinstance(term, Variable):
        return term.name
    if isinstance(term, str):
        return term if term in ("[]", "{}") else _quoted(term)
    if isinstance(term, Compound):
        name = "'[|]'" if term.indicator == (".", 2) else term[0] if term[0] == "{}" else _quoted(term[0])
        return f"{name}({','.join(map(canonical, term.args))})"
    return number_text(term)


def _quoted(atom: str) -> str:
    return "'" + "".join(f"\\x{ord(c):x}\\" if c in "'\\" or not c.isprintable() else c for c in atom) + "'"


def asked(pairs, folder) -> list[tuple[str, str]]:
    """For each (term, text): how SWI-Prolog writes the term, and ``same`` if it reads the text as the term."""
    program = folder / "oracle.pl"
    program.write_text(_PROGRAM)
    lines = "".join(f"{canonical(term)}\n{text}\n" for term, text in pairs)
    done = subprocess.run([SWIPL, str(program)], input=lines.encode(), capture_output=True, check=True, timeout=300)
    answers = done.stdout.decode().split("\n")
    return list(zip(answers[0:-1:2], answers[1::2]))
