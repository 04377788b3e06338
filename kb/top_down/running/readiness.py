"""When a condition can be decided: comparisons, negations and built-ins wait until what they need is known."""

from __future__ import annotations

from typing import Any

from casper.kb.errors import ProgramError, Undefined
from casper.kb.terms.clauses import AGGREGATE as AGGREGATE_NAME
from casper.kb.terms.clauses import Literal
from casper.kb.terms.comparison import compare
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import renamed
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.terms.values.sizes import check_large
from casper.kb.text.writer import literal_text
from casper.kb.top_down.builtins.control import REFUTED
from casper.kb.top_down.compiled.cells import Trail, deref, freeze, fresh_variable, has_rigid
from casper.kb.top_down.compiled.code import AGGREGATE, CALL, COMPARE, NEGATE, STOP, Frame, Node
from casper.kb.top_down.compiled.unifying import is_ground, unify
from casper.kb.top_down.linking import BUILT_IN, CONTROLLED, Links
from casper.kb.top_down.running.engine import Workspace
from casper.kb.top_down.running.strands import Cont, State

UNDECIDED = (Undefined, EvaluationFailed)  # what evaluating raises where a condition is neither true nor false
_VALUE = Variable("_#value")
_ORDER = {"<": int.__lt__, ">": int.__gt__, "=<": int.__le__, ">=": int.__ge__}
_SAME = {"=": True, "==": True, "\\=": False, "\\==": False}  # of ground terms
_SUMS = {"+": int.__add__, "-": int.__sub__, "*": int.__mul__}
_SMALL = 10**9  # below it neither a sum nor a product comes near any limit


def waiting(work: Workspace, node: Node, frame: Frame, cont: Cont, doubt: str) -> State | None:
    """What is done first while a condition has to wait; what cannot be decided beside something undefined is, too.

    Raises:
        ProgramError: nothing makes it ready; unless such a body is to fail.
    """
    found = later(node, frame, work.links)
    if found is not None:
        return found, frame, cont, doubt
    if doubt:
        last = node.chain()[-1]
        return last if last.kind == STOP else None, frame, cont, doubt
    if not work.floundering_fails:
        raise floundering(node, frame)
    return None


def compared(node: Node, pair: tuple[Any, Any], trail: Trail, top: int) -> bool | None:
    """Whether a comparison other than ``=`` holds (``is`` binds its left side); None while it has to wait.

    Raises:
        EvaluationFailed: it has no value.
    """
    left, right = deref(pair[0]), deref(pair[1])
    negated, operator = node.negated, node.key[0]
    if operator == "is" and not negated:
        value = _quick(right)
        if value is not None:
            return unify(left, value, trail, top)
    elif type(left) is int and type(right) is int and operator in _ORDER:
        return _ORDER[operator](left, right) is not negated
    if not is_ground(right):
        return None
    if operator == "is" and not negated:
        found = compare(Literal(Compound(("is", _VALUE, _evaluable(right)))), {})
        return found is not None and unify(left, found[_VALUE], trail, top)
    if not is_ground(left):
        return None
    if operator in _SAME:
        return unify(left, right, trail, top) is (_SAME[operator] is not negated)
    return compare(Literal(Compound((operator, _evaluable(left), _evaluable(right))), negated), {}) is not None


def _evaluable(term: Any) -> Any:
    """A ground term that is looked at as a tree: as it is copied, or now, it is refused where that would never end."""
    frozen = freeze(term, {})
    if type(frozen) is Compound:
        check_large(frozen)
    return frozen


def _quick(term: Any) -> int | None:
    """The value of a small integer, or of a sum or product of two."""
    if type(term) is int:
        return term if -_SMALL < term < _SMALL else None
    if isinstance(term, tuple) and len(term) == 3 and term[0] in _SUMS:
        left, right = deref(term[1]), deref(term[2])
        if type(left) is int and type(right) is int and -_SMALL < left < _SMALL and -_SMALL < right < _SMALL:
            return _SUMS[term[0]](left, right)
    return None


def later(node: Node, frame: Frame, links: Links) -> Node | None:
    """The chain from a node that has to wait, begun with the first after it that can be decided; None without any."""
    for at, other in enumerate(node.chain()):
        if at and other.kind == STOP:
            return None
        if at and is_ready(other, frame, links):
            return node.starting_with(at)
    return None


