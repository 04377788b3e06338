"""A run and its page are the same bytes whatever Python's hashes are: sets have no say in what is told."""

import os
import subprocess
import sys

import pytest

pytest.importorskip("mujoco")


def told(tmp_path, seed):
    """What a run prints, and its page, under a hash seed."""
    page = tmp_path / "drink.html"
    command = [sys.executable, "-m", "casper", "run", "kitchen", "--goal", "drink", "--seed", "3", "--json"]
    environment = {**os.environ, "PYTHONHASHSEED": str(seed)}
    done = subprocess.run(
        [*command, "--quiet", "--report", str(page)], capture_output=True, env=environment, check=True
    )
    return done.stdout, page.read_bytes()


@pytest.mark.xdist_group("report")
def test_hash_seeds_do_not_matter(tmp_path):
    assert told(tmp_path, 1) == told(tmp_path, 2)
