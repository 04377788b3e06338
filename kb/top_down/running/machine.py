"""The machine: compiled clauses run on an explicit stack of choice points, tables, and negation as failure.

Goals are worked off depth first; strands of the search take turns (`strands`), so that an endless branch starves no
other. A call of a tabled predicate is worked out once (`tables`). A negation is a search of its own: where nothing
proves its goal and nothing is left to try, it holds; so is an aggregate, with all answers of its goal. A negation that
comes back to a goal that is being refuted is taken to be *undefined* until something more is known (`engine`), and so
is whatever rests on it, on an undefined row or on a failed evaluation: answers carry what makes them doubtful. What is
found that way agrees with the well-founded semantics.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from casper.kb.terms.values.effort import METER, taken
from casper.kb.top_down.compiled.cells import freeze
from casper.kb.top_down.compiled.code import AGGREGATE, CALL, COMPARE, NEGATE, STOP, Frame, Node
from casper.kb.top_down.compiled.unifying import unify
from casper.kb.top_down.linking import Links
from casper.kb.top_down.running.aggregation import aggregated
from casper.kb.top_down.running.calls import called
from casper.kb.top_down.running.engine import NEGATION, ROOT, Engine, Workspace
from casper.kb.top_down.running.negation import negated
from casper.kb.top_down.running.readiness import UNDECIDED, compared, waiting
from casper.kb.top_down.running.retries import retried
from casper.kb.top_down.running.strands import ANSWERED, DEAD, PROVED, TIRED, Cont, State, Strand, split


class Machine(Workspace):
    """A search over linked predicates.

    Args:
        links: what each predicate is answered by.
        look: called with the steps taken since the last call; it raises when the search has to stop. It gives the
            steps that may follow before the next call.
        floundering_fails: whether a body none of whose conditions can be decided fails instead of raising.
    """

    def __init__(self, links: Links, look: Callable[[int], int], floundering_fails: bool = False) -> None:
        super().__init__(links, look, floundering_fails)
        self.left = self.granted = 0  # steps until the next look, and how many there were then

    def answers(self, body: Node, frame: Frame, doubt: str = "") -> Iterator[tuple[Frame, str]]:
        """Every answer, as a frame like the one given, with what makes it doubtful (else ``""``).

        Args:
            body: a chain that ends in a STOP node whose sink is `ROOT`.
            frame: with the body's variables as cells.
            doubt: what makes the question itself doubtful.
        """
        self.engines.append(Engine(Strand(body, frame, None, doubt)))
        while self.engines:
            outer, METER.look = METER.look, self.look  # what large terms cost is this search's
            try:
                is_answered = self._advance()
            finally:
                METER.look = outer
            if is_answered:
                yield self.answer

    def _advance(self) -> bool:
        """Let one strand have its turn; whether that gave an answer."""
        engine = self.engines[-1]
        if not engine.queue:
            self.finish(engine)
            return False
        strand = engine.queue.popleft()
        event = self._run(strand)
        if event == TIRED:
            self._rest(strand, engine)
        elif event == ANSWERED:
            engine.queue.appendleft(strand)
        elif event == PROVED:
            self.settle(engine, True)
        return event == ANSWERED

    def _rest(self, strand: Strand, engine: Engine) -> None:
        """Look at the clock; where the strand's turn is over, part it and let the others go on."""
        if self.left <= 0:
            self.granted = self.left = self.look(self.granted - self.left)
        if strand.turn > 0:
            engine.queue.appendleft(strand)
            return
        oldest = split(strand)
        engine.queue.append(strand)
        if oldest is not None:
            engine.queue.append(oldest)

    def _run(self, strand: Strand) -> int:
        """Work on a strand until something happens; what happened."""
        state = None if strand.failing else (strand.node, strand.frame, strand.cont, strand.doubt)
        strand.failing, strand.event = False, DEAD
        began = left = min(self.left, strand.turn)
        while True:
            if state is None:
                if strand.event or not strand.choices:
                    break
                state = retried(self, strand)
                continue
            node, frame, cont, doubt = state
            while node is None:
                node, frame, cont = cont  # type: ignore[misc]
            if left <= 0:
                strand.node, strand.frame, strand.cont, strand.doubt = node, frame, cont, doubt
                strand.event = TIRED
                break
            left -= 1
            state = _INSTRUCTIONS[node.kind](self, node, frame, cont, doubt, strand)
        if METER.parts:
            self.left -= taken()
        self.left -= began - left
        strand.turn -= began - left
        return strand.event


def _comparing(work: Workspace, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand) -> State | None:
    pair = node.build(frame)
    if node.key[0] == "=" and not node.negated:
        return (node.next, frame, cont, doubt) if unify(pair[0], pair[1], strand.trail, strand.top) else None
    try:
        held = compared(node, pair, strand.trail, strand.top)
    except UNDECIDED as reason:
        return node.next, frame, cont, doubt or reason.sentence
    if held is None:
        return waiting(work, node, frame, cont, doubt)
    return (node.next, frame, cont, doubt) if held else None


def _stopped(work: Workspace, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand) -> State | None:
    """An answer of the question, of a negated goal, or of a table."""
    sink = node.sink
    if sink is ROOT:
        work.answer = frame, doubt
        strand.event, strand.failing = ANSWERED, True
    elif sink is NEGATION:
        if not doubt:
            strand.event = PROVED
        else:
            work.engines[-1].doubt = work.engines[-1].doubt or doubt
    else:
        holes: dict[int, object] = {}
        sink.add(tuple([freeze(term, holes) for term in frame[1:]]), doubt, work.engines[-1].queue)  # type: ignore[arg-type]
    return None


_Instruction = Callable[[Workspace, Node, Frame, Cont, str, Strand], "State | None"]
_TABLE: dict[int, _Instruction] = {
    CALL: called,
    COMPARE: _comparing,
    NEGATE: negated,
    AGGREGATE: aggregated,
    STOP: _stopped,
}
_INSTRUCTIONS = tuple(_TABLE[kind] for kind in range(len(_TABLE)))