def is_ready(node: Node, frame: Frame, links: Links) -> bool:
    """Whether a condition can be decided now."""
    args = node.build(frame)
    if node.kind == CALL:
        link = links[node.key]
        if link.how == BUILT_IN:
            return bool(link.what.ready(*map(deref, args)))
        return link.how != CONTROLLED or _control_is_ready(link.what, args, links)
    if node.kind == COMPARE:
        return _comparable(node.key[0], node.negated, args)
    if node.kind == AGGREGATE:
        return open_of(node, frame, *args[:2]) is not None
    return closed(node, frame, args) is not None


def _comparable(operator: str, negated: bool, args: tuple[Any, ...]) -> bool:
    if negated or operator not in ("=", "is"):
        return all(map(is_ground, args))
    return operator == "=" or is_ground(args[1])


def goal_is_ready(args: tuple[Any, ...], links: Links) -> bool:
    """Whether a goal that is a term is known, and can be decided."""
    goal = deref(args[0])
    if not isinstance(goal, (str, tuple)):
        return type(goal) is not list  # a number is no goal, and that is told
    name, inner = (goal[0], (*goal[1:], *args[1:])) if isinstance(goal, tuple) else (goal, args[1:])
    if (name, len(inner)) in (("\\+", 1), ("not", 1), ("forall", 2)):
        return all(map(is_ground, inner))
    if (name, len(inner)) in ((AGGREGATE_NAME, 3), ("findall", 3)):
        own: dict[int, Variable] = {}
        freeze(inner[0], own)
        size = len(own)
        freeze(inner[1], own)
        return len(own) == size
    if len(inner) == 2 and name in COMPARISONS:
        return _comparable(name, False, inner)
    if name in (",", ";", "->"):
        return True
    link = links[name, len(inner)]
    if link.how == BUILT_IN:
        return bool(link.what.ready(*map(deref, inner)))
    return link.how != CONTROLLED or _control_is_ready(link.what, inner, links)


def _control_is_ready(what: object, args: tuple[Any, ...], links: Links) -> bool:
    if what == REFUTED:
        return is_ground(args[0])
    return isinstance(what, bool) or goal_is_ready(args, links)


def closed(node: Node, frame: Frame, args: tuple[Any, ...]) -> tuple[Any, ...] | None:
    """A negation's arguments, frozen; None while anything is open in them but its own wildcards."""
    holes: dict[int, Variable] = {}
    frozen = tuple([freeze(arg, holes) for arg in args])
    if holes:
        own = {id(deref(frame[slot])) for slot in node.own}
        if not own.issuperset(holes):
            return None
    return None if any(map(has_rigid, frozen)) else frozen


def open_of(node: Node, frame: Frame, what: Any, atom: Any) -> dict[int, Variable] | None:
    """The open variables of an aggregate's goal, by the cells; None while others than its own are among them.

    Its own are the clause's wildcards. Of a goal that is known only when it is called, they are those of what is
    worked out: any other may be somebody else's, and become known later.
    """
    own: dict[int, Variable] = {}
    if node.literal is None:
        freeze(what, own)
    else:
        for slot in node.own:
            cell = deref(frame[slot])
            if type(cell) is list:
                own.setdefault(id(cell), fresh_variable())
    size = len(own)
    frozen = freeze(atom, own)
    return own if len(own) == size and not has_rigid(frozen) else None


def floundering(node: Node, frame: Frame) -> ProgramError:
    """That a condition cannot be decided, in the words of its author."""
    names: dict[int, Variable] = {}
    literal = node.literal
    if literal is not None and literal.shown is not None:
        return _undecidable(literal_text(literal), literal)
    args = tuple(freeze(arg, names, Compound) for arg in node.build(frame))
    if literal is not None:
        args = literal.atom.args if not names else _named(literal, args)
    negated = node.kind == NEGATE or node.negated
    return _undecidable(literal_text(Literal(Compound((node.key[0], *args)), negated)), literal)


def _undecidable(text: str, literal: Literal | None) -> ProgramError:
    place = literal.place if literal is not None and literal.place.line else None
    return ProgramError(f"{text} cannot be decided: bind its variables by a condition before it", place)


def _named(literal: Literal, args: tuple[Any, ...]) -> tuple[Any, ...]:
    """The arguments, open ones by the names their author gave them."""
    [shown] = renamed([Compound((literal.atom[0], *args))], 0)
    given = renamed([literal.atom], 0)[0]
    return tuple(_name(part, by) for part, by in zip(shown.args, given.args))


def _name(part: Any, by: Any) -> Any:
    if isinstance(part, Variable):
        return by if isinstance(by, Variable) else part
    if isinstance(part, Compound) and isinstance(by, Compound) and len(part) == len(by):
        return Compound([part[0], *(_name(p, b) for p, b in zip(part.args, by.args))])
    return part
