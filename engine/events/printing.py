"""How each event is shown to a person: its time, and what happened in a line or a few."""

from __future__ import annotations

import json
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.kb.text.lines import Line, Role, Span, bar, line

Data: TypeAlias = Mapping[str, Any]
_MOVEMENTS: dict[str, Role] = {
    "still": "faint", "walk": "walk", "transport": "carry", "pick": "grasp", "place": "grasp",
}  # fmt: skip
_SHOWN_FOCUS = 2  # objects of a focus line
MOST_GOALS = 30  # shown with their shares


@dataclass(frozen=True, slots=True)
class Names:
    """What the two agents are called."""

    partner: str = "the partner"
    robot: str = "the robot"


NAMES = Names()


@dataclass(frozen=True, slots=True)
class Shares:
    """The goals that are shown with their shares, how wide their column is, and how many goals there are besides."""

    shown: tuple[tuple[str, float], ...]
    width: int
    left_out: int

    def rest(self) -> Iterator[Line]:
        """A line about the goals that are not shown, if there are any."""
        if self.left_out:
            yield line(Span(f"  … and {self.left_out} goals that are no likelier", "faint"))


def shares_table(posterior: Mapping[str, float], narrowest: int = 12) -> Shares:
    """All goals in their order; of more than `MOST_GOALS` the likeliest, most likely first.

    ``narrowest`` is the least width of the column of goals, with the space behind.
    """
    shown = list(posterior.items())
    if len(shown) > MOST_GOALS:
        shown = sorted(shown, key=lambda pair: -pair[1])[:MOST_GOALS]
    width = max([narrowest, *(len(name) + 1 for name, _ in shown)])
    return Shares(tuple(shown), width, len(posterior) - len(shown))


