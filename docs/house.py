"""Draws the house of docs/architecture.md from the layers that import-linter holds: docs/house.svg.

    python docs/house.py

Each room shows how many files it has; an arrow goes to the house on whose ground one stands. Nothing here is typed:
rooms that change change the picture.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parent.parent
HOUSES = {
    "kb": "the logic",
    "plans": "the plan library",
    "engine": "the mind",
    "sim_adapter": "MuJoCo",
    "casper": "doors for other programs",
    "cli": "the command line",
}
FOLDERS = {"casper": ROOT / "src" / "casper", "cli": ROOT / "src" / "casper" / "cli"}
COLOURS = {
    "kb": "#cfe3f5",
    "plans": "#d9ead3",
    "engine": "#fde9c9",
    "sim_adapter": "#f5d5d0",
    "casper": "#f7e3ec",
    "cli": "#e3dcef",
}


def floors(house: str) -> list[list[str]]:
    """The rooms and files of a house by layer, the lowest first; where no layer is stated, all on one floor each."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
    for contract in contracts:
        if contract.get("containers") == [f"casper.{house}"]:
            return [layer.split(" | ") for layer in reversed(contract["layers"])]
    folder = FOLDERS.get(house, ROOT / house)
    names = sorted(p.stem for p in folder.iterdir() if _is_file(p) or (_is_room(p) and p.name not in HOUSES))
    return [[name] for name in names]


def _is_file(path: Path) -> bool:
    return path.suffix == ".py" and not path.stem.startswith("_")


def _is_room(folder: Path) -> bool:  # the shipped domains are text
    return folder.is_dir() and (folder / "__init__.py").is_file() and folder.name != "domains"


def size(house: str, name: str) -> str:
    """How many files a room has; nothing for a file."""
    folder = FOLDERS.get(house, ROOT / house) / name
    return f"  ({sum(1 for p in folder.rglob('*.py') if p.stem != '__init__')})" if folder.is_dir() else ""


def main() -> None:
    """Write docs/house.svg."""
    figure, axes = plt.subplots(figsize=(15.5, 6.2))
    for column, (house, title) in enumerate(HOUSES.items()):
        x = column * 2.6
        axes.text(x + 1, -0.55, f"{house}\n{title}", ha="center", va="top", fontsize=11, weight="bold")
        for y, layer in enumerate(floors(house)):
            width, font = 2 / len(layer), 8.5 if len(layer) < 3 else 6.5
            for at, name in enumerate(layer):
                box = plt.Rectangle((x + at * width, y), width - 0.04, 0.86, facecolor=COLOURS[house], edgecolor="#555")
                axes.add_patch(box)
                label = f"{name}{size(house, name)}"
                axes.text(x + at * width + width / 2 - 0.02, y + 0.43, label, ha="center", va="center", fontsize=font)
        if column:
            arrow = {"arrowstyle": "->", "color": "#333", "lw": 1.5}
            axes.annotate("", (x - 0.55, 0.43), (x - 0.03, 0.43), arrowprops=arrow)
    axes.set_xlim(-0.1, 2.6 * len(HOUSES) - 0.4)
    axes.set_ylim(-1.6, max(len(floors(house)) for house in HOUSES) + 0.1)
    axes.axis("off")
    figure.tight_layout()
    plt.rcParams["svg.hashsalt"] = "casper"
    figure.savefig(ROOT / "docs" / "house.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
