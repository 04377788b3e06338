"""How people, vehicles and tools of the flood get somewhere: the part of an episode that all goals share."""

from __future__ import annotations

import random

from flood import KINDS


class World:
    """Everything is somewhere; what is needed elsewhere gets there."""

    def __init__(self, seed: int) -> None:
        self.chance = random.Random(seed)
        self.begin()

    def begin(self) -> None:
        """Nothing was done yet, and whatever moves is in some place."""
        movable = [x for kind, names in KINDS.items() if kind not in ("place", "road") for x in names.split()]
        self.actions: list[str] = []
        self.at = {x: self.any("place") for x in movable}

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
