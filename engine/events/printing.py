"""How each event is shown to a person: its time, and what happened in a line or a few."""

from __future__ import annotations

import json
from collections.abc import Callable, Container, Iterator, Mapping, Sequence

from casper.engine.events.entries import NAMES, Data, Names, at, under
from casper.engine.events.shares import shares_table
from casper.engine.events.summing import summary_lines
from casper.engine.events.telling import PLAIN, Telling
from casper.kb.text.lines import Line, Role, Span, bar, line

_MOVEMENTS: dict[str, Role] = {
    "still": "faint", "walk": "walk", "transport": "carry", "pick": "grasp", "place": "grasp",
}  # fmt: skip
_SHOWN_FOCUS = 2  # objects of a focus line


def event_lines(kind: str, t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """One event on its own; one of a type that nobody knows, or without its data, is shown as JSON."""
    printer = _PRINTERS.get(kind)
    try:
        found = list(printer(t, data, names)) if printer is not None else []
    except (LookupError, TypeError, ValueError, AttributeError):  # made by hand, with other data
        found = []
    yield from found or [at(t, f"{kind} {json.dumps(dict(data), ensure_ascii=False, default=str)}")]


def opening_lines(domain: str, seed: int, names: Names) -> Iterator[Line]:
    """The heading of a timeline."""
    yield line(Span(domain, "strong"), f", seed {seed}: the robot watches {names.partner}")
    yield line(Span("  time  movement   focus: target and what comes second", "faint"))


def movement_lines(t: float, movement: str, focus: Data) -> Iterator[Line]:
    """A movement, and what it is about."""
    yield at(t, Span(f"{movement:<9}", _MOVEMENTS.get(movement, "plain")), "  ", *_focus_bars(focus))


def verdict_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What was believed to happen, and whether it can have."""
    tell = names.tell
    if data["valid"]:
        so = tell.phrase("so", tell.statement(data["completed"]))
        yield at(
            t,
            Span(f"✔ {tell.statement(data['statement'])}", "good"),
            *([] if data["completed"] == data["statement"] else [Span(f" ({so})", "faint")]),
        )
        return
    denied = tell.denied(data["statement"])
    out: list[str | Span] = [] if denied else [" ", Span(tell.phrase("refused"), "faint")]
    yield at(t, Span(f"✘ {denied or tell.statement(data['statement'])}", "bad"), *out)
    for reason in data["reasons"]:
        yield under(Span(reason, "bad"))


def reading_lines(data: Data, told: Container[str] = ()) -> Iterator[Line]:
    """How many explanations there are, and each goal's share; the reasons against those that were told are left out."""
    plural = "" if data["explanations"] == 1 else "s"
    yield under(Span(f"{data['explanations']} explanation{plural} of {len(data['observations'])} observed", "faint"))
    reasons = {entry["goal"]: entry["reasons"] for entry in data["rejected"]}
    table = shares_table(data["posterior"])
    for name, share in table.shown:
        new = reasons.get(name) and name not in told
        why = [Span(f"  not this: {reasons[name][0]}", "faint")] if new else []
        yield under(f"  {name:<{table.width}}", bar(share), f"{share:5.2f}", *why)
    yield from (under(*spans) for spans in table.rest())


def prediction_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """The goal that the mind commits to."""
    tell = names.tell
    seen = f"{data['observed']} action{'s' if data['observed'] != 1 else ''} seen, {data['missed']} missed"
    if names.words.is_foreign:
        seen = tell.phrase("seen", data["observed"], data["missed"])
    yield at(t, Span(f"★ {tell.phrase('goal', tell.goal(data['goal']))}", "outcome"), f" ({seen})")


def plan_lines(agent: str, waiting: Sequence[str], actions: Sequence[str], tell: Telling = PLAIN) -> Iterator[Line]:
    """What an agent will do, and what it waits for."""
    if tell.is_used:
        yield from _plan_in_words(agent, waiting, actions, tell)
        return
    will = ", then ".join(actions)
    if not will:
        yield line(Span(agent, "strong"), " can do nothing of what is left")
    elif waiting:
        yield line(Span(agent, "strong"), f" waits for {', '.join(waiting)}")
        yield line(f"and will then {will}")
    else:
        yield line(Span(agent, "strong"), f"'s turn: {will}")


def _plan_in_words(agent: str, waiting: Sequence[str], actions: Sequence[str], tell: Telling) -> Iterator[Line]:
    name = Span(tell.name(agent), "strong")
    will = tell.phrase("then").join(tell.step(action, agent) for action in actions)
    if not will:
        yield line(*_around(tell.phrase("nothing", "{0}"), name))
    elif waiting:
        yield line(*_around(tell.phrase("waits", "{0}", ", ".join(map(tell.theirs, waiting))), name))
        yield line(tell.phrase("and then", will))
    else:
        yield line(*_around(tell.phrase("turn", "{0}", will), name))


def _around(phrase: str, name: Span) -> tuple[str, Span, str]:
    """A phrase with a span in it."""
    before, _, after = phrase.partition("{0}")
    return before, name, after


def says_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What the robot says aloud."""
    yield at(t, Span("» ", "outcome"), Span(data["text"], "strong"))


def withdrawn_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What the robot had announced and will not do."""
    tell = names.tell
    told = tell.phrase("withdraws", tell.name(data.get("agent", names.robot)), tell.goal(data["goal"]))
    yield at(t, Span(f"✗ {told}", "warning"))
    yield under(Span(data["because"], "faint"))


def episode_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """How what a partner did for one goal ended."""
    tell = names.tell
    goal = tell.goal(data["goal"]) if data["goal"] else tell.phrase("nobody knows")
    seen = tell.phrase("seen", data["observed"], data["missed"])
    mark = {"finished": Span("● ", "good"), "abandoned": Span("○ ", "warning"), "unclear": Span("○ ", "faint")}
    span = Span(f" ({data['from']:.1f} to {data['to']:.1f} s; {seen})", "faint")
    yield at(t, mark[data["outcome"]], Span(tell.phrase(data["outcome"], goal), "strong"), span)


def robot_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What the robot was asked to do, did, or failed to do."""
    marks = {"asked": Span("▷"), "done": Span("✔", "good"), "failed": Span("✘", "bad"), "stopped": Span("○", "warning")}
    tell, mark = names.tell, marks[data["status"]]
    why = f": {data['reason']}" if data.get("reason") else ""
    told = f"{names.robot} {data['status']} {data['action']}"
    if tell.is_used:
        step = tell.step(data["action"], names.robot)
        told = tell.phrase(f"robot {data['status']}", tell.name(names.robot), step)
    yield at(t, mark, f" {told}{why}")


def _focus(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield at(t, Span(f"{'focus':<9}", "faint"), "  ", *_focus_bars(data))


def _movement(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield at(t, Span(data["movement"], _MOVEMENTS.get(data["movement"], "plain")))


def _action(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield at(t, f"it looks like {data['statement']} ", Span(f"(score {data['score']:.2f})", "faint"))


def _reading(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield at(t, " → ".join(data["observations"]))
    yield from reading_lines(data)


def _plan(t: float, data: Data, names: Names) -> Iterator[Line]:
    first, *rest = plan_lines(data["agent"], data["waiting"], data["actions"], names.tell)
    yield at(t, *first)
    yield from (under(*spans) for spans in rest)


def _warning(t: float, data: Data, names: Names) -> Iterator[Line]:
    yield at(t, Span(f"! {data['message']}", "warning"))


def _focus_bars(focus: Data) -> Iterator[Span]:
    scores: Mapping[str, float] = focus.get("scores", {})
    target, destination = focus.get("target"), focus.get("destination")
    ranked = sorted(scores, key=lambda name: (name != target, name != destination, -scores[name]))
    for place, name in enumerate(ranked[:_SHOWN_FOCUS]):
        role: Role = "strong" if name == target else "plain" if name == destination else "faint"
        yield Span(f"{'  ' if place else ''}")
        yield Span(f"{name:<9}", role)
        yield bar(scores[name], 8)
        yield Span(f"{scores[name]:5.2f}")


_PRINTERS: dict[str, Callable[[float, Data, Names], Iterator[Line]]] = {
    "focus": _focus,
    "movement": _movement,
    "action": _action,
    "verdict": verdict_lines,
    "reading": _reading,
    "prediction": prediction_lines,
    "plan": _plan,
    "says": says_lines,
    "withdrawn": withdrawn_lines,
    "episode": episode_lines,
    "robot": robot_lines,
    "warning": _warning,
    "summary": summary_lines,
}
