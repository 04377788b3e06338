"""Relations of whole traces: arrays in, arrays out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

import numpy as np

from casper.kb.errors import TraceError
from casper.qsr.arrays.scene import Array, Frames, Scene, pairs_array
from casper.qsr.calculi.calculus import Calculus, Names
from casper.qsr.calculi.table import calculi
from casper.qsr.results.relations import Column, Relations
from casper.qsr.traces.checking import first_place, shown
from casper.qsr.traces.trace import Trace
from casper.qsr.tuples import Related

CELLS = 32_768
"""Tuples times steps that are worked out at once: what fits into a processor's cache."""
MOST = 4_000_000_000
"""Codes that a result may have."""


def relations(
    trace: Trace,
    *named: str | Calculus,
    observer: str | None = None,
    things: Iterable[str] | None = None,
    pairs: Iterable[Sequence[str]] | None = None,
    triples: Iterable[Sequence[str]] | None = None,
    longest_step: float = math.inf,
) -> Relations:
    """The relations of all steps of a trace in the calculi that are named, worked out together.

    Args:
        trace: where things were.
        named: calculi, by name or with settings of their own.
        observer: relates one thing to all others; by default everybody is related to everybody.
        things, pairs, triples: the only ones that are related, in calculi of one, two and three places.
        longest_step: seconds; motion is not taken across a longer one, as across a time at which something is missing.

    Raises:
        TraceError: a calculus or a thing that does not exist, too many tuples, or what a calculus needs is not in the
            trace (a heading, a size).
    """
    chosen, related = calculi(named), Related.of(observer, things, pairs, triples)
    for name in sorted(related.named()):
        trace.index(name)
    if not longest_step > 0.0:
        raise TraceError(f"the longest step is a number of seconds above 0, not {longest_step}")
    columns: dict[str, Column] = {}
    for arity, alike in groupby(sorted(chosen, key=lambda each: each.arity), key=lambda each: each.arity):
        columns |= _columns(trace, tuple(alike), related.tuples(arity, trace.names), longest_step)
    return Relations(trace.t, {each.name: columns[each.name] for each in chosen})


def _columns(trace: Trace, chosen: Sequence[Calculus], of: tuple[Names, ...], longest: float) -> dict[str, Column]:
    place = {name: i for i, name in enumerate(trace.names)}
    if len(of) * len(trace) * len(chosen) > MOST:
        raise TraceError(f"{len(of):,} tuples at {len(trace):,} steps are more than fit; cut the trace, or name fewer")
    codes: dict[str, Array] = {c.name: np.full((len(of), len(trace)), -1, dtype=kind_of(c)) for c in chosen}
    if of and len(trace):
        members = pairs_array([[place[name] for name in row] for row in of])
        for each in chosen:
            check_needs(each, trace, members[0] if each.needs == ("heading",) else np.unique(np.concatenate(members)))
        for start, frames in chunks(trace, max(1, CELLS // len(of)), longest):
            scene = Scene(frames, members)
            for each in chosen:
                block = codes[each.name][:, start : start + len(frames.dt)]
                before = codes[each.name][:, start - 1] if start else np.full(len(of), -1, dtype=np.int8)
                with np.errstate(invalid="ignore"):
                    block[...] = scene.told(each.codes(scene, before), each.motion)
    return {c.name: Column(c.name, c.labels, of, trace.t, codes[c.name]) for c in chosen}


def kind_of(calculus: Calculus) -> type:
    """The smallest integers that hold the codes."""
    return np.int8 if len(calculus.labels) <= 127 else np.int16


def chunks(trace: Trace, steps: int, longest: float = math.inf) -> Iterator[tuple[int, Frames]]:
    """The trace cut into pieces, each with where its first column stands and one column before that.

    Before the first step of a trace nothing is there.
    """
    for start in range(0, len(trace), steps):
        yield start, frames_of(trace, start, min(start + steps, len(trace)), longest)


def frames_of(trace: Trace, start: int, stop: int, longest: float = math.inf) -> Frames:
    """The steps from ``start`` to ``stop``, after the one before."""
    earlier = max(start - 1, 0)
    t = trace.t[earlier:stop]
    dt = np.diff(t) if start else np.concatenate([[1.0], np.diff(t)])
    steady = None if math.isinf(longest) and start else dt <= longest
    if not start and steady is not None:
        steady[0] = False

    def cut(rows: Array) -> Array:
        return rows[:, earlier:stop] if start else np.concatenate([rows[:, :1], rows[:, :stop]], axis=1)

    return Frames(
        where=tuple(cut(rows) for rows in trace.where),
        dt=dt,
        present=None if trace.present is None else cut(trace.present),
        heading=None if trace.heading is None else cut(trace.heading),
        sizes=None if trace.sizes is None else tuple(cut(rows) for rows in trace.sizes),
        held=None if trace.held is None else cut(trace.held),
        steady=steady,
    )


def check_needs(calculus: Calculus, trace: Trace, members: Array) -> None:
    """Refuse a trace that lacks what a calculus is told of.

    Raises:
        TraceError: the sentence names the thing and the time.
    """
    columns: dict[str, tuple[Array, ...] | None] = {
        "heading": None if trace.heading is None else (trace.heading,),
        "size": trace.sizes,
        "z": trace.where[2:] or None,
    }
    for need in calculus.needs:
        word = {"z": "height"}.get(need, need)
        rows = columns[need]
        if rows is None:
            raise TraceError(f"{calculus.name} needs a {word} of {shown([trace.names[i] for i in np.unique(members)])}")
        for row in rows:
            lacks = np.isnan(row[members]) if need != "size" else ~(row[members] > 0.0) | np.isinf(row[members])
            if trace.present is not None:
                lacks &= trace.present[members]
            if lacks.any():
                i, at = first_place(lacks)
                sentence = f"{trace.names[members[i]]} has no {word} at t={trace.t[at]:g}"
                raise TraceError(f"{sentence}, which {calculus.name} needs" + (" (above 0)" if need == "size" else ""))
