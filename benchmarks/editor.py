"""How fast the language server answers in a domain of 1,000 lines: a change, and a completion.

    python benchmarks/editor.py [--lines 1000] [--changes 30]

The server runs as an editor runs it, over its protocol; the time is from sending a change to the findings that answer
it, and from asking for a completion to the answer. The processor time of a change is given beside: others may be using
the machine. The whole of ``casper check`` runs in a process of its own and is not waited for.
"""

import argparse
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests" / "lsp")]

BOUNDS = {"change": 100.0, "completion": 50.0}  # milliseconds


def domain_of(lines: int) -> tuple[str, str]:
    """An ontology and plans of so many lines together: kinds, classes, actions, constraints, goals and tasks."""
    size = max(lines // 17, 4)
    text = ["% a large home", "human(ann). robot(tia).", "agent(X) :- human(X).", "agent(X) :- robot(X)."]
    text += [f"kind_{i % size}(object_{i % 80}).     % thing {i}" for i in range(4 * size)]
    text += [f"item(X) :- kind_{i}(X)." for i in range(size)]
    text += [f"place(place_{i})." for i in range(6)]
    text += [f"act_{i}(A, T, D) :- agent(A), kind_{i}(T), place(D), T \\= D." for i in range(size)]
    text += [f"class_{i}(X) :- kind_{i % size}(X), \\+ place(X)." for i in range(4 * size)]
    text += [
        f'never("constraint number {i}") :- claim(act_{i % size}(_, T, _)), class_{i}(T), \\+ item(T).'
        for i in range(2 * size)
    ]
    plans = [f"goal(goal_{i}(X)) :- kind_{i}(X)." for i in range(size)]
    plans += [f"goal_{i}(X) --> prepare_{i}(X), act_{i}(X, place_{i % 6})." for i in range(size)]
    plans += [
        f"prepare_{i}(X) --> act_{(i + 1) % size}(X, place_1), act_{(i + 2) % size}(X, place_2)." for i in range(size)
    ]
    text += [f"% line {at}" for at in range(lines - len(text) - len(plans))]
    return "\n".join(text) + "\n", "\n".join(plans) + "\n"


def measure(lines: int, changes: int) -> dict[str, list[float]]:
    """Milliseconds of every change and completion over the protocol, and of processor time of a change alone."""
    from editor import Editor

    from casper.lsp.quick import quick_findings
    from casper.lsp.workspace import Workspace

    found: dict[str, list[float]] = {"change": [], "completion": [], "processor time of a change": []}
    with tempfile.TemporaryDirectory() as folder:
        ontology, plans = (Path(folder) / name for name in ("ontology.pl", "plans.pl"))
        for path, text in zip((ontology, plans), domain_of(lines)):
            path.write_text(text)
        editor, text = Editor(), ontology.read_text()
        uri = editor.open(ontology)
        editor.findings(uri)
        middle = text.index("class_0(X)")
        for at in range(changes):
            typed = f"fresh_{at}(X) :- missing_{at}(X)" + (".\n" if at % 2 else "")
            wanted = f"missing_{at}/1" if at % 2 else "of a clause"
            before = time.perf_counter()
            editor.change(uri, text[:middle] + typed + text[middle:] if at % 2 else text + typed)
            editor.findings(uri, lambda messages, wanted=wanted: any(wanted in each for each in messages))
            found["change"].append((time.perf_counter() - before) * 1000)
            before = time.perf_counter()
            assert len(editor.completions(uri, "class_0(X) :- kind_")) > 50
            found["completion"].append((time.perf_counter() - before) * 1000)
        editor.end()
        workspace = Workspace()
        for at in range(changes):
            workspace.open[ontology] = text[:middle] + f"fresh_{at}(X) :- missing_{at}(X).\n" + text[middle:]
            before = time.process_time()
            quick_findings(workspace.domain_of(ontology))
            found["processor time of a change"].append((time.process_time() - before) * 1000)
    return found


def main() -> None:
    """Print least, median and largest of each, and the bound."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--lines", type=int, default=1000)
    parser.add_argument("--changes", type=int, default=30)
    chosen = parser.parse_args()
    print(f"{chosen.lines} lines, {chosen.changes} changes; milliseconds: least, median, largest")
    for name, times in measure(chosen.lines, chosen.changes).items():
        told = f"{min(times):7.1f} {statistics.median(times):7.1f} {max(times):7.1f}"
        bound = f"   (bound {BOUNDS[name]:g})" if name in BOUNDS else ""
        print(f"{name:28}{told}{bound}")


if __name__ == "__main__":
    main()
