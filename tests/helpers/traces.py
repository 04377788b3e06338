"""Random traces for the laws of qualitative relations: things come and go, on a grid on which moving them is exact."""

import math

import numpy as np
from hypothesis import strategies as st

from casper import qsr

NAMES = ("ann", "cup", "jug", "pan")
CALCULI = ("qdc", "mos", "qtc_b", "qtc_b11", "qtc_c", "qtc_bc", "cardinal", "egocentric", "tpcc", "relative_distance")
BOXES = ("rectangle", "rcc8", "rcc5", "rcc4", "rcc3", "rcc2")
OF_ALL_KINDS = (
    *CALCULI,
    *BOXES,
    "hold",
    "block",
    qsr.Qdc(margin=0.25, name="qdc_margin"),
    qsr.Qdc((("here", 0.5), ("there", 2.0)), heights=False, name="two_bands"),
    qsr.Mos(qsr.Speed(0.5), margin=qsr.Speed(0.25), heights=True, name="mos_margin"),
    qsr.QtcC(qsr.Speed(0.5), margin=qsr.Speed(0.25), name="qtc_c_margin"),
    qsr.QtcB(qsr.Distance(0.125), "distance", qsr.Distance(0.25), heights=True, name="qtc_b_distance"),
    qsr.QtcB(heights=True, name="qtc_b_space"),
    qsr.Cardinal("projection", 0.25, name="by_projection"),
    qsr.Tpcc(0.5, name="tpcc_tolerance"),
    qsr.Rectangle(0.25, name="rectangle_tolerance"),
    qsr.QtcC(qsr.Distance(0.0), name="any_motion"),
    qsr.QtcB(qsr.Distance(0.125), name="an_eighth"),
    qsr.Mos(qsr.Distance(0.125), name="moves_an_eighth"),
    qsr.Rcc(8, 3, 0.125),
)

eighths = st.integers(-24, 24).map(lambda n: n / 8)


@st.composite
def traces(draw, least=1, most=8, names=NAMES, space=False, gaps=True):
    """A trace with headings and boxes; in space where asked for."""
    steps, things = draw(st.integers(least, most)), len(names)
    axes = 3 if space else 2
    numbers = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    near = draw(st.sampled_from((4, 24)))
    places = numbers.integers(-near, near + 1, (steps, things, axes)) / 8
    rests = numbers.random((steps, things)) < 0.3
    for at in range(1, steps):
        places[at][rests[at]] = places[at - 1][rests[at]]
    present = numbers.random((steps, things)) < (0.8 if gaps else 2)
    hands = [
        [str(names[numbers.integers(things)]) if numbers.random() < 0.3 else None for _ in names] for _ in range(steps)
    ]
    return qsr.Trace.of(
        np.cumsum(numbers.choice([0.25, 0.5, 1.0, 4.0], steps)),
        names,
        places,
        present=present,
        headings=numbers.integers(-9, 10, (steps, things)) / 2,
        sizes=numbers.integers(1, 9, (things, axes)) / 4,
        holding=hands,
    )


def bodies(trace, at):
    """What is seen at one step, as a stream takes it."""
    return {
        name: qsr.Body(
            *(float(rows[i, at]) for rows in trace.where),
            **({} if trace.heading is None else {"heading": float(trace.heading[i, at])}),
            **({} if trace.sizes is None else {"size": tuple(float(rows[i, at]) for rows in trace.sizes)}),
            **({} if trace.held is None or trace.held[i, at] < 0 else {"holding": trace.names[trace.held[i, at]]}),
        )
        for i, name in enumerate(trace.names)
        if trace.present is None or trace.present[i, at]
    }


def changed(
    trace, move=lambda x, y: (x, y), turn=lambda heading: heading, time=lambda t: t, names=None, swap_sides=False
):
    """The same trace with every place, heading, time and name changed."""
    x, y = move(trace.where[0], trace.where[1])
    w, d = trace.sizes[:2]
    return qsr.Trace.of(
        time(trace.t),
        names or trace.names,
        np.nan_to_num(np.stack([x.T, y.T], axis=2)),
        present=None if trace.present is None else trace.present.T,
        headings=turn(trace.heading.T),
        sizes=np.stack([d.T, w.T] if swap_sides else [w.T, d.T], axis=2),
    )


def labels(trace, *calculi, **settings):
    """All labels by calculus and tuple."""
    found = qsr.relations(trace, *calculi, **settings)
    return {(name, row): list(found[name].between(*row)) for name in found for row in found[name].of}


def quarter_turn(x, y):
    return -y, x


def mirrored(x, y):
    return -x, y


QUARTER = math.pi / 2
