"""Scenes for the figures: somebody walks about among things that rest, in a room that grows with their number."""

import numpy as np

from casper import qsr


def walk(steps: int, objects: int, seed: int = 1, hz: float = 10.0) -> qsr.Trace:
    """A trace of somebody who goes straight for a while, stands, and turns, at .6 m/s."""
    numbers = np.random.default_rng(seed)
    side = 2.0 * np.sqrt(objects + 2)
    turns = np.where(numbers.random(steps) < 0.03, numbers.normal(0, 1.2, steps), numbers.normal(0, 0.01, steps))
    heading = (np.cumsum(turns) + np.pi) % (2 * np.pi) - np.pi
    stands = np.cumsum(numbers.random(steps) < 0.02) % 3 == 0
    way = np.stack([np.cos(heading), np.sin(heading)], axis=1) * (0.6 / hz) * ~stands[:, None]
    places = np.empty((steps, objects + 1, 2))
    places[:, 0] = side / 2 - np.abs(np.cumsum(way, axis=0) % (2 * side) - side)
    places[:, 1:] = numbers.uniform(-side / 2, side / 2, (objects, 2))
    headings = np.full((steps, objects + 1), np.nan)
    headings[:, 0] = heading
    names = ["human", *(f"thing{n}" for n in range(objects))]
    sizes = numbers.uniform(0.1, 1, (objects + 1, 2))
    return qsr.Trace.of(np.arange(steps) / hz, names, places, headings=headings, sizes=sizes)


def seen(trace: qsr.Trace) -> list[dict[str, qsr.Body]]:
    """What a stream is given at each step."""
    x, y = (rows.T.tolist() for rows in trace.where)
    headings = np.nan_to_num(trace.heading).T.tolist()
    sizes = [tuple(float(rows[i, 0]) for rows in trace.sizes) for i in range(len(trace.names))]
    return [
        {n: qsr.Body(x[at][i], y[at][i], None, headings[at][i], sizes[i]) for i, n in enumerate(trace.names)}
        for at in range(len(trace))
    ]
