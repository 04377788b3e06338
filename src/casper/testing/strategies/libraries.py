"""Plans and libraries of one's own actions: every shape that the language has, no task without production."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import strategies as st

from casper.plans.library import PlanLibrary

ACTIONS = ("a(cup)", "a(pot)", "b(cup)", "b(P)", "c(P)", "c(Q)")
SHAPES = ("sequence", "choice", "optional", "unordered", "steps", "repeat")


@st.composite
def plans(
    draw: st.DrawFn,
    label: str = "goal1",
    *,
    actions: Sequence[str] = ACTIONS,
    shapes: Sequence[str] = SHAPES,
    leaves: int = 5,
) -> str:
    """The productions of a goal, as text: ``goal1(P) --> a(cup), optional(b(P)), c(P).``

    Its last step is always done, so it is never empty.

    Args:
        draw: hypothesis'.
        label: the goal's name; it has the parameter P where an action has.
        actions: what its steps are drawn from, with the parameters P and Q.
        shapes: which shapes it may have, of `SHAPES`; with none its steps follow one another.
        leaves: how many steps it has at most, repetitions aside.
    """
    first = draw(_items(tuple(actions), tuple(shapes), leaves - 1, 2)) if leaves > 1 else None
    last = draw(st.sampled_from(list(actions)))
    head = f"{label}(P)" if any("P" in action for action in actions) else label
    return f"{head} --> {', '.join(part for part in (first, last) if part)}."


@st.composite
def libraries(
    draw: st.DrawFn,
    *,
    goals: int = 3,
    actions: Sequence[str] = ACTIONS,
    shapes: Sequence[str] = SHAPES,
    leaves: int = 5,
) -> PlanLibrary:
    """Libraries of up to so many goals, each with one or two productions (arguments: `plans`)."""
    texts: list[str] = []
    for number in range(1, draw(st.integers(1, goals)) + 1):
        ways = 1 + ("choice" in shapes and draw(st.booleans()))
        plan = plans(f"goal{number}", actions=actions, shapes=shapes, leaves=leaves)
        texts.extend(draw(plan) for _ in range(ways))
    return PlanLibrary.from_text("\n".join(texts))


def _items(
    actions: tuple[str, ...], shapes: tuple[str, ...], room: int, depth: int
) -> st.SearchStrategy[str | None]:
    """Nothing, or some steps with at most so many leaves."""
    return st.one_of(st.none(), _item(actions, shapes, room, depth))


@st.composite
def _item(draw: st.DrawFn, actions: tuple[str, ...], shapes: tuple[str, ...], room: int, depth: int) -> str:
    kind = draw(st.sampled_from(["action", *shapes])) if depth and room > 1 else "action"
    if kind == "action":
        return draw(st.sampled_from(list(actions)))
    if kind == "repeat":
        least = draw(st.integers(0, 1))
        return f"repeat({draw(st.sampled_from(list(actions)))}, {least}, {least + draw(st.integers(1, 2))})"
    count = draw(st.integers(1 if kind == "optional" else 2, min(3, room)))
    parts = [draw(_item(actions, shapes, room // count, depth - 1)) for _ in range(count)]
    if kind == "steps":
        return _steps(draw, parts)
    separator = " ; " if kind == "choice" else ", "
    inner = separator.join(parts)
    return f"({inner})" if kind in ("sequence", "choice") else f"{kind}({inner})"


def _steps(draw: st.DrawFn, parts: Sequence[str]) -> str:
    names = "xyz"[: len(parts)]
    pairs = [f"{a} < {b}" for at, a in enumerate(names) for b in names[at + 1 :]]
    order = draw(st.lists(st.sampled_from(pairs), unique=True, max_size=len(pairs)))
    labelled = ", ".join(f"{name}: {part}" for name, part in zip(names, parts))
    return f"steps([{labelled}], [{', '.join(order)}])"
