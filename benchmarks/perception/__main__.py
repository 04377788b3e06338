"""Steps a second of qualitative relations: whole traces, a step at a time, pair by pair, with equal answers checked.

    python benchmarks/perception [--quick]

Seconds are the processor's, the least of three runs. The last two columns of the first table add the focus of
attention: QDC, QTC_B of the observer, MOS, angles, shares, target and destination.
"""

import argparse
import gc
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from reference import check, pair_by_pair
from scenes import seen, walk

from casper import qsr
from casper.engine.perception.focus import FocusEstimator, FocusSettings
from casper.engine.perception.perception import Perception, PerceptionSettings
from casper.engine.perception.recorded import recorded
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.qsr.calculi.table import CALCULI, calculus

SET = ("qdc", "qtc_b", "mos")
SIZES = ((7, 200_000), (100, 20_000), (1_000, 2_000), (10_000, 200))
PROMISES = {("focus", 7): 1_000_000, ("focus", 10_000): 500, ("focus stream", 7): 50_000, ("stream", 7): 50_000}


def seconds(run: Callable[[], object], times: int = 3) -> float:
    best = float("inf")
    for _ in range(times):
        gc.collect()
        began = time.process_time()
        run()
        best = min(best, time.process_time() - began)
    return best


def streamed(names: tuple[str, ...], t: list[float], steps: list) -> list:
    stream = qsr.Stream(*names, observer="human")
    return [stream.update(at, now) for at, now in zip(t, steps)]


def attended(worlds: list[WorldState]) -> list:
    perception, focus = Perception(PerceptionSettings(), "human"), FocusEstimator(FocusSettings())
    return [focus.update(perception.update(world)) for world in worlds]


def worlds_of(trace: qsr.Trace, steps: list) -> list[WorldState]:
    return [
        WorldState(
            t,
            {"human": AgentState(now["human"].x, now["human"].y, now["human"].heading)},
            {name: ObjectState(body.x, body.y) for name, body in now.items() if name != "human"},
        )
        for t, now in zip(trace.t.tolist(), steps)
    ]


def check_focus(trace: qsr.Trace, steps: list) -> None:
    found = recorded(trace, "human", PerceptionSettings(), FocusSettings())
    names = [*found.objects, None]
    for at, focus in enumerate(attended(worlds_of(trace, steps))):
        assert (focus.target, focus.destination) == (names[found.target[at]], names[found.destination[at]]), at


def row(objects: int, steps: int) -> dict[str, float]:
    """Steps a second of each way for one number of objects; all answers are compared."""
    few = max(2, min(steps, 14_000 // objects))
    trace, short = walk(steps, objects), walk(few, objects)
    bodies, t = seen(short), short.t.tolist()
    calculi = [calculus(name) for name in SET]
    told = pair_by_pair(calculi, t, bodies, "human")
    check(qsr.relations(short, *SET, observer="human"), told)
    assert streamed(SET, t, bodies) == told
    check_focus(short, bodies)
    worlds = worlds_of(short, bodies)
    return {
        "pair by pair": few / seconds(lambda: pair_by_pair(calculi, t, bodies, "human")),
        "stream": few / seconds(lambda: streamed(SET, t, bodies)),
        "batch": steps / seconds(lambda: qsr.relations(trace, *SET, observer="human")),
        "focus stream": few / seconds(lambda: attended(worlds)),
        "focus": steps / seconds(lambda: recorded(trace, "human", PerceptionSettings(), FocusSettings())),
    }


def each_calculus(objects: int, steps: int) -> None:
    """One line a calculus: steps a second, an observer to all others."""
    trace, short = walk(steps, objects), walk(400, objects)
    bodies, t = seen(short), short.t.tolist()
    print(f"\n{'calculus, 7 objects':<20}{'pair by pair':>14}{'stream':>12}{'batch':>14}{'batch is':>10}")
    for name in CALCULI:
        if name == "block":
            continue  # needs heights
        told = pair_by_pair([calculus(name)], t, bodies, "human")
        check(qsr.relations(short, name, observer="human"), told)
        assert streamed((name,), t, bodies) == told
        plain = len(t) / seconds(lambda name=name: pair_by_pair([calculus(name)], t, bodies, "human"))
        stream = len(t) / seconds(lambda name=name: streamed((name,), t, bodies))
        batch = steps / seconds(lambda name=name: qsr.relations(trace, name, observer="human"))
        print(f"{name:<20}{plain:14,.0f}{stream:12,.0f}{batch:14,.0f}{batch / plain:9,.0f}x")


def main() -> int:
    """Print the tables; exit code 1 when a promise is not kept."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a fiftieth of the steps")
    quick = parser.parse_args().quick
    print("steps a second, QDC + QTC_B + MOS of an observer to all objects; answers are equal in every column")
    heads = ("pair by pair", "stream", "batch", "focus stream", "focus")
    print(f"{'objects':>8}" + "".join(f"{head:>14}" for head in heads))
    kept = True
    for objects, steps in SIZES:
        figures = row(objects, max(steps // 50, 4) if quick else steps)
        print(f"{objects:8,d}" + "".join(f"{figures[head]:14,.0f}" for head in heads))
        for (head, at), promised in PROMISES.items():
            if at == objects and figures[head] < promised:
                kept = False
                print(f"         promised: {promised:,} ({head}); NOT kept")
    each_calculus(7, 2_000 if quick else 50_000)
    return 0 if kept or quick else 1


if __name__ == "__main__":
    sys.exit(main())
