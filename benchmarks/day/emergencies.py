"""Episodes of the flood: what partners do for a goal that is drawn, and how it is carried out."""

from __future__ import annotations

from dataclasses import dataclass

from crews import World
from flood import GOALS, KINDS


@dataclass
class Episode:
    """What a partner did, and what for."""

    goal: str
    actions: list[str]


class Episodes(World):
    """Carries out random goals, each in a world of its own."""

    def make(self, least: int = 4, most: int = 60) -> Episode:
        """An episode of so many actions."""
        while True:
            self.begin()
            goal = self.chance.choice(GOALS)
            getattr(self, goal)(*self.parameters(goal))
            if least <= len(self.actions) <= most:
                return Episode(goal, self.actions)

    def parameters(self, goal: str) -> list[str]:
        kinds = {"clear_wreck": ["road"], "clear_tree": ["road"], "visit": ["victim"], "rescue": ["victim", "place"]}
        return [self.any(kind) for kind in kinds.get(goal, ["place"])]

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
            self.do("radio", site)
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
