"""Tables of a grammar: how few leaves a task takes, what it can begin with, what it can contain, what never ends.

All are by name and arity: parameters and conditions are left out, so what a table rules out is out, and what it allows
may still fail. Sets of actions are bit masks (bit i = ``actions[i]``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from heapq import heappop, heappush
from math import inf

from casper.kb.errors import Place
from casper.kb.terms.clauses import Indicator
from casper.plans.networks.grammar import Call, Grammar, Group, Item, items_below
from casper.plans.trees.nodes import Action, Condition

NEVER = inf  # leaves of what has no end


class Tables:
    """What is known of the tasks of a grammar before anything is seen."""

    def __init__(self, grammar: Grammar) -> None:
        self.grammar = grammar
        self._reached: dict[tuple[Indicator, ...], Mapping[Indicator, Place]] = {}

    # --- how few leaves --------------------------------------------------------------------------------------------

    @cached_property
    def least(self) -> Mapping[Indicator, float]:
        """By task the fewest leaves it can be done with; `NEVER` where every way goes on for ever.

        Knuth's generalisation of Dijkstra's algorithm: tasks are settled from the shortest on.
        """
        settled: dict[Indicator, float] = {}
        mentions, missing = self._mentions()
        heap: list[tuple[float, int, Indicator]] = []
        tasks = {task: number for number, task in enumerate(self.grammar.tasks)}

        def offer(task: Indicator, method: int) -> None:
            found = self.least_of(self.grammar.methods(task)[method].body, settled)
            if found < inf:
                heappush(heap, (found, tasks[task], task))

        for (task, method), count in missing.items():
            if count == 0 or self._has_choices(task, method):
                offer(task, method)
        while heap:
            leaves, _, task = heappop(heap)
            if task in settled:
                continue
            settled[task] = leaves
            for user in mentions.get(task, ()):
                missing[user] -= 1
                if missing[user] == 0 or self._has_choices(*user):
                    offer(*user)
        return {task: settled.get(task, NEVER) for task in tasks}

    def _mentions(self) -> tuple[dict[Indicator, list[tuple[Indicator, int]]], dict[tuple[Indicator, int], int]]:
        """By task the methods that mention it; by method how many tasks it mentions."""
        mentions: dict[Indicator, list[tuple[Indicator, int]]] = {}
        missing: dict[tuple[Indicator, int], int] = {}
        for task, methods in self.grammar.everything.items():
            for number, method in enumerate(methods):
                needed = {x.term.indicator for x in items_below(method.body) if isinstance(x, Call)}
                missing[task, number] = len(needed)
                for other in needed:
                    mentions.setdefault(other, []).append((task, number))
        return mentions, missing

    @cached_property
    def _choosing(self) -> frozenset[tuple[Indicator, int]]:
        """The methods that can be done without some of the tasks they mention."""
        return frozenset(
            (task, number)
            for task, methods in self.grammar.everything.items()
            for number, method in enumerate(methods)
            if _chooses(method.body)
        )

    def _has_choices(self, task: Indicator, method: int) -> bool:
        return (task, method) in self._choosing

    def least_of(self, item: Item, least: Mapping[Indicator, float] | None = None) -> float:
        """The fewest leaves that an item can be done with."""
        least = self.least if least is None else least
        if isinstance(item, Action):
            return 1
        if isinstance(item, Condition):
            return 0
        if isinstance(item, Call):
            return least.get(item.term.indicator, NEVER)
        if item.kind == "optional" or (item.kind == "repeat" and item.least == 0):
            return 0
        found = [self.least_of(each, least) for each in item.items]
        if item.kind == "repeat":
            return item.least * found[0]
        return min(found) if item.kind == "choice" else sum(found)

    def endless(self) -> Iterator[tuple[tuple[Indicator, ...], Place]]:
        """Circles of tasks that can only go on for ever, each once, with the place of the first production in it."""
        told: set[frozenset[Indicator]] = set()
        for task in self.grammar.tasks:
            if self.least[task] == NEVER:
                circle, place = self.circle_of(task)
                if frozenset(circle) not in told:
                    told.add(frozenset(circle))
                    yield circle, place

    def circle_of(self, task: Indicator) -> tuple[tuple[Indicator, ...], Place]:
        """The circle that keeps a task from ending, from its first production in the text on, with that one's place."""
        path: dict[Indicator, None] = {}
        while task not in path:
            path[task] = None
            task = self._endless_item(task)
        around = list(path)[list(path).index(task) :]
        start = min(range(len(around)), key=lambda at: self.number[around[at]])
        circle = (*around[start:], *around[:start])
        return circle, self.grammar.methods(circle[0])[0].place

    @cached_property
    def number(self) -> Mapping[Indicator, int]:
        """Each task's number, in the order of the first productions."""
        return {task: number for number, task in enumerate(self.grammar.tasks)}

    def _endless_item(self, task: Indicator) -> Indicator:
        """A task without an end that the first method of one without an end needs."""
        body = self.grammar.methods(task)[0].body
        needed = (x.term.indicator for x in items_below(body) if isinstance(x, Call))
        return next(other for other in needed if self.least[other] == NEVER)

    # --- which actions ---------------------------------------------------------------------------------------------

    @cached_property
    def actions(self) -> dict[Indicator, Place]:
        """Every action by name and arity, with the place of the first production that names it."""
        found: dict[Indicator, Place] = {}
        for methods in self.grammar.everything.values():
            for method in methods:
                for item in items_below(method.body):
                    if isinstance(item, Action):
                        found.setdefault(item.term.indicator, item.place)
        return found

    @cached_property
    def bit(self) -> dict[Indicator, int]:
        """The bit of each action in the masks."""
        return {action: 1 << number for number, action in enumerate(self.actions)}

    @cached_property
    def contained(self) -> Mapping[Indicator, int]:
        """By task the actions that it can contain."""
        return self._closure(self.contained_in)

    @cached_property
    def first(self) -> Mapping[Indicator, int]:
        """By task the actions that it can begin with while nothing is missed."""
        return self._closure(self.first_of)

    def contained_in(self, item: Item, known: Mapping[Indicator, int] | None = None) -> int:
        """The actions that an item can contain."""
        known = self.contained if known is None else known
        mask = 0
        for each in items_below(item):
            if isinstance(each, Action):
                mask |= self.bit[each.term.indicator]
            elif isinstance(each, Call):
                mask |= known.get(each.term.indicator, 0)
        return mask

    def first_of(self, item: Item, known: Mapping[Indicator, int] | None = None) -> int:
        """The actions that an item can begin with."""
        known = self.first if known is None else known
        if isinstance(item, Action):
            return self.bit[item.term.indicator]
        if isinstance(item, Call):
            return known.get(item.term.indicator, 0)
        if isinstance(item, Condition):
            return 0
        mask = 0
        for number, each in enumerate(item.items):
            if item.kind == "steps" and any(
                self.least_of(item.items[earlier]) for earlier, later in item.order if later == number
            ):
                continue
            mask |= self.first_of(each, known)
            if item.kind in ("sequence", "optional") and self.least_of(each):
                break
        return mask

    @cached_property
    def _from_below(self) -> Sequence[Indicator]:
        """The tasks, each after those that it mentions, but for those that mention it in turn: so work is done once."""
        needs: dict[Indicator, dict[Indicator, None]] = {task: {} for task in self.grammar.tasks}
        for task, users in self._mentions()[0].items():
            for user, _ in users:
                needs[user][task] = None
        found: dict[Indicator, None] = {}
        begun: set[Indicator] = set()
        for start in self.grammar.tasks:
            path = [] if start in begun else [(start, iter(needs[start]))]
            begun.add(start)
            while path:
                task, left = path[-1]
                below = next((other for other in left if other not in begun), None)
                if below is None:
                    found[task] = None
                    path.pop()
                else:
                    begun.add(below)
                    path.append((below, iter(needs[below])))
        return list(found)

    def _closure(self, mask_of: Callable[[Item, Mapping[Indicator, int]], int]) -> Mapping[Indicator, int]:
        """The least masks by task under which every method's is within its task's."""
        masks = dict.fromkeys(self.grammar.tasks, 0)
        mentions, _ = self._mentions()
        order = self._from_below
        rank = {task: at for at, task in enumerate(order)}
        waiting, heap = set(order), list(range(len(order)))  # a sorted list is a heap
        while heap:
            task = order[heappop(heap)]
            waiting.remove(task)
            mask = 0
            for method in self.grammar.methods(task):
                mask |= mask_of(method.body, masks)
            if mask != masks[task]:
                masks[task] = mask
                for user in {user for user, _ in mentions.get(task, ())} - waiting:
                    waiting.add(user)
                    heappush(heap, rank[user])
        return masks

    @cached_property
    def begins(self) -> Mapping[Indicator, int]:
        """By task the mask (by `number`) of the tasks that it can begin with while nothing is missed."""
        return self._closure(self._begun_in)

    def _begun_in(self, item: Item, known: Mapping[Indicator, int]) -> int:
        if isinstance(item, Call):
            return 1 << self.number[item.term.indicator] | known[item.term.indicator]
        if not isinstance(item, Group):
            return 0
        mask = 0
        for number, each in enumerate(item.items):
            if item.kind == "steps" and any(self.least_of(item.items[a]) for a, b in item.order if b == number):
                continue
            mask |= self._begun_in(each, known)
            if item.kind in ("sequence", "optional") and self.least_of(each):
                break
        return mask

    # --- what is reached -------------------------------------------------------------------------------------------

    def reached(self, goals: tuple[Indicator, ...]) -> Mapping[Indicator, Place]:
        """The actions below the goals, in the order in which a reader meets them."""
        known = self._reached.get(goals)
        if known is None:
            known = self._reached[goals] = self._below(goals)
        return known

    def _below(self, goals: tuple[Indicator, ...]) -> dict[Indicator, Place]:
        found: dict[Indicator, Place] = {}
        seen: set[Indicator] = set()
        waiting: list[Item | Indicator] = list(reversed(goals))
        while waiting:
            item = waiting.pop()
            if isinstance(item, Action):
                found.setdefault(item.term.indicator, item.place)
            elif isinstance(item, Group):
                waiting.extend(reversed(item.items))
            elif isinstance(item, (Call, tuple)):
                task = item if isinstance(item, tuple) else item.term.indicator
                if task not in seen:
                    seen.add(task)
                    waiting.extend(method.body for method in reversed(self.grammar.methods(task)))
        return found


def _chooses(item: Item) -> bool:
    if not isinstance(item, Group):
        return False
    free = item.kind in ("choice", "optional") or (item.kind == "repeat" and item.least == 0)
    return free or any(map(_chooses, item.items))
