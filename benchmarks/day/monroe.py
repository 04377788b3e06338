"""Recursive hierarchical domains in the manner of emergency response, made up: a flood, its crews and their vehicles.

    python benchmarks/day/monroe.py [--episodes N] [--kept N] [--seed N] [--missed N]

`domain_text` writes a domain of 12 goals, 39 tasks and 54 methods with typed parameters: to get something to a place a
vehicle gets there first, for which its driver gets to it, for which … `Episodes` makes up what partners do, by carrying
out a goal in a world of places. The figures are of a plain beam: the best so many states are kept, by how few leaves
they miss and how many ways there were to go on; the leading goal has most of the weight.
"""

from __future__ import annotations

import argparse
import random
import statistics
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from casper.engine.domain.domain import Domain
from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.networks import Networks, State
from casper.engine.verification.observation import observation_of

KINDS = {
    "place": "harbour market school hospital mill bridge_head church quarry depot park",
    "road": "quay_road mill_lane ring_road high_street",
    "driver": "ada bo cem dora",
    "medic": "mei noor",
    "labourer": "lou max nia otto",
    "victim": "vic vera walt wim",
    "truck": "truck1 truck2",
    "ambulance": "amb1 amb2",
    "boat": "boat1 boat2",
    "bus": "bus1 bus2",
    "pump": "pump1 pump2",
    "generator": "gen1 gen2",
    "saw": "saw1 saw2",
    "light": "light1 light2",
    "barrier": "bar1 bar2",
    "tank": "tank1 tank2",
    "digger": "digger1 digger2",
}
TYPES = """\
human(X) :- driver(X). human(X) :- medic(X). human(X) :- labourer(X).
robot(rob). agent(X) :- human(X). agent(X) :- robot(X).
person(X) :- human(X). person(X) :- victim(X).
vehicle(X) :- truck(X). vehicle(X) :- ambulance(X). vehicle(X) :- boat(X). vehicle(X) :- bus(X).
tool(X) :- pump(X). tool(X) :- generator(X). tool(X) :- saw(X). tool(X) :- light(X). tool(X) :- barrier(X).
tool(X) :- tank(X). tool(X) :- digger(X).
site(X) :- place(X). site(X) :- road(X).
"""
ACTIONS = {
    "walk": "site", "climb_in": "vehicle", "climb_out": "vehicle", "drive": "vehicle site", "load": "tool vehicle",
    "unload": "tool vehicle", "lift_in": "victim vehicle", "lift_out": "victim vehicle", "bandage": "victim",
    "splint": "victim", "start": "tool", "stop": "tool", "hose": "tool place", "saw_up": "saw road", "drag": "road",
    "tow": "truck road", "sweep": "road", "raise": "tool site", "aim": "light site", "block": "barrier site",
    "sign": "site", "refuel": "tool", "wire": "generator place", "flip": "place", "dig": "digger place",
    "weld": "place", "fill": "tank", "tap": "tank place", "call": "site", "announce": "place", "count": "place",
    "unlock": "place", "warm": "place", "cook": "place", "blanket": "victim",
    "splice": "place", "test_line": "place", "patrol": "site", "find": "victim place", "note": "victim",
    "wash_up": "place",
}  # fmt: skip
PLANS = """\
goal(clear_wreck(R)) :- road(R).
goal(clear_tree(R)) :- road(R).
goal(fix_line(P)) :- place(P).
goal(dry_out(P)) :- place(P).
goal(fix_main(P)) :- place(P).
goal(visit(V)) :- victim(V).
goal(evacuate(P)) :- place(P).
goal(open_shelter(P)) :- place(P).
goal(search(P)) :- place(P).
goal(guard(S)) :- site(S).
goal(run_kitchen(P)) :- place(P).
goal(rescue(V, P)) :- victim(V), place(P).

% to be somewhere: already there, or by way of a vehicle, whose driver must get to it first
get_to(_, _) --> [].
get_to(X, S) --> {human(X), site(S)}, walk(S).
get_to(X, S) --> {human(X), vehicle(V), site(Q), site(S)}, get_to(V, Q), ride(X, V, S).
get_to(V, S) --> {vehicle(V), site(S)}, man(V), drive(V, S).
get_to(T, S) --> {tool(T), truck(V), site(S)}, carry(T, V, S).
ride(_, V, S) --> climb_in(V), get_to(V, S), climb_out(V).
man(_) --> [].
man(V) --> {driver(D), vehicle(V), site(S)}, get_to(D, S), climb_in(V).
carry(T, V, S) --> {truck(V), tool(T), site(Q)}, get_to(V, Q), load(T, V), get_to(V, S), unload(T, V).

clear_wreck(R) --> tow_away(R), close_off(R), optional(tidy(R)).
tow_away(R) --> {truck(T)}, get_to(T, R), tow(T, R).
tidy(R) --> {labourer(L)}, get_to(L, R), sweep(R).
clear_tree(R) --> cut_up(R), drag(R), close_off(R), optional(tidy(R)).
cut_up(R) --> {saw(S)}, get_to(S, R), run(S), saw_up(S, R), optional(stop(S)).
run(T) --> {tool(T)}, fuelled(T), start(T).
fuelled(_) --> [].
fuelled(T) --> refuel(T).

restore_power(P) --> {generator(G), place(P)}, unordered(get_to(G, P), make_safe(P)), connect(P, G).
connect(P, G) --> run(G), wire(G, P), flip(P).
fix_line(P) --> splice(P), restore_power(P), test_line(P).
dry_out(P) --> pump_out(P), heated(P).
guard(S) --> close_off(S), patrol(S).
search(P) --> light_up(P), {victim(V)}, find(V, P).
visit(V) --> treat(V), note(V).
run_kitchen(P) --> wash_up(P), feed(P).
make_safe(_) --> [].
make_safe(P) --> close_off(P).
pump_out(P) --> {pump(T)}, unordered(get_to(T, P), powered(P)), run(T), hose(T, P), optional(stop(T)).
powered(_) --> [].
powered(P) --> restore_power(P).
fix_main(P) --> dig_up(P), repair(P), optional(close_off(P)).
dig_up(P) --> {digger(D)}, get_to(D, P), run(D), dig(D, P).
repair(P) --> weld(P).
repair(P) --> pump_out(P), weld(P).

treat(V) --> {victim(V), place(P)}, medic_there(P), first_aid(V).
medic_there(P) --> {medic(M)}, get_to(M, P).
first_aid(V) --> bandage(V), optional(blanket(V)).
first_aid(V) --> splint(V), bandage(V).
rescue(V, P) --> treat(V), bring(V, P).
bring(V, P) --> {ambulance(A), place(Q)}, get_to(A, Q), lift_in(V, A), get_to(A, P), lift_out(V, A).
bring(V, P) --> {boat(B), place(Q)}, get_to(B, Q), lift_in(V, B), get_to(B, P), lift_out(V, B).

evacuate(P) --> announce(P), all_out(P), close_off(P).
all_out(P) --> fetch(P), count(P).
all_out(P) --> fetch(P), all_out(P).
fetch(P) --> {bus(B), victim(V), place(Q)}, get_to(B, P), lift_in(V, B), get_to(B, Q), lift_out(V, B).
open_shelter(P) --> unlock(P), unordered(heated(P), lit(P), optional(feed(P))).
heated(P) --> warm(P).
heated(P) --> restore_power(P), warm(P).
lit(_) --> [].
lit(P) --> light_up(P).
light_up(S) --> {light(L)}, get_to(L, S), run(L), raise(L, S), aim(L, S).
close_off(S) --> {barrier(B)}, get_to(B, S), block(B, S), optional(sign(S)).
close_off(S) --> call(S), sign(S).
supply_water(P) --> {tank(T)}, fill(T), get_to(T, P), tap(T, P).
feed(P) --> supply_water(P), cook(P).
"""


