"""Qualitative spatial relations of traces (docs/qsr.md): a library on its own, of numpy and nothing else.

In: where things were, as arrays, rows, data frames, CSV or Parquet; or a step at a time. Out: relations, as codes with
labels and times, and their episodes. Beside them the algebra of the calculi: converses, compositions, neighbours, and
whether what is said of several things can hold at once.

    from casper import qsr
    trace = qsr.Trace.of(t, ["human", "plate"], places)                 # (T,), names, (T, N, 2)
    found = qsr.relations(trace, "qdc", "qtc_b", "mos", observer="human")
    found["qdc"].between("human", "plate")                              # ['far', 'far', 'near', …]
    stream = qsr.Stream("qdc", "qtc_b", observer="human")
    stream.update(0.0, {"human": (0, 0), "plate": (1, 2)})              # {'qdc': {('human', 'plate'): 'medium'}, …}

``import casper.qsr`` is light: numpy is loaded by what needs it, and the plain kernels do not.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from casper.qsr.batch import relations as relations
    from casper.qsr.calculi.calculus import Body as Body
    from casper.qsr.calculi.directions import Cardinal as Cardinal
    from casper.qsr.calculi.directions import Egocentric as Egocentric
    from casper.qsr.calculi.directions import Tpcc as Tpcc
    from casper.qsr.calculi.distances import Qdc as Qdc
    from casper.qsr.calculi.distances import RelativeDistance as RelativeDistance
    from casper.qsr.calculi.hand import Hold as Hold
    from casper.qsr.calculi.motion import Mos as Mos
    from casper.qsr.calculi.motion import QtcB as QtcB
    from casper.qsr.calculi.motion import QtcB11 as QtcB11
    from casper.qsr.calculi.motion import QtcBC as QtcBC
    from casper.qsr.calculi.motion import QtcC as QtcC
    from casper.qsr.calculi.regions import Block as Block
    from casper.qsr.calculi.regions import Rcc as Rcc
    from casper.qsr.calculi.regions import Rectangle as Rectangle
    from casper.qsr.reasoning.algebra import Algebra as Algebra
    from casper.qsr.reasoning.network import Clash as Clash
    from casper.qsr.reasoning.network import Network as Network
    from casper.qsr.reasoning.table import algebra as algebra
    from casper.qsr.results.episodes import Episode as Episode
    from casper.qsr.results.episodes import collapse as collapse
    from casper.qsr.results.episodes import validate as validate
    from casper.qsr.results.intervals import allen as allen
    from casper.qsr.results.relations import Column as Column
    from casper.qsr.results.relations import Relations as Relations
    from casper.qsr.stream import Stream as Stream
    from casper.qsr.thresholds import Distance as Distance
    from casper.qsr.thresholds import Speed as Speed
    from casper.qsr.traces.reading import from_pandas as from_pandas
    from casper.qsr.traces.reading import from_rows as from_rows
    from casper.qsr.traces.reading import read_csv as read_csv
    from casper.qsr.traces.reading import read_parquet as read_parquet
    from casper.qsr.traces.trace import Trace as Trace

_HOMES = {
    "reasoning.algebra": ("Algebra",),
    "reasoning.network": ("Clash", "Network"),
    "reasoning.table": ("algebra",),
    "batch": ("relations",),
    "calculi.calculus": ("Body",),
    "calculi.directions": ("Cardinal", "Egocentric", "Tpcc"),
    "calculi.distances": ("Qdc", "RelativeDistance"),
    "calculi.hand": ("Hold",),
    "calculi.motion": ("Mos", "QtcB", "QtcB11", "QtcBC", "QtcC"),
    "calculi.regions": ("Block", "Rcc", "Rectangle"),
    "results.episodes": ("Episode", "collapse", "validate"),
    "results.intervals": ("allen",),
    "results.relations": ("Column", "Relations"),
    "stream": ("Stream",),
    "thresholds": ("Distance", "Speed"),
    "traces.reading": ("from_pandas", "from_rows", "read_csv", "read_parquet"),
    "traces.trace": ("Trace",),
}
_PLACES = {name: home for home, names in _HOMES.items() for name in names}
__all__ = sorted(_PLACES)


def __getattr__(name: str) -> Any:
    if name in _PLACES:
        return getattr(import_module(f"casper.qsr.{_PLACES[name]}"), name)
    raise AttributeError(f"module 'casper.qsr' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_PLACES)
