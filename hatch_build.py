"""Compiles what takes in world states where ``CASPER_COMPILE=1`` is set when a wheel is built (docs/batch.md).

mypyc makes C of the same typed sources, which stay in the wheel; without the variable it is pure Python. An editable
install is never compiled: what is edited there would not be what runs.
"""

import os
import shutil
from contextlib import chdir
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

GROUP = "casper_compiled"  # names the library that the compiled modules share


class Compiling(BuildHookInterface):  # type: ignore[type-arg]
    """The hook; ``modules`` in pyproject.toml are compiled, in this order of rooms."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """What compiles."""
        return ["mypy>=1.15", "setuptools>=68", "numpy>=1.26"] if is_wanted() else []  # numpy: for its types

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile in a folder beside the sources, and put what comes of it into the wheel."""
        if not is_wanted():
            return
        if version == "editable":
            self.app.display_warning("CASPER_COMPILE is passed over: an editable install is not compiled")
            return
        self._folder = TemporaryDirectory()
        folder = Path(self._folder.name)
        for source, target in self.build_config.sources.items():
            pure = shutil.ignore_patterns("__pycache__", "*.so", "*.pyd")
            shutil.copytree(Path(self.root, source), folder / target, ignore=pure, dirs_exist_ok=True)
        try:
            with chdir(folder):
                compile_in_place([f"casper/{module}.py" for module in self.config["modules"]])
        except (Exception, SystemExit) as mistake:  # mypyc leaves by the latter, its complaints are printed
            self.app.abort(f"casper could not be compiled ({mistake}); without CASPER_COMPILE it is installed as it is")
        for pattern in ("*.so", "*.pyd"):
            for file in (f for f in folder.rglob(pattern) if "build" not in f.relative_to(folder).parts):
                build_data["force_include"][str(file)] = str(file.relative_to(folder))
        build_data["pure_python"], build_data["infer_tag"] = False, True

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """The folder goes."""
        if hasattr(self, "_folder"):
            self._folder.cleanup()


def is_wanted() -> bool:
    """Whether the variable is set."""
    return os.environ.get("CASPER_COMPILE", "0") not in ("", "0")


def compile_in_place(files: list[str]) -> None:
    """Compile modules of the packages in this folder, so that each has its library beside it."""
    from mypyc.build import mypycify
    from setuptools import Distribution

    options = ["--config-file=", "--explicit-package-bases", "--ignore-missing-imports", *files]
    extensions = mypycify(options, opt_level="3", debug_level="0", group_name=GROUP)
    for extension in extensions if os.name != "nt" else ():
        extension.extra_compile_args.append("-ffp-contract=off")  # the same floats as Python's, to the last bit
    command = Distribution({"name": "casper", "ext_modules": extensions}).get_command_obj("build_ext")
    command.inplace = True  # type: ignore[attr-defined]
    command.ensure_finalized()
    command.run()