def domain_text() -> tuple[str, str]:
    """The ontology and the plans."""
    facts = "".join(f"{kind}({name}).\n" for kind, names in KINDS.items() for name in names.split())
    rules = []
    for action, kinds in ACTIONS.items():
        names = "STUVW"[: len(kinds.split())]
        body = ", ".join(["agent(A)", *(f"{kind}({name})" for name, kind in zip(names, kinds.split()))])
        rules.append(f"{action}(A, {', '.join(names)}) :- {body}.\n")
    return facts + TYPES + "".join(rules), PLANS


def domain() -> Domain:
    """The domain, loaded."""
    with tempfile.TemporaryDirectory() as folder:
        ontology, plans = domain_text()
        Path(folder, "ontology.pl").write_text(ontology)
        Path(folder, "plans.pl").write_text(plans)
        return Domain.load(folder)


@dataclass
class Episode:
    """What a partner did, and what for."""

    goal: str
    actions: list[str]


class Episodes:
    """Carries out random goals in a world in which everything is somewhere."""

    def __init__(self, seed: int) -> None:
        self.chance = random.Random(seed)

    def make(self, least: int = 4, most: int = 60) -> Episode:
        """An episode of so many actions."""
        while True:
            self.actions: list[str] = []
            movable = [x for kind, names in KINDS.items() if kind not in ("place", "road") for x in names.split()]
            self.at = {x: self.any("place") for x in movable}
            goal = self.chance.choice(GOALS)
            getattr(self, goal)(*self.parameters(goal))
            if least <= len(self.actions) <= most:
                return Episode(goal, self.actions)

    def parameters(self, goal: str) -> list[str]:
        kinds = {"clear_wreck": ["road"], "clear_tree": ["road"], "visit": ["victim"], "rescue": ["victim", "place"]}
        return [self.any(kind) for kind in kinds.get(goal, ["place"])]

    def any(self, kind: str) -> str:
        return self.chance.choice(KINDS[kind].split())

    def likely(self, share: float) -> bool:
        return self.chance.random() < share

    def do(self, name: str, *args: str) -> None:
        self.actions.append(f"{name}({', '.join(args)})")

    # --- getting somewhere -----------------------------------------------------------------------------------------

    def human_to(self, who: str, site: str, deep: int = 0) -> None:
        if self.at[who] == site:
            return
        if deep >= 2 or self.likely(0.6):
            self.do("walk", site)
        else:
            vehicle = self.any(self.chance.choice(["truck", "bus", "boat", "ambulance"]))
            self.vehicle_to(vehicle, self.at[who], deep + 1)
            self.do("climb_in", vehicle)
            self.vehicle_to(vehicle, site, deep + 1)
            self.do("climb_out", vehicle)
        self.at[who] = site

    def vehicle_to(self, vehicle: str, site: str, deep: int = 0) -> None:
        if self.at[vehicle] == site:
            return
        if self.likely(0.6):
            self.human_to(self.any("driver"), self.at[vehicle], deep + 1)
            self.do("climb_in", vehicle)
        self.do("drive", vehicle, site)
        self.at[vehicle] = site

    def tool_to(self, tool: str, site: str) -> None:
        if self.at[tool] == site:
            return
        truck = self.any("truck")
        self.vehicle_to(truck, self.at[tool])
        self.do("load", tool, truck)
        self.vehicle_to(truck, site)
        self.do("unload", tool, truck)
        self.at[tool] = site

    def run(self, tool: str) -> None:
        if self.likely(0.4):
            self.do("refuel", tool)
        self.do("start", tool)

    # --- goals -----------------------------------------------------------------------------------------------------

    def fix_line(self, place: str) -> None:
        self.do("splice", place)
        self.restore_power(place)
        self.do("test_line", place)

    def dry_out(self, place: str) -> None:
        self.pump_out(place)
        self.heat(place)

    def guard(self, site: str) -> None:
        self.close_off(site)
        self.do("patrol", site)

    def search(self, place: str) -> None:
        self.light_up(place)
        self.do("find", self.any("victim"), place)

    def visit(self, victim: str) -> None:
        self.treat(victim)
        self.do("note", victim)

    def run_kitchen(self, place: str) -> None:
        self.do("wash_up", place)
        self.feed(place)

    def tidy(self, road: str) -> None:
        if self.likely(0.5):
            self.human_to(self.any("labourer"), road)
            self.do("sweep", road)

    def clear_wreck(self, road: str) -> None:
        truck = self.any("truck")
        self.vehicle_to(truck, road)
        self.do("tow", truck, road)
        self.close_off(road)
        self.tidy(road)

    def clear_tree(self, road: str) -> None:
        saw = self.any("saw")
        self.tool_to(saw, road)
        self.run(saw)
        self.do("saw_up", saw, road)
        if self.likely(0.5):
            self.do("stop", saw)
        self.do("drag", road)
        self.close_off(road)
        self.tidy(road)

    def restore_power(self, place: str) -> None:
        generator = self.any("generator")
        safe = self.likely(0.5)
        if safe and self.likely(0.5):
            self.close_off(place)
            safe = False
        self.tool_to(generator, place)
        if safe:
            self.close_off(place)
        self.run(generator)
        self.do("wire", generator, place)
        self.do("flip", place)

    def pump_out(self, place: str) -> None:
        pump = self.any("pump")
        power = self.likely(0.3)
        if power and self.likely(0.5):
            self.restore_power(place)
            power = False
        self.tool_to(pump, place)
        if power:
            self.restore_power(place)
        self.run(pump)
        self.do("hose", pump, place)
        if self.likely(0.5):
            self.do("stop", pump)

    def fix_main(self, place: str) -> None:
        digger = self.any("digger")
        self.tool_to(digger, place)
        self.run(digger)
        self.do("dig", digger, place)
        if self.likely(0.5):
            self.pump_out(place)
        self.do("weld", place)
        if self.likely(0.5):
            self.close_off(place)

    def treat(self, victim: str) -> None:
        self.human_to(self.any("medic"), self.at[victim])
        if self.likely(0.5):
            self.do("splint", victim)
            self.do("bandage", victim)
        else:
            self.do("bandage", victim)
            if self.likely(0.5):
                self.do("blanket", victim)

    def rescue(self, victim: str, place: str) -> None:
        self.treat(victim)
        vehicle = self.any(self.chance.choice(["ambulance", "boat"]))
        self.vehicle_to(vehicle, self.at[victim])
        self.do("lift_in", victim, vehicle)
        self.vehicle_to(vehicle, place)
        self.do("lift_out", victim, vehicle)

    def evacuate(self, place: str) -> None:
        self.do("announce", place)
        for victim in self.chance.sample(KINDS["victim"].split(), self.chance.choice([1, 2, 2, 3])):
            bus = self.any("bus")
            self.vehicle_to(bus, place)
            self.do("lift_in", victim, bus)
            self.vehicle_to(bus, self.any("place"))
            self.do("lift_out", victim, bus)
        self.do("count", place)
        self.close_off(place)

    def open_shelter(self, place: str) -> None:
        self.do("unlock", place)
        parts = [self.heat, *([self.light_up] if self.likely(0.6) else []), *([self.feed] if self.likely(0.5) else [])]
        self.chance.shuffle(parts)
        for part in parts:
            part(place)

    def heat(self, place: str) -> None:
        if self.likely(0.4):
            self.restore_power(place)
        self.do("warm", place)

    def light_up(self, site: str) -> None:
        light = self.any("light")
        self.tool_to(light, site)
        self.run(light)
        self.do("raise", light, site)
        self.do("aim", light, site)

    def close_off(self, site: str) -> None:
        if self.likely(0.3):
            self.do("call", site)
            self.do("sign", site)
            return
        barrier = self.any("barrier")
        self.tool_to(barrier, site)
        self.do("block", barrier, site)
        if self.likely(0.5):
            self.do("sign", site)

    def supply_water(self, place: str) -> None:
        tank = self.any("tank")
        self.do("fill", tank)
        self.tool_to(tank, place)
        self.do("tap", tank, place)

    def feed(self, place: str) -> None:
        self.supply_water(place)
        self.do("cook", place)


