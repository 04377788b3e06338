"""The machine: compiled clauses run on an explicit stack of choice points, tables, and negation as failure.

Goals are worked off depth first; strands of the search take turns (`strands`), so that an endless branch starves no
other. A call of a tabled predicate is worked out once (`tables`). A negation is a search of its own: where nothing
proves its goal and nothing is left to try, it holds. A negation that comes back to a goal that is being refuted is
taken to be *undefined* until something more is known (`engine`), and so is whatever rests on it: answers carry whether
they are certain. What is found that way agrees with the well-founded semantics.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from casper.kb.top_down.compiled.cells import UNBOUND, freeze, frozen_is_ground, undo, unify
from casper.kb.top_down.compiled.code import CALL, COMPARE, NEGATE, Frame, Node
from casper.kb.top_down.linking import STORED, TABLED, Link, Links
from casper.kb.top_down.running.calls import NESTED, negated, retried, special, waiting
from casper.kb.top_down.running.engine import NEGATION, ROOT, Engine, Workspace
from casper.kb.top_down.running.readiness import UNDECIDED, binds_open, compared
from casper.kb.top_down.running.strands import CLAUSES, ROWS, Choice, Strand, split

DEAD, TIRED, ANSWERED, PROVED, NESTING = range(5)  # what ends a strand's turn


class Machine(Workspace):
    """A search over linked predicates.

    Args:
        links: what each predicate is answered by.
        look: called with the steps taken since the last call; it raises when the search has to stop. It gives the
            steps that may follow before the next call.
        floundering_fails: whether a body none of whose conditions can be decided fails instead of raising.
        settled: whether a condition without a value ends the search by what its evaluation raised.
    """

    def __init__(
        self, links: Links, look: Callable[[int], int], floundering_fails: bool = False, settled: bool = False
    ) -> None:
        super().__init__(links, floundering_fails, () if settled else UNDECIDED)
        self.look = look
        self.left = self.granted = 0  # steps until the next look, and how many there were then

    def answers(self, body: Node, frame: Frame) -> Iterator[tuple[Frame, bool]]:
        """Every answer, as a frame like the one given, with whether it is certain.

        Args:
            body: a chain that ends in a STOP node whose sink is `ROOT`.
            frame: with the body's variables as cells.
        """
        self.engines.append(Engine(Strand(body, frame, None)))
        while self.engines:
            engine = self.engines[-1]
            if not engine.queue:
                self.finish(engine)
                continue
            strand = engine.queue.popleft()
            event = self._run(strand, engine)
            if event == TIRED:
                self._rest(strand, engine)
            elif event == ANSWERED:
                engine.queue.appendleft(strand)
                yield self.answer
            elif event == PROVED:
                self.settle(engine, True)

    def _rest(self, strand: Strand, engine: Engine) -> None:
        """Look at the clock; where the strand's turn is over, part it and let the others go on."""
        if self.left <= 0:
            used, self.toil = self.granted - self.left + self.toil + strand.trail.toil, 0
            strand.trail.toil = 0
            self.granted = self.left = self.look(used)
        if strand.turn > 0:
            engine.queue.appendleft(strand)
            return
        oldest = split(strand)
        engine.queue.append(strand)
        if oldest is not None:
            engine.queue.append(oldest)

    # --- the loop --------------------------------------------------------------------------------------------------

    def _run(self, strand: Strand, engine: Engine) -> int:
        """Work on a strand until something happens; what happened."""
        choices, trail, links = strand.choices, strand.trail, self.links
        node, frame, cont, certain, failing = strand.node, strand.frame, strand.cont, strand.certain, strand.failing
        strand.failing = False
        top = choices[-1].serial if choices else 0
        serial, left = self.serial, min(self.left, strand.turn)
        began = left
        candidates: Any = None
        event = DEAD
        while True:
            if failing:
                if not choices:
                    break
                choice = choices[-1]
                if len(trail) > choice.mark:
                    undo(trail, choice.mark)
                cont, certain, kind = choice.cont, choice.certain, choice.kind
                if kind == CLAUSES:
                    choices.pop()
                    top = choices[-1].serial if choices else 0
                    candidates, at, args = choice.what, choice.at, choice.args
                    failing = False
                elif kind == ROWS:
                    top = choice.serial
                    row = next(choice.what, None)
                    if row is None:
                        choices.pop()
                        continue
                    failing = False
                    for column, term in zip(choice.at, choice.args):  # type: ignore[call-overload]
                        if type(term) is list and term[0] is UNBOUND:
                            term[0] = row[column]
                            trail.append(term)
                        elif not unify(term, row[column], trail, top):
                            failing = True
                            break
                    node = None
                else:
                    self.serial = serial
                    found = retried(self, choice, strand)
                    serial = self.serial
                    top = choices[-1].serial if choices else 0
                    if found is not None:
                        failing = False
                        node, frame, cont, certain = found
            elif node is None:
                node, frame, cont = cont  # type: ignore[misc]
                continue
            elif left <= 0:
                event = TIRED
                break
            else:
                left -= 1
                kind = node.kind
                if kind == CALL:
                    link: Link = links[node.key]
                    how = link.how
                    args = node.build(frame)
                    if how < TABLED:  # resolved with its clauses
                        following = node.next
                        if following is not None:
                            cont = (following, frame, cont)
                        procedure = link.what
                        if procedure.fitted is not None:
                            procedure = procedure.fitting(args)
                        if args:
                            first = args[0]
                            while type(first) is list:
                                value = first[0]
                                if value is UNBOUND:
                                    break
                                first = value
                            if type(first) is list:
                                candidates = procedure.all
                            elif isinstance(first, tuple):
                                candidates = procedure.structures.get(first[0], procedure.open)
                            else:
                                candidates = procedure.constants.get(first, procedure.open)
                        else:
                            candidates = procedure.all
                        at = 0
                    elif how == STORED:
                        columns, key, open_, positions = _pattern(args)
                        relation = link.what
                        if not open_:
                            if key in relation:
                                node = node.next
                            else:
                                failing = True
                            continue
                        rows = relation.matching(columns, key)
                        size = len(rows)
                        if size == 0:
                            failing = True
                        elif size == 1:
                            (row,) = rows
                            for column, term in zip(positions, open_):
                                if not unify(term, row[column], trail, top):
                                    failing = True
                                    break
                            node = node.next
                        else:
                            if node.next is not None:
                                cont = (node.next, frame, cont)
                            serial += 1
                            choices.append(
                                Choice(len(trail), serial, certain, ROWS, iter(rows), positions, open_, cont)  # type: ignore[arg-type]
                            )
                            top, failing = serial, True
                        continue
                    else:
                        self.serial, strand.certain = serial, certain
                        found = special(self, link, node, args, frame, cont, strand)
                        serial = self.serial
                        top = choices[-1].serial if choices else 0
                        if found is None:
                            failing = True
                        else:
                            node, frame, cont, certain = found
                        continue
                elif kind == COMPARE:
                    pair = node.build(frame)
                    if node.key[0] == "=" and not node.negated:
                        if unify(pair[0], pair[1], trail, top):
                            node = node.next
                        else:
                            failing = True
                        continue
                    try:
                        held = compared(node, pair, trail, top)
                    except self.undecided:
                        certain = False
                        if binds_open(node, pair):
                            engine.doubtful = failing = True
                        else:
                            node = node.next
                        continue
                    if held:
                        node = node.next
                    elif held is False:
                        failing = True
                    else:
                        node = waiting(self, node, frame)
                        failing = node is None
                    continue
                elif kind == NEGATE:
                    self.serial, strand.certain = serial, certain
                    outcome = negated(self, node, frame, strand)
                    if outcome is None:
                        failing = True
                    elif outcome is NESTED:
                        node, event = node.next, NESTING
                        break
                    else:
                        node, certain = outcome[0], outcome[3]  # type: ignore[index]
                    continue
                else:  # STOP
                    sink = node.sink
                    if sink is ROOT:
                        self.answer = frame, certain
                        event, failing = ANSWERED, True
                        break
                    failing = True
                    if sink is NEGATION:
                        if certain:
                            event = PROVED
                            break
                        engine.uncertain = True
                    else:
                        holes: dict[int, Any] = {}
                        sink.add(tuple([freeze(term, holes) for term in frame[1:]]), certain, engine.queue)
                    continue
            if candidates is not None:  # clauses to be tried: the first whose head matches is taken
                last = len(candidates)
                failing = True
                while at < last:
                    clause = candidates[at]
                    at += 1
                    if at < last:
                        serial += 1
                        newest = serial
                    else:
                        newest = top
                    frame = [serial, *args, *clause.blank]
                    mark = len(trail)
                    for slot, read in clause.matchers:
                        if not read(frame[slot], frame, trail, newest):
                            if len(trail) > mark:
                                undo(trail, mark)
                            break
                    else:
                        if at < last:
                            choices.append(Choice(mark, serial, certain, CLAUSES, candidates, at, args, cont))
                            top = serial
                        for slot in clause.fresh:
                            frame[slot] = [UNBOUND, serial]
                        node, failing = clause.body, False
                        break
                candidates = None
        self.serial = serial
        self.left -= began - left
        strand.turn -= began - left
        strand.node, strand.frame, strand.cont, strand.certain = node, frame, cont, certain
        if event == ANSWERED:
            strand.failing = True
        return event


def _pattern(args: tuple[Any, ...]) -> tuple[tuple[int, ...], tuple[Any, ...], list[Any], list[int]]:
    """Of a look-up's arguments: the columns that are known, their values, the terms that are open, their columns."""
    columns: list[int] = []
    key: list[Any] = []
    open_: list[Any] = []
    positions: list[int] = []
    for at, arg in enumerate(args):
        while type(arg) is list:
            value = arg[0]
            if value is UNBOUND:
                break
            arg = value
        if type(arg) is tuple:
            arg = _known_or_open(arg)
        if type(arg) is list or type(arg) is tuple:
            open_.append(arg)
            positions.append(at)
        else:
            columns.append(at)
            key.append(arg)
    return tuple(columns), tuple(key), open_, positions


def _known_or_open(term: tuple[Any, ...]) -> Any:
    """A compound term without cells, where it is ground."""
    frozen = freeze(term, {})
    return frozen if frozen_is_ground(frozen) else term
