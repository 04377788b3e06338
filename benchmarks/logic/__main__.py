"""``python -m benchmarks.logic`` or ``python benchmarks/logic``."""

import sys
from pathlib import Path

if __name__ == "__main__":
    if not __package__:  # run as a folder: the package is found from the project's root
        sys.path[0] = str(Path(__file__).resolve().parents[2])
    from benchmarks.logic.report import main

    sys.exit(main())