GOALS = [line.split("(")[1] for line in PLANS.splitlines() if line.startswith("goal(")]


class Beam:
    """The best states of an episode: weight by state, a share of it for every way in which an observation is taken."""

    def __init__(self, networks: Networks, kept: int, unseen: float = 0.05) -> None:
        self.networks, self.kept, self.unseen, self.seen, self.lost = networks, kept, unseen, 0, 0
        self.weights: dict[State, float] = {networks.begin(goal): 1.0 for goal in range(len(networks.goals))}

    def observe(self, seen: object) -> None:
        """Go on by one observation; where nothing takes it, everything is as it was."""
        after: dict[State, float] = {}
        self.seen += 1
        for state, weight in self.weights.items():
            share = weight / max(1, self.networks.choices(state))
            for step in self.networks.steps(state, seen, None):  # type: ignore[arg-type]
                after[step.state] = after.get(step.state, 0.0) + share * self.unseen**step.missed
        best = sorted(after.items(), key=lambda pair: -pair[1] * self.grown(pair[0]))[: self.kept]
        whole = sum(weight for _, weight in best)
        self.lost += not best
        self.weights = {state: weight / whole for state, weight in best} or self.weights

    def grown(self, state: State) -> float:
        """The share of a plan that was seen: what is long for the little that speaks for it is less likely."""
        return self.seen / (self.seen + self.networks.least_left(state))

    def leading(self) -> str:
        """The goal with most weight."""
        totals: dict[int, float] = {}
        for state, weight in self.weights.items():
            totals[state.goal] = totals.get(state.goal, 0.0) + weight * self.grown(state)
        return self.networks.goals[max(totals, key=totals.__getitem__)]


