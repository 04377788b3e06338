"""Everything that must hold, in one command: ``python tests`` runs ruff, mypy and pytest, and stops at the first failure."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORKERS = str(min(4, os.cpu_count() or 1))
STEPS = (
    ("ruff", "check", "."),
    ("mypy", "--strict", "-p", "casper"),
    ("pytest", "-n", WORKERS, "--dist", "loadgroup"),
)


def main() -> int:
    """Run every step from the project's root; the exit code of the first that fails, else 0."""
    for module, *arguments in STEPS:
        print(f"--- {module} {' '.join(arguments)}", flush=True)
        done = subprocess.run([sys.executable, "-m", module, *arguments, *(sys.argv[1:] if module == "pytest" else [])], cwd=ROOT)
        if done.returncode:
            return done.returncode
    return 0


sys.exit(main())
