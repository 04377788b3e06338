"""Terms and items of states: plain tuples with numbered variables, so that states are compared and hashed as data.

A term is a constant, a `Slot`, or a tuple ``(functor, argument, …)``. An *item* is a tuple that starts with a tag:

    (ACT, term, by)         an action, with who does it (None: nobody says)
    (CALL, term)            a task that is to be done
    (COND, term)            a condition, as the relation that stands for it
    (PAR, items, before)    all of the items, each once those of its mask in ``before`` are over
    (SEQ, items)            one after the other; a row of items is written as a plain tuple where it can be nothing else
    (OPT, items)            the row, or nothing
    (ALT, items)            one of the items
    (REP, item, least, most)
    (LINK, task, begun, moment)  a task that is under way, and what was done of it (`corners`)

Slots are interned, tags are strings that no text can hold: both are compared by identity.
"""

from __future__ import annotations

import marshal
from collections.abc import Hashable
from typing import Any, TypeAlias

from casper.kb.errors import PlanError
from casper.kb.terms.terms import Compound, Term, Variable

Env: TypeAlias = "dict[Slot, Any]"  # a triangular substitution
Row: TypeAlias = "tuple[Any, ...]"  # of items


Slot = bytes
"""A variable, by its number in digits. Terms of the language have no byte strings; and Python's garbage collector
leaves tuples alone that hold nothing but byte strings, texts and numbers, and states are made of very many of those."""
_SLOTS: list[Slot] = []
_NUMBERS: dict[Slot, int] = {}
_TAGS = {f"\udcfe{name}": name for name in ("ACT", "CALL", "COND", "PAR", "SEQ", "OPT", "ALT", "REP", "LINK")}
_INTERNED = {text: text for text in _TAGS}
ACT, CALL, COND, PAR, SEQ, OPT, ALT, REP, LINK = _TAGS
_PLAIN = 2  # the last format in which equals are always written alike: later ones refer back to what was written


def slot(number: int) -> Slot:
    """The variable of that number; those below 0 stand for what is not known of an observation."""
    if number < 0:
        return b"%d" % number
    while number >= len(_SLOTS):
        made = b"%d" % len(_SLOTS)
        _NUMBERS[made] = len(_SLOTS)
        _SLOTS.append(made)
    return _SLOTS[number]


def interned(term: Any) -> Any:
    """A term that came from another process, with this one's slots and tags."""
    if term.__class__ is Slot:
        return slot(int(term))
    if term.__class__ is tuple:
        return tuple([interned(part) for part in term])
    return _INTERNED.get(term, term) if term.__class__ is str else term


def key_of(term: Any) -> Hashable:
    """What a term (or item, or row) is remembered by where only its equals are looked for.

    A text of bytes, since Python's garbage collector walks through tuples of tuples, and not through those: what is
    remembered of very many states would else be the longest pause. What has no such text (numbers of other kinds, what
    is nested very deeply) stands for itself. Nothing is ever read back.
    """
    try:
        return marshal.dumps(term, _PLAIN)
    except ValueError:
        hashable: Hashable = term
        return hashable


def resolve(term: Any, env: Env) -> Any:
    """The term (or item, or row) with every bound slot replaced; the same object where nothing is."""
    kind = term.__class__
    if kind is Slot:
        while kind is Slot:
            value = env.get(term)
            if value is None:
                return term
            term = value
            kind = term.__class__
        return resolve(term, env) if kind is tuple else term
    if kind is not tuple or not env:
        return term
    for at, part in enumerate(term):
        kind = part.__class__
        if kind is tuple or (kind is Slot and part in env):
            found = resolve(part, env)
            if found is not part:
                return (*term[:at], found, *[resolve(rest, env) for rest in term[at + 1 :]])
    return term


def moved(term: Any, by: int) -> Any:
    """The term with every slot's number that much higher."""
    kind = term.__class__
    if kind is Slot:
        return slot(_NUMBERS[term] + by)
    if kind is not tuple:
        return term
    parts = list(term)
    for at, part in enumerate(term):
        kind = part.__class__
        if kind is Slot:
            parts[at] = slot(_NUMBERS[part] + by)
        elif kind is tuple:
            parts[at] = moved(part, by)
    return tuple(parts)


def filled(term: Any, frame: list[Any]) -> Any:
    """The term with every slot replaced by what stands at its number."""
    kind = term.__class__
    if kind is Slot:
        return frame[_NUMBERS[term]]
    if kind is not tuple:
        return term
    parts = list(term)
    for at, part in enumerate(term):
        kind = part.__class__
        if kind is Slot:
            parts[at] = frame[_NUMBERS[part]]
        elif kind is tuple:
            parts[at] = filled(part, frame)
    return tuple(parts)


def slots_of(term: Any, found: dict[Slot, None]) -> dict[Slot, None]:
    """The slots of a term, in the order in which they are met."""
    kind = term.__class__
    if kind is Slot:
        found[term] = None
    elif kind is tuple:
        for part in term:
            kind = part.__class__
            if kind is Slot:
                found[part] = None
            elif kind is tuple:
                slots_of(part, found)
    return found


_KNOWN: dict[Any, tuple[Slot, ...]] = {}


def slots_in(term: Any) -> tuple[Slot, ...]:
    """The slots of a small term that is met again and again."""
    found = _KNOWN.get(term)
    if found is None:
        if len(_KNOWN) > 10_000:
            _KNOWN.clear()
        found = _KNOWN[term] = tuple(slots_of(term, {}))
    return found


def resolved(term: Any, env: Env) -> Any:
    """As `resolve`, of a small term that is met again and again and mostly stays as it is."""
    return term if env.keys().isdisjoint(slots_in(term)) else resolve(term, env)


def unified(left: Any, right: Any, env: Env) -> Env | None:
    """The most general extension of the substitution that makes both equal (never changed itself), or None."""
    extended, waiting = env, [(left, right)]
    while waiting:
        left, right = waiting.pop()
        while left.__class__ is Slot and (value := extended.get(left)) is not None:
            left = value
        while right.__class__ is Slot and (value := extended.get(right)) is not None:
            right = value
        if left is right:
            continue
        if left.__class__ is not Slot and right.__class__ is Slot:
            left, right = right, left
        if left.__class__ is Slot:
            if right.__class__ is tuple and left in slots_of(resolve(right, extended), {}):
                return None
            if extended is env:
                extended = env.copy()
            extended[left] = right
        elif left.__class__ is tuple and right.__class__ is tuple:
            if len(left) != len(right):
                return None
            waiting.extend(zip(left, right))
        elif left != right:
            return None
    return extended


def inward(term: Term, slots: dict[Variable, Slot]) -> Any:
    """A term of the language as one of ours; ``slots`` grows.

    Raises:
        PlanError: a byte string, which somebody's Python code brought along.
    """
    if isinstance(term, Variable):
        if term not in slots:
            slots[term] = slot(len(slots))
        return slots[term]
    if isinstance(term, bytes):
        raise PlanError("plans that are not listed take no byte strings")
    return tuple([inward(part, slots) for part in term]) if isinstance(term, tuple) else term


def outward(term: Any) -> Term:
    """One of our terms as a term of the language."""
    if term.__class__ is Slot:
        return Variable(f"X{int(term) + 1}")
    return Compound([outward(part) for part in term]) if term.__class__ is tuple else term
