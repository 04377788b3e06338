"""A compiled wheel says what the sources say: the same events for the same world states, to the last bit."""

import ast
import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
MODULES = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]["hooks"][
    "custom"
]["modules"]
WATCHES = """
import hashlib, json, math, random, sys
from casper import Domain
from casper.engine.live import Partners
from casper.engine.perception.filters import handling
from casper.streams.watching import watched

def lines(noise, source=random.Random(7)):
    things = {"glass": (1.0, 0.5), "bottle": (2.0, 1.5), "sink": (3.0, 0.0), "counter": (0.9, 0.6)}
    held = None
    for n in range(1500):
        x, y = 1.6 + 1.5 * math.cos(n / 60), 0.7 + 0.8 * math.sin(n / 60)
        held = "glass" if 100 < n % 400 < 300 else None
        seen = dict(things, glass=(x, y) if held else things["glass"])
        spoilt = {name: [c + source.gauss(0, noise) for c in place] for name, place in seen.items()}
        objects = {name: {"x": px, "y": py, "z": 0.9} for name, (px, py) in spoilt.items()}
        human = {"x": x + source.gauss(0, noise), "y": y + source.gauss(0, noise), "heading": n / 60, "holding": held}
        robot = {"x": 0, "y": 3, "heading": 1, "holding": None}
        yield json.dumps({"t": n / 10, "agents": {"human": human, "robot": robot}, "objects": objects})
    yield "no JSON"

print(handling.__file__.endswith(".py"))
domain = Domain.load("kitchen")
for noise in (0.0, 0.06):
    told = [json.dumps(event.to_json(), sort_keys=True) for event in watched(Partners(domain), lines(noise), window=1.0)]
    print(len(told), hashlib.sha256("".join(told).encode()).hexdigest())
"""


@pytest.mark.parametrize("module", MODULES)
def test_no_compiled_module_adds_up_a_generator(module: str) -> None:
    """Python 3.12 and later add floats up more exactly than one by one, which is what mypyc makes of a generator."""
    tree = ast.parse((ROOT / "src/casper" / f"{module}.py").read_text())
    sums = [n for n in ast.walk(tree) if isinstance(n, ast.Call) and getattr(n.func, "id", "") == "sum"]
    assert not [n.lineno for n in sums if isinstance(n.args[0], ast.GeneratorExp)]


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel that was compiled, unpacked."""
    if not any(map(shutil.which, ("cc", "gcc", "clang", "cl"))):
        pytest.skip("compiling needs a C compiler, and there is none here")
    folder = tmp_path_factory.mktemp("compiled")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "CASPER_COMPILE": "1"})
    assert done.returncode == 0, done.stderr + done.stdout
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder / "unpacked")
    return folder / "unpacked"


def said(where: Path) -> list[str]:
    """What minds of an installation say: whether it is plain Python, and of each stream how much, and its digest."""
    environment = {**os.environ, "PYTHONPATH": str(where)}
    done = subprocess.run([sys.executable, "-c", WATCHES], capture_output=True, text=True, env=environment, check=True)
    return done.stdout.splitlines()


@pytest.mark.xdist_group("packaging")
def test_every_module_that_is_named_is_compiled_and_its_source_is_there(compiled: Path) -> None:
    for module in MODULES:
        file = compiled / "casper" / module
        assert file.with_suffix(".py").is_file()
        assert [f for f in file.parent.iterdir() if f.name.startswith(f"{file.name}.") and f.suffix in (".so", ".pyd")]


@pytest.mark.xdist_group("packaging")
def test_compiled_minds_say_what_others_say_to_the_last_bit(compiled: Path) -> None:
    (compiled_is_plain, *events), (source_is_plain, *expected) = said(compiled), said(ROOT / "src")
    assert (compiled_is_plain, source_is_plain) == ("False", "True")
    assert events == expected


@pytest.mark.xdist_group("packaging")
def test_the_doctor_says_that_it_is_compiled(compiled: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(compiled)}
    command = [sys.executable, "-m", "casper", "doctor"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    assert done.stdout.splitlines()[0].endswith(", compiled")
