"""What is said of several things at once: what follows, and whether it can hold (Mackworth 1977; Allen 1983)."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from casper.kb.errors import BudgetExceeded, TraceError
from casper.qsr.reasoning.algebra import Algebra, Relation, Set, bits


@dataclass(frozen=True, slots=True)
class Clash:
    """Three things of which what is said cannot hold at once."""

    one: str
    middle: str
    other: str
    told: frozenset[Relation]
    left: frozenset[Relation]

    def __str__(self) -> str:
        told, left = (" or ".join(sorted(each)) or "nothing" for each in (self.told, self.left))
        return f"{self.one} is {told} {self.other}, but by way of {self.middle} it can only be {left}"


class Network:
    """Things, and sets of base relations of one algebra that may hold between them.

    `close` draws all conclusions of path consistency; they are right, and where the algebra `decides` definite
    relations it finds every contradiction among them.
    """

    def __init__(self, algebra: Algebra) -> None:
        self.algebra = algebra
        self._sets: dict[tuple[str, str], Set] = {}
        self._things: dict[str, None] = {}
        self._said: set[tuple[str, str]] = set()

    @property
    def things(self) -> tuple[str, ...]:
        """In the order in which they were named."""
        return tuple(self._things)

    def add(self, one: str, relations: Relation | Iterable[Relation], other: str) -> None:
        """Say that one of these relations holds; what was said before stays, so only what both say is left.

        Raises:
            TraceError: a name of no relation, or something related to itself otherwise than it must be.
        """
        members = self.algebra.set_of(relations)
        if one == other:
            same = self.algebra.identity
            if same is None or not members >> same & 1:
                raise TraceError(
                    f"{one} is related to itself, and cannot be {' or '.join(sorted(self.algebra.names(members)))}"
                )
            self._things[one] = None
            return
        self._things |= {one: None, other: None}
        self._said.add((one, other))
        self._narrow(one, other, self._between(one, other) & members)

    def between(self, one: str, other: str) -> frozenset[Relation]:
        """What may hold; none if what was said excludes itself."""
        return self.algebra.names(self._between(one, other))

    def _between(self, one: str, other: str) -> Set:
        return self._sets.get((one, other), self.algebra.all)

    def _narrow(self, one: str, other: str, members: Set) -> None:
        self._sets[one, other] = members
        self._sets[other, one] = self.algebra.turned(members)

    def copy(self) -> Network:
        """One that may be changed on its own."""
        made = Network(self.algebra)
        made._sets, made._things, made._said = dict(self._sets), dict(self._things), set(self._said)
        return made

    def close(self) -> Clash | None:
        """Draw all conclusions; the first clash, after which the network says nothing more, or None."""
        for (one, other), members in self._sets.items():
            if not members:
                return Clash(one, one, other, frozenset(), frozenset())
        queue = deque(pair for pair in self._sets)
        waiting = set(queue)
        while queue:
            pair = queue.popleft()
            waiting.discard(pair)
            for one, middle, other in self._paths(*pair):
                left = self.algebra.joined(self._between(one, middle), self._between(middle, other))
                told = self._between(one, other)
                if told & left == told:
                    continue
                if not told & left:
                    return self._clash(one, middle, other, told, left)
                self._narrow(one, other, told & left)
                for changed in ((one, other), (other, one)):
                    if changed not in waiting:
                        waiting.add(changed)
                        queue.append(changed)
        return None

    def _clash(self, one: str, middle: str, other: str, told: Set, left: Set) -> Clash:
        """As it was said: of the one to the other, or the other way round."""
        if (one, other) not in self._said and (other, one) in self._said:
            one, other, told, left = other, one, self.algebra.turned(told), self.algebra.turned(left)
        return Clash(one, middle, other, self.algebra.names(told), self.algebra.names(left))

    def _paths(self, one: str, other: str) -> Iterator[tuple[str, str, str]]:
        for third in self._things:
            if third not in (one, other):
                yield one, other, third
                yield third, one, other

    def scenario(self, budget: int = 10_000) -> Network | None:
        """Definite relations that are left after closing, found by search; None if there are none.

        budget: how many choices may be tried.

        Raises:
            BudgetExceeded: it is not known yet whether there are any.
        """
        begun = self.copy()
        if begun.close() is not None:
            return None
        stack = [(begun, begun._choices())]
        while stack:
            network, choices = stack[-1]
            if choices is None:
                return network
            one, other, members = choices
            if not members:
                stack.pop()
                continue
            if budget <= 0:
                raise BudgetExceeded("the search for definite relations stopped at its budget; give it a larger one")
            budget -= 1
            first = next(bits(members))
            stack[-1] = (network, (one, other, members & ~(1 << first)))
            tried = network.copy()
            tried._narrow(one, other, 1 << first)
            if tried.close() is None:
                stack.append((tried, tried._choices()))
        return None

    def _choices(self) -> tuple[str, str, Set] | None:
        """The pair with the fewest choices left that has more than one."""
        things = self.things
        pairs = ((a, b) for i, a in enumerate(things) for b in things[i + 1 :])
        open_ = [(self._between(a, b).bit_count(), a, b) for a, b in pairs if self._between(a, b).bit_count() > 1]
        if not open_:
            return None
        _, one, other = min(open_)
        return one, other, self._between(one, other)

    def __repr__(self) -> str:
        return f"<Network of {len(self._things)} things in {self.algebra.name}>"