def networks_of(flood: Domain, missed: int) -> Networks:
    """How its goals go on."""
    library = flood.library
    goals = list(zip(library.goals, [goal for goal, _ in library.goal_terms]))
    return Networks(library.tables, goals, Asking(flood.kb), flood.partner, flood.robot, most_missed=missed)


def measured(networks: Networks, flood: Domain, episodes: list[Episode], kept: int) -> Iterator[tuple[str, object]]:
    """The figures, by name."""
    half = end = lost = 0
    times: list[float] = []
    for episode in episodes:
        beam = Beam(networks, kept)
        for number, action in enumerate(episode.actions, 1):
            seen = observation_of(action, flood.library.actions)
            start = time.process_time()
            beam.observe(seen)
            times.append(time.process_time() - start)
            if number == (len(episode.actions) + 1) // 2:
                half += beam.leading() == episode.goal
        lost += beam.lost > 0
        end += beam.leading() == episode.goal
    times.sort()
    lengths = [len(episode.actions) for episode in episodes]
    yield "episodes", f"{len(episodes)} of {min(lengths)} to {max(lengths)} actions"
    yield "leads at half", f"{half} of {len(episodes)}"
    yield "leads at the end", f"{end} of {len(episodes)}"
    yield "nothing kept took an observation", f"in {lost}"
    yield "an observation, median", f"{statistics.median(times) * 1e3:.1f} ms"
    yield "99 of 100", f"{times[int(0.99 * len(times))] * 1e3:.1f} ms"
    yield "the longest", f"{times[-1] * 1e3:.1f} ms"
    yield "cut", networks.was_cut


def main() -> None:
    """Make episodes, read them, print the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=100)
    parser.add_argument("--kept", type=int, default=50)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--missed", type=int, default=0)
    chosen = parser.parse_args()
    start = time.process_time()
    flood = domain()
    library = flood.library
    print(f"{len(library.goals)} goals, {len(library.tasks)} tasks, {len(library.productions)} methods")
    print(f"loaded in {time.process_time() - start:.2f} s")
    makes = Episodes(chosen.seed)
    episodes = [makes.make() for _ in range(chosen.episodes)]
    for name, figure in measured(networks_of(flood, chosen.missed), flood, episodes, chosen.kept):
        print(f"{name}: {figure}")


if __name__ == "__main__":
    main()
