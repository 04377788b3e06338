"""Negation: whether nothing proves a goal."""

from __future__ import annotations

from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.compiled.code import Frame, Node
from casper.kb.top_down.linking import DOUBTFUL, STORED
from casper.kb.top_down.running.engine import Verdict, Workspace
from casper.kb.top_down.running.readiness import closed, waiting
from casper.kb.top_down.running.stored import absent
from casper.kb.top_down.running.strands import NESTING, Cont, State, Strand


def negated(work: Workspace, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand) -> State | None:
    """Go on, perhaps doubtful, or fail, or find out first."""
    args = node.build(frame)
    frozen = closed(node, frame, args)
    if frozen is None:
        return waiting(work, node, frame, cont, doubt)
    following = node.next, frame, cont
    link = work.links[node.key]
    if link.how == STORED or link.how == DOUBTFUL:
        return _after(following, doubt, _negation(absent(link, node.key[0], args, frozen)))
    goal = (node.key, variant(frozen))
    if goal in work.verdicts:
        return _after(following, doubt, work.verdicts[goal])
    place = work.in_progress.get(goal, work.open.get(goal))
    if place is not None:
        engine = work.engines[-1]
        engine.low = min(engine.low, place)
        return _after(following, doubt, f"negation runs in a circle through {node.key[0]}/{node.key[1]}")
    strand.node, strand.frame, strand.cont, strand.doubt = (*following, doubt)
    strand.event = NESTING
    work.refute(goal, frozen, strand)
    return None


def _negation(absent: bool | str) -> Verdict:
    return absent if isinstance(absent, str) else not absent


def _after(following: tuple[Node | None, Frame, Cont], doubt: str, verdict: Verdict) -> State | None:
    """What is to be done once the negated goal is decided."""
    if verdict is True:
        return None
    return (*following, doubt or verdict or "")
