"""Everything that must hold, in one command: ``python tests`` runs ruff, mypy, import-linter and pytest.

It stops at the first failure. What stands behind ``python tests`` on the command line goes to pytest.
"""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORKERS = str(min(4, os.cpu_count() or 1))
LAYERS = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True))"
STEPS = {
    "ruff": ("-m", "ruff", "check", "."),
    "mypy": ("-m", "mypy", "--strict", "-p", "casper"),
    "import-linter": ("-c", LAYERS),
    "pytest": ("-m", "pytest", "-n", WORKERS, "--dist", "loadgroup", *sys.argv[1:]),
}


def main() -> int:
    """Run every step from the project's root; the exit code of the first that fails, else 0."""
    for name, command in STEPS.items():
        print(f"--- {name}", flush=True)
        done = subprocess.run([sys.executable, *command], cwd=ROOT)
        if done.returncode:
            return done.returncode
    return 0


sys.exit(main())
