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

Slots are interned, tags are unique: both are compared by identity.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from casper.kb.terms.terms import Compound, Term, Variable

Env: TypeAlias = "dict[Slot, Any]"  # a triangular substitution
Row: TypeAlias = "tuple[Any, ...]"  # of items


class Slot:
    """A variable, by its number; there is one object for each number."""

    __slots__ = ("number",)

    def __init__(self, number: int) -> None:
        self.number = number

    def __repr__(self) -> str:
        return f"_{self.number}"

    def __reduce__(self) -> tuple[Any, ...]:
        return slot, (self.number,)


class Tag:
    """What kind of item a tuple is; there is one object for each kind."""

    __slots__ = ("name",)

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return self.name

    def __reduce__(self) -> tuple[Any, ...]:
        return tag, (self.name,)


_SLOTS = [Slot(number) for number in range(64)]
_TAGS = {name: Tag(name) for name in ("ACT", "CALL", "COND", "PAR", "SEQ", "OPT", "ALT", "REP", "LINK")}
ACT, CALL, COND, PAR, SEQ, OPT, ALT, REP, LINK = _TAGS.values()


def slot(number: int) -> Slot:
    """The variable of that number."""
    while number >= len(_SLOTS):
        _SLOTS.append(Slot(len(_SLOTS)))
    return _SLOTS[number]


def tag(name: str) -> Tag:
    """The tag of that name."""
    return _TAGS[name]


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
    if kind is not tuple:
        return term
    for at, part in enumerate(term):
        kind = part.__class__
        if kind is tuple or kind is Slot:
            found = resolve(part, env)
            if found is not part:
                return (*term[:at], found, *[resolve(rest, env) for rest in term[at + 1 :]])
    return term


def moved(term: Any, by: int) -> Any:
    """The term with every slot's number that much higher."""
    kind = term.__class__
    if kind is Slot:
        return slot(term.number + by)
    return tuple([moved(part, by) for part in term]) if kind is tuple else term


def filled(term: Any, frame: list[Any]) -> Any:
    """The term with every slot replaced by what stands at its number."""
    kind = term.__class__
    if kind is Slot:
        return frame[term.number]
    return tuple([filled(part, frame) for part in term]) if kind is tuple else term


def numbered(term: Any, env: Env, names: dict[Slot, Slot]) -> Any:
    """The term resolved, with its open slots numbered in the order in which they are met; ``names`` grows.

    The items of a group without an order are sorted, those of groups within it too, so that it does not matter in which
    order they came about.
    """
    kind = term.__class__
    if kind is Slot:
        term = resolve(term, env)
        kind = term.__class__
        if kind is Slot:
            name = names.get(term)
            if name is None:
                name = names[term] = slot(len(names))
            return name
    if kind is not tuple:
        return term
    if term and term[0] is PAR and not any(term[2]):
        items = sorted(_flat(term, env), key=shape)
        return (PAR, tuple([numbered(item, env, names) for item in items]), (0,) * len(items))
    return tuple([numbered(part, env, names) for part in term])


def _flat(group: Any, env: Env) -> list[Any]:
    """The items of a group without an order, and those of such groups within it."""
    found: list[Any] = []
    for item in group[1]:
        if item[0] is PAR and not any(item[2]):
            found.extend(_flat(item, env))
        else:
            found.append(resolve(item, env))
    return found


_SHAPES: dict[Any, str] = {}


def shape(item: Any) -> str:
    """What an item looks like when its slots are left out."""
    found = _SHAPES.get(item)
    if found is None:
        if len(_SHAPES) > 100_000:
            _SHAPES.clear()
        found = _SHAPES[item] = _shape(item)
    return found


def _shape(item: Any) -> str:
    if item.__class__ is Slot:
        return "_"
    return f"({' '.join(map(_shape, item))})" if item.__class__ is tuple else repr(item)


def slots_of(term: Any, found: dict[Slot, None]) -> dict[Slot, None]:
    """The slots of a term, in the order in which they are met."""
    kind = term.__class__
    if kind is Slot:
        found[term] = None
    elif kind is tuple:
        for part in term:
            slots_of(part, found)
    return found


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
    """A term of the language as one of ours; ``slots`` grows."""
    if isinstance(term, Variable):
        if term not in slots:
            slots[term] = slot(len(slots))
        return slots[term]
    return tuple([inward(part, slots) for part in term]) if isinstance(term, tuple) else term


def outward(term: Any) -> Term:
    """One of our terms as a term of the language."""
    if term.__class__ is Slot:
        return Variable(f"X{term.number + 1}")
    return Compound([outward(part) for part in term]) if term.__class__ is tuple else term
