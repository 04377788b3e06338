"""One state of a base at a time: what was stated, the model of it, and snapshots that no change touches."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from functools import partial, wraps
from threading import RLock
from types import MappingProxyType
from typing import Concatenate, ParamSpec, Self, TypeVar
from weakref import ref

from casper.kb.errors import ProgramError
from casper.kb.reasons.constraints import History
from casper.kb.reasons.says import Words
from casper.kb.reasons.validity import Verdict
from casper.kb.relations.undefined import wholly_unknown
from casper.kb.store.computed import broken, valid
from casper.kb.store.known import MOST_INDEXED, NOTHING, Known, Statement
from casper.kb.store.model import Model
from casper.kb.store.stated import Stated
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.terms import Compound
from casper.kb.top_down.answering import Answering
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.linking import Computed, Rows
from casper.kb.top_down.solve import DEFAULT_BUDGET

NO_HISTORY: History = ()
S = TypeVar("S", bound="Versioned")
P = ParamSpec("P")
R = TypeVar("R")


def of_one_moment(question: Callable[Concatenate[S, P], R]) -> Callable[Concatenate[S, P], R]:
    """A question that is answered from a snapshot: lazily too, and whatever other threads change meanwhile."""

    @wraps(question)
    def asked(self: S, /, *args: P.args, **kwargs: P.kwargs) -> R:
        return question(self.snapshot(), *args, **kwargs)

    return asked


class Versioned:
    """What was stated, and the model worked out of it when it is first needed.

    Several threads may ask while others change it. A change holds ``lock``; a question that takes longer than one look
    holds a `snapshot`, and what a snapshot holds is never changed: the next change is made in a layer over it.
    """

    def __init__(self, clauses: Iterable[Clause] = (), dynamic: Iterable[Indicator] = ()) -> None:
        self._stated = Stated(dict.fromkeys(clauses), set(dynamic))
        self._cached: Model | None = None
        self._known: Known = NOTHING  # stored statements that hold, once they are indexed
        self._false: set[Statement] = set()  # statements that were asked and do not hold
        self._validated: dict[Hashable, list[Compound]] = {}  # answers of valid/1, by what was asked
        self._verdicts: dict[Compound, Verdict] = {}  # of statements of names that were verified before
        self._worded: dict[str, Words] = {}  # the author's sentences, by language
        self._index_in: int | None = 0  # questions until they are
        self.changes = 0  # how often something was added or taken back: what was asked before may be different now
        self.lock = RLock()  # held while anything changes, and while something is looked up that may
        self._view: Callable[[], Self | None] = _nobody  # the snapshot of how it is now, while somebody holds it

    _begun = _ended = 0  # changes: one is under way when these differ
    _below: Versioned | None = None  # the snapshot that an assumption is laid over
    _outside: Mapping[Indicator, Computed] = MappingProxyType({})  # who answers what is offered

    def snapshot(self) -> Self:
        """The knowledge base as it is now, for as long as it is held; it costs microseconds, and cannot be changed.

        Several questions that must see one state are asked of one snapshot; kanren goals, too. Every single question
        sees one state anyway.
        """
        if self._view is _frozen:
            return self
        with self.lock:
            view = self._view()
            if view is None:
                view = object.__new__(type(self))
                view._stated, view._cached, view.changes = self._stated, self._model, self.changes
                view._known, view._false, view._validated = self._known, self._false, self._validated
                view._verdicts, view._worded = self._verdicts, self._worded
                view._index_in, view._view, view.lock = None, _frozen, RLock()
                self._view = ref(view)
            return view

    def _changing(self) -> _Change:
        """While a change is made: nobody else makes one, and nothing that a snapshot holds is in its way.

        Raises:
            ProgramError: this is a snapshot.
        """
        if self._view is _frozen:
            raise ProgramError("a snapshot stays as it is: change the knowledge base, or ask assume(…) what if")
        return _Change(self)

    def _part(self) -> None:
        """Leave everything to the snapshot that has it, and go on with copies and a layer over the model."""
        self._view = _nobody
        self._stated = self._stated.copied()
        if self._cached is not None:
            self._cached = self._cached.apart(self._computed)

    @of_one_moment
    def solver(self, budget: int = DEFAULT_BUDGET, history: History = NO_HISTORY) -> Answering:
        """A fresh search over everything that holds now, after what happened earlier."""
        return self._model.search(history, budget, self._computed)

    @property
    def _computed(self) -> Mapping[Indicator, Computed]:
        unknown = {indicator: Rows(partial(wholly_unknown, indicator)) for indicator in self._stated.offered}
        return {("valid", 1): self._valid, ("never", 1): self._broken, **unknown, **self._outside}

    def offer(self, indicators: Iterable[Indicator]) -> None:
        """Name predicates that somebody outside may answer (`seeing`).

        One that a text asks for and does not define is then no mistake; until somebody answers it is undefined
        whatever it is asked.
        """
        with self._changing():
            self._forget()
            self._stated.offered |= set(indicators)

    @property
    def asks_outside(self) -> frozenset[Indicator]:
        """Those of what is offered that the text names."""
        return self._model.program.outside if self._stated.offered else frozenset()

    def seeing(self, answers: Mapping[Indicator, Rows]) -> Self:
        """The knowledge base as it is now, with what is offered answered by somebody: a snapshot, of microseconds.

        Args:
            answers: by predicate, what makes the relation that has every row an atom can be, the undefined among them.
        """
        view = object.__new__(type(self))
        view.__dict__.update(self.snapshot().__dict__)
        view._false, view._validated, view._verdicts, view.lock = set(), {}, {}, RLock()
        view._outside = {**self._outside, **answers}
        return view

    def _forget(self) -> None:
        """Everything has to be worked out anew."""
        self.changes += 1
        self._cached, self._index_in, self._worded = None, 0, {}
        self._forget_answers()

    def _forget_answers(self) -> None:
        """What was asked before may be different now."""
        self._known, self._false, self._validated, self._verdicts = NOTHING, set(), {}, {}

    @property
    def _model(self) -> Model:
        model = self._cached
        if model is None:
            with self.lock:
                stated = self._stated
                kept = stated.clauses, stated.dynamic, stated.bulk
                more = stated.least, stated.stored, stated.offered
                model = self._cached or Model.of(*kept, self._computed, *more)
                self._cached = model
        return model

    def _valid(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation valid/1; what was found of it in full is kept until something changes."""
        key, kept = variant(atom.args), self._validated
        known = kept.get(key)
        if known is not None:
            yield from known
            return
        found = list[Compound]()
        for answer in valid(atom[1], self._model, self._stated.statements, self.solver):
            if len(found) <= MOST_INDEXED:
                found.append(answer)
            yield answer
        if kept is self._validated and len(found) + len(kept) <= MOST_INDEXED:
            kept[key] = found

    def _broken(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation never/1: the constraints that the facts alone break."""
        return broken(atom, self._model.constraints.always)


class _Change:
    """One change under way; ``with`` it the lock is held, and what a snapshot holds has been left to it."""

    __slots__ = ("base",)

    def __init__(self, base: Versioned) -> None:
        self.base = base

    def __enter__(self) -> None:
        base = self.base
        base.lock.acquire()
        base._begun += 1
        try:
            if base._view() is not None:
                base._part()
        except BaseException:
            self.__exit__()
            raise

    def __exit__(self, *_: object) -> None:
        self.base._ended += 1
        self.base.lock.release()


def _nobody() -> None:
    """No snapshot is held."""


def _frozen() -> None:
    """This is a snapshot itself."""
