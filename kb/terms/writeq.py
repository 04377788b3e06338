"""How SWI-Prolog's ``writeq`` writes a term, to the character: ``a:-b,c``, ``- 1``, ``1- -1``, ``a=(:-)``."""

from __future__ import annotations

from typing import Any

from casper.kb.terms.atoms import NIL, goes_on, is_sign, is_signs, is_word, number_text, quoted
from casper.kb.terms.operators import ARGUMENT, HIGHEST, STANDARD

_BARE = frozenset({NIL, "{}", "!", ";"})


def writeq(term: Any, limit: int = HIGHEST) -> str:
    """The term as ``writeq`` of SWI-Prolog 9.0 writes it, variables by their names.

    Args:
        term: any term.
        limit: the highest operator priority that needs no brackets.
    """
    if isinstance(term, tuple) and term and isinstance(term[0], str):
        return _compound(term, limit)
    if isinstance(term, str):
        name = _atom(term)
        is_operator = term in STANDARD or term == "."  # SWI-Prolog's operator of dicts, which are no terms here
        return f"({name})" if limit < HIGHEST and is_operator else name
    return number_text(term) if isinstance(term, (int, float)) else str(term)


def _atom(atom: str) -> str:
    return atom if is_word(atom) or is_signs(atom) or atom in _BARE else quoted(atom)


def _argument(term: Any) -> str:
    return _atom(term) if isinstance(term, str) else writeq(term, ARGUMENT)


def _compound(term: tuple[Any, ...], limit: int) -> str:
    functor, *args = term
    if functor == "." and len(args) == 2:
        return _list(term)
    if functor == "{}" and len(args) == 1:
        return f"{{{writeq(args[0])}}}"
    if len(args) == 1 and functor in STANDARD.prefix:
        return _within(_prefixed(functor, args[0]), STANDARD.prefix[functor][0], limit)
    if len(args) == 2 and functor in STANDARD.infix:
        return _within(_infixed(functor, *args), STANDARD.infix[functor][0], limit)
    name = f"'{NIL}'" if functor == NIL else _atom(functor)
    return f"{name}({','.join(map(_argument, args))})" if args else name


def _within(text: str, priority: int, limit: int) -> str:
    return f"({text})" if priority > limit else text


def _list(cell: Any) -> str:
    items = []
    while isinstance(cell, tuple) and len(cell) == 3 and cell[0] == ".":
        items.append(_argument(cell[1]))
        cell = cell[2]
    return f"[{','.join(items)}]" if cell == NIL else f"[{','.join(items)}|{_argument(cell)}]"


def _prefixed(name: str, arg: Any) -> str:
    operand, shown = writeq(arg, STANDARD.prefix[name][1]), _atom(name)
    apart = operand[0] in "({" or (name == "-" and operand[0].isdigit()) or _run_together(shown, operand)
    return f"{shown} {operand}" if apart else shown + operand


def _infixed(name: str, left: Any, right: Any) -> str:
    _, left_most, right_most = STANDARD.infix[name]
    before, after = writeq(left, left_most), writeq(right, right_most)
    if name in (",", "|"):
        return f"{before}{name}{after}"
    shown = _atom(name)
    if _run_together(before, shown):
        return f"{before} {shown} {after}"
    return f"{before}{shown} {after}" if _run_together(shown, after) else before + shown + after


def _run_together(before: str, after: str) -> bool:
    """Whether two tokens would read as one if nothing stood between them."""
    last, first = before[-1], after[0]
    return (goes_on(last) and goes_on(first)) or (is_sign(last) and is_sign(first))
