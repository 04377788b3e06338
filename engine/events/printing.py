"""How each event is shown to a person: its time, and what happened in a line or a few."""

from __future__ import annotations

import json
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from casper.engine.events.telling import PLAIN, Telling
from casper.kb.reasons.says import SILENT, Words
from casper.kb.text.lines import Line, Role, Span, bar, line

Data: TypeAlias = Mapping[str, Any]
_MOVEMENTS: dict[str, Role] = {
    "still": "faint", "walk": "walk", "transport": "carry", "pick": "grasp", "place": "grasp",
}  # fmt: skip
_SHOWN_FOCUS = 2  # objects of a focus line
MOST_GOALS = 30  # shown with their shares


@dataclass(frozen=True, slots=True)
class Names:
    """What the two agents are called, and the author's words."""

    partner: str = "the partner"
    robot: str = "the robot"
    words: Words = SILENT  # in which goals, statements and steps are told

    @property
    def tell(self) -> Telling:
        """What tells them."""
        return Telling(self.words, self.partner)


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
    tell = names.tell
    if data["valid"]:
        so = tell.phrase("so", tell.statement(data["completed"]))
        yield _at(
            t,
            Span(f"✔ {tell.statement(data['statement'])}", "good"),
            *([] if data["completed"] == data["statement"] else [Span(f" ({so})", "faint")]),
        )
        return
    denied = tell.denied(data["statement"])
    out: list[str | Span] = [] if denied else [" ", Span(tell.phrase("refused"), "faint")]
    yield _at(t, Span(f"✘ {denied or tell.statement(data['statement'])}", "bad"), *out)
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
    tell = names.tell
    seen = f"{data['observed']} action{'s' if data['observed'] != 1 else ''} seen, {data['missed']} missed"
    if names.words.is_foreign:
        seen = tell.phrase("seen", data["observed"], data["missed"])
    yield _at(t, Span(f"★ {tell.phrase('goal', tell.goal(data['goal']))}", "outcome"), f" ({seen})")


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
    yield _at(t, Span("» ", "outcome"), Span(data["text"], "strong"))


def withdrawn_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What the robot had announced and will not do."""
    tell = names.tell
    told = tell.phrase("withdraws", tell.name(data.get("agent", names.robot)), tell.goal(data["goal"]))
    yield _at(t, Span(f"✗ {told}", "warning"))
    yield _under(Span(data["because"], "faint"))


def episode_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """How what a partner did for one goal ended."""
    tell = names.tell
    goal = tell.goal(data["goal"]) if data["goal"] else tell.phrase("nobody knows")
    seen = tell.phrase("seen", data["observed"], data["missed"])
    mark = {"finished": Span("● ", "good"), "abandoned": Span("○ ", "warning"), "unclear": Span("○ ", "faint")}
    span = Span(f" ({data['from']:.1f} to {data['to']:.1f} s; {seen})", "faint")
    yield _at(t, mark[data["outcome"]], Span(tell.phrase(data["outcome"], goal), "strong"), span)


_FATES = {
    "announced": "announced, and its time never came",
    "asked": "begun, and not ended",
    "dropped": "not needed any more",
    "failed": "given up",
    "stopped": "stopped",
    "taken over": "done by the partner",
    "withdrawn": "withdrawn",
}  # what became of an announced step that the robot has not done


def summary_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What was predicted and done, and whether it was right, of every partner; of several goals, how each ended."""
    rows, partners = data.get("episodes", ()), data.get("partners", ())
    for row in partners:
        theirs = [episode for episode in rows if episode["agent"] == row["agent"]]
        yield from _wanted_lines(t, {**row, "episodes": theirs}, replace(names, partner=row["agent"]))
    if not partners:
        yield from _wanted_lines(t, data, names)
    behaviour = data.get("behaviour") or {"names": [], "told": []}
    if behaviour["names"]:
        yield _under(f"{names.partner} was {', '.join(behaviour['names'])}: {'; '.join(behaviour['told'])}")
    for row in rows if len(rows) > max(1, len(partners)) else ():
        yield _under(f"{row['agent']}: ", Span(row["goal"] or "?", "strong"), f" {row['outcome']} at {row['to']:.1f} s")
    if data.get("goal") is not None and data["robot"]["actions"]:
        done = Span("finished", "good") if data["robot"]["done"] else Span("not finished", "bad")
        part = ", ".join(names.tell.step(action, names.robot) for action in data["robot"]["actions"])
        yield _under(f"{names.tell.name(names.robot)}'s part ({part}) is ", done)
    truth = data.get("truth") or {"help": [], "wrong_interventions": []}
    for step in (step for step in truth["help"] if step["outcome"] != "done"):
        because = f": {step['because']}" if step["because"] else ""
        yield _under(f"{names.tell.step(step['action'], names.robot)} was {_FATES[step['outcome']]}{because}")
    for wrong in truth["wrong_interventions"]:
        yield _under(Span("wrong intervention: ", "bad"), wrong)


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
    marks = {"asked": Span("▷"), "done": Span("✔", "good"), "failed": Span("✘", "bad"), "stopped": Span("○", "warning")}
    tell, mark = names.tell, marks[data["status"]]
    why = f": {data['reason']}" if data.get("reason") else ""
    told = f"{names.robot} {data['status']} {data['action']}"
    if tell.is_used:
        step = tell.step(data["action"], names.robot)
        told = tell.phrase(f"robot {data['status']}", tell.name(names.robot), step)
    yield _at(t, mark, f" {told}{why}")


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
    first, *rest = plan_lines(data["agent"], data["waiting"], data["actions"], names.tell)
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
    "says": says_lines,
    "withdrawn": withdrawn_lines,
    "episode": episode_lines,
    "robot": robot_lines,
    "warning": _warning,
    "summary": summary_lines,
}
