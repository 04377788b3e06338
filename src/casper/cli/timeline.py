"""The live timeline: events as lines a person enjoys reading. A line is printed when something changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rich.console import Console

from casper.cli.output import bar, escape
from casper.engine.events import Event

_MOVEMENT_STYLE = {"still": "dim", "walk": "blue", "transport": "magenta", "pick": "yellow", "place": "yellow"}
_SHOWN_FOCUS = 2  # objects of a focus line


class Timeline:
    """Prints events; focus and movement only when target, destination or movement change."""

    def __init__(self, console: Console, partner: str, robot: str) -> None:
        self.out, self.partner, self.robot = console, partner, robot
        self._focus: dict[str, Any] = {}
        self._last: tuple[Any, ...] = ()
        self._ruled_out: set[str] = set()  # goals whose reason was told already
        self._printers: dict[str, Callable[[Event], None]] = {
            "focus": self._note_focus,
            "movement": self._movement,
            "verdict": self._verdict,
            "action": lambda event: None,  # its verdict, or its reading, tells
            "reading": self._reading,
            "prediction": self._prediction,
            "plan": self._plan,
            "robot": self._robot,
            "warning": self._warning,
            "summary": self._summary,
        }

    def open(self, domain: str, seed: int) -> None:
        """The heading."""
        self.out.print(f"[bold]{escape(domain)}[/], seed {seed}: the robot watches {escape(self.partner)}")
        self.out.print("[dim]  time  movement   focus: target and what comes second[/]")

    def show(self, event: Event) -> None:
        """Print one event."""
        self._printers[event.type](event)

    def _line(self, t: float, text: str) -> None:
        self.out.print(f"[dim]{t:6.1f}[/]  {text}")

    def _under(self, text: str) -> None:
        self.out.print(f"        {text}")

    def _note_focus(self, event: Event) -> None:
        self._focus = dict(event.data)

    def _movement(self, event: Event) -> None:
        movement, focus = event.data["movement"], self._focus
        now = (movement, focus.get("target"), focus.get("destination"))
        if now == self._last:
            return
        self._last = now
        style = _MOVEMENT_STYLE.get(movement, "white")
        self._line(event.t, f"[{style}]{escape(f'{movement:<9}')}[/]  {self._focus_bars()}")

    def _focus_bars(self) -> str:
        scores: dict[str, float] = self._focus.get("scores", {})
        target, destination = self._focus.get("target"), self._focus.get("destination")
        ranked = sorted(scores, key=lambda name: (name != target, name != destination, -scores[name]))
        parts = []
        for name in ranked[:_SHOWN_FOCUS]:
            style = "bold" if name == target else "" if name == destination else "dim"
            shown = f"[{style}]{escape(f'{name:<9}')}[/]" if style else f"{escape(f'{name:<9}')}"
            parts.append(f"{shown}[cyan]{bar(scores[name], 8)}[/]{scores[name]:5.2f}")
        return "  ".join(parts)

    def _verdict(self, event: Event) -> None:
        data = event.data
        if data["valid"]:
            filled = "" if data["completed"] == data["statement"] else f" [dim](so {escape(data['completed'])})[/]"
            self._line(event.t, f"[green]✔ {escape(data['statement'])}[/]{filled}")
        else:
            self._line(event.t, f"[red]✘ {escape(data['statement'])}[/] [dim]is thrown out[/]")
            for reason in data["reasons"]:
                self._under(f"[red]{escape(reason)}[/]")

    def _reading(self, event: Event) -> None:
        data = event.data
        plural = "" if data["explanations"] == 1 else "s"
        self._under(f"[dim]{data['explanations']} explanation{plural} of {len(data['observations'])} observed[/]")
        reasons = {entry["goal"]: entry["reasons"] for entry in data["rejected"]}
        for goal, share in data["posterior"].items():
            new = reasons.get(goal) and goal not in self._ruled_out
            why = f"  [dim]not this: {escape(reasons[goal][0])}[/]" if new else ""
            self._under(f"  {escape(f'{goal:<12}')}[cyan]{bar(share)}[/]{share:5.2f}{why}")
        self._ruled_out = set(reasons)

    def _prediction(self, event: Event) -> None:
        data = event.data
        seen = f"{data['observed']} action{'s' if data['observed'] != 1 else ''} seen, {data['missed']} missed"
        self._line(event.t, f"[bold green]★ the goal is {escape(data['goal'])}[/] ({seen})")

    def _plan(self, event: Event) -> None:
        data = event.data
        will = ", then ".join(data["actions"])
        if not will:
            self._line(event.t, f"[bold]{escape(data['agent'])}[/] can do nothing of what is left")
        elif data["waiting"]:
            waits = ", ".join(data["waiting"])
            self._line(event.t, f"[bold]{escape(data['agent'])}[/] waits for {escape(waits)}")
            self._under(f"and will then {escape(will)}")
        else:
            self._line(event.t, f"[bold]{escape(data['agent'])}[/]'s turn: {escape(will)}")

    def _robot(self, event: Event) -> None:
        data, mark = event.data, {"asked": "▷", "done": "[green]✔[/]", "failed": "[red]✘[/]"}[event.data["status"]]
        why = f": {escape(data['reason'])}" if data.get("reason") else ""
        if data["status"] != "asked":
            self._line(event.t, f"{mark} {escape(self.robot)} {data['status']} {escape(data['action'])}{why}")

    def _warning(self, event: Event) -> None:
        self._line(event.t, f"[yellow]! {escape(event.data['message'])}[/]")

    def _summary(self, event: Event) -> None:
        data = event.data
        predicted = data["predicted"] or "nothing"
        when = f" at {data['prediction_time']:.1f} s" if data["prediction_time"] is not None else ""
        if data.get("goal") is None:
            self._line(event.t, f"[bold]predicted {escape(predicted)}{when}[/]")
            return
        mark = "[green]right[/]" if data["correct"] else "[red]wrong[/]"
        wanted = f"{escape(self.partner)} wanted {escape(data['goal'])}; predicted {escape(predicted)}{when}"
        self._line(event.t, f"[bold]{wanted}[/]: {mark}")
        if data["robot"]["actions"]:
            done = "[green]finished[/]" if data["robot"]["done"] else "[red]not finished[/]"
            self._under(f"{escape(self.robot)}'s part ({escape(', '.join(data['robot']['actions']))}) is {done}")