def event_lines(kind: str, t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """One event on its own; one of a type that nobody knows, or without its data, is shown as JSON."""
    printer = _PRINTERS.get(kind)
    try:
        found = list(printer(t, data, names)) if printer is not None else []
    except (LookupError, TypeError, ValueError, AttributeError):  # made by hand, with other data
        found = []
    yield from found or [_at(t, f"{kind} {json.dumps(dict(data), ensure_ascii=False, default=str)}")]


def opening_lines(domain: str, seed: int, names: Names) -> Iterator[Line]:
    """The heading of a timeline."""
    yield line(Span(domain, "strong"), f", seed {seed}: the robot watches {names.partner}")
    yield line(Span("  time  movement   focus: target and what comes second", "faint"))


def movement_lines(t: float, movement: str, focus: Data) -> Iterator[Line]:
    """A movement, and what it is about."""
    yield _at(t, Span(f"{movement:<9}", _MOVEMENTS.get(movement, "plain")), "  ", *_focus_bars(focus))


def verdict_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What was believed to happen, and whether it can have."""
    if data["valid"]:
        so = [] if data["completed"] == data["statement"] else [Span(f" (so {data['completed']})", "faint")]
        yield _at(t, Span(f"✔ {data['statement']}", "good"), *so)
        return
    yield _at(t, Span(f"✘ {data['statement']}", "bad"), " ", Span("is thrown out", "faint"))
    for reason in data["reasons"]:
        yield _under(Span(reason, "bad"))


def reading_lines(data: Data, told: Container[str] = ()) -> Iterator[Line]:
    """How many explanations there are, and each goal's share; the reasons against those that were told are left out."""
    plural = "" if data["explanations"] == 1 else "s"
    yield _under(Span(f"{data['explanations']} explanation{plural} of {len(data['observations'])} observed", "faint"))
    reasons = {entry["goal"]: entry["reasons"] for entry in data["rejected"]}
    table = shares_table(data["posterior"])
    for name, share in table.shown:
        new = reasons.get(name) and name not in told
        why = [Span(f"  not this: {reasons[name][0]}", "faint")] if new else []
        yield _under(f"  {name:<{table.width}}", bar(share), f"{share:5.2f}", *why)
    yield from (_under(*spans) for spans in table.rest())


def prediction_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """The goal that the mind commits to."""
    seen = f"{data['observed']} action{'s' if data['observed'] != 1 else ''} seen, {data['missed']} missed"
    yield _at(t, Span(f"★ the goal is {data['goal']}", "outcome"), f" ({seen})")


def plan_lines(agent: str, waiting: Sequence[str], actions: Sequence[str]) -> Iterator[Line]:
    """What an agent will do, and what it waits for."""
    will = ", then ".join(actions)
    if not will:
        yield line(Span(agent, "strong"), " can do nothing of what is left")
    elif waiting:
        yield line(Span(agent, "strong"), f" waits for {', '.join(waiting)}")
        yield line(f"and will then {will}")
    else:
        yield line(Span(agent, "strong"), f"'s turn: {will}")


def withdrawn_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What the robot had announced and will not do."""
    yield _at(t, Span(f"✗ {data.get('agent', names.robot)} withdraws its part in {data['goal']}", "warning"))
    yield _under(Span(data["because"], "faint"))


def episode_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """How what a partner did for one goal ended."""
    goal, seen = data["goal"] or "what nobody could tell", f"{data['observed']} seen, {data['missed']} missed"
    mark = {"finished": Span("● ", "good"), "abandoned": Span("○ ", "warning"), "unclear": Span("○ ", "faint")}
    span = Span(f" ({data['from']:.1f} to {data['to']:.1f} s; {seen})", "faint")
    yield _at(t, mark[data["outcome"]], Span(f"{goal} is {data['outcome']}", "strong"), span)


def summary_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What was predicted and done, and whether it was right; of several goals, how each ended."""
    yield from _wanted_lines(t, data, names)
    rows = data.get("episodes", ())
    for row in rows if len(rows) > 1 else ():
        yield _under(f"{row['agent']}: ", Span(row["goal"] or "?", "strong"), f" {row['outcome']} at {row['to']:.1f} s")
    if data.get("goal") is not None and data["robot"]["actions"]:
        done = Span("finished", "good") if data["robot"]["done"] else Span("not finished", "bad")
        yield _under(f"{names.robot}'s part ({', '.join(data['robot']['actions'])}) is ", done)


def _wanted_lines(t: float, data: Data, names: Names) -> Iterator[Line]:
    """What the partner was after, where somebody knows, and what was taken for it."""
    predicted = data["predicted"] or "nothing"
    when = f" at {data['prediction_time']:.1f} s" if data["prediction_time"] is not None else ""
    mark = Span("right", "good") if data.get("correct") else Span("wrong", "bad")
    if data.get("goal") is None:
        yield _at(t, Span(f"predicted {predicted}{when}", "strong"))
    elif data.get("goals"):
        read = ", ".join(row["goal"] or "?" for row in data.get("episodes", ()))
        yield _at(t, Span(f"{names.partner} wanted {', '.join(data['goals'])}; read {read}", "strong"), ": ", mark)
    else:
        wanted = f"{names.partner} wanted {data['goal']}; predicted {predicted}{when}"
        yield _at(t, Span(wanted, "strong"), ": ", mark)


def robot_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What the robot was asked to do, did, or failed to do."""
    mark = {"asked": Span("▷"), "done": Span("✔", "good"), "failed": Span("✘", "bad")}[data["status"]]
    why = f": {data['reason']}" if data.get("reason") else ""
    yield _at(t, mark, f" {names.robot} {data['status']} {data['action']}{why}")


def _focus(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield _at(t, Span(f"{'focus':<9}", "faint"), "  ", *_focus_bars(data))


def _movement(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield _at(t, Span(data["movement"], _MOVEMENTS.get(data["movement"], "plain")))


def _action(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield _at(t, f"it looks like {data['statement']} ", Span(f"(score {data['score']:.2f})", "faint"))


def _reading(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield _at(t, " → ".join(data["observations"]))
    yield from reading_lines(data)


def _plan(t: float, data: Data, names: Names) -> Iterator[Line]:
    first, *rest = plan_lines(data["agent"], data["waiting"], data["actions"])
    yield _at(t, *first)
    yield from (_under(*spans) for spans in rest)


def _warning(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield _at(t, Span(f"! {data['message']}", "warning"))


def _focus_bars(focus: Data) -> Iterator[Span]:
    scores: Mapping[str, float] = focus.get("scores", {})
    target, destination = focus.get("target"), focus.get("destination")
    ranked = sorted(scores, key=lambda name: (name != target, name != destination, -scores[name]))
    for at, name in enumerate(ranked[:_SHOWN_FOCUS]):
        role: Role = "strong" if name == target else "plain" if name == destination else "faint"
        yield Span(f"{'  ' if at else ''}")
        yield Span(f"{name:<9}", role)
        yield bar(scores[name], 8)
        yield Span(f"{scores[name]:5.2f}")


def _at(t: float, *parts: str | Span) -> Line:
    return line(Span(f"{t:6.1f}", "faint"), "  ", *parts)


def _under(*parts: str | Span) -> Line:
    return line("        ", *parts)


_PRINTERS: dict[str, Callable[[float, Data, Names], Iterator[Line]]] = {
    "focus": _focus,
    "movement": _movement,
    "action": _action,
    "verdict": verdict_lines,
    "reading": _reading,
    "prediction": prediction_lines,
    "plan": _plan,
    "withdrawn": withdrawn_lines,
    "episode": episode_lines,
    "robot": robot_lines,
    "warning": _warning,
    "summary": summary_lines,
}
