"""Readings of the kitchen, and of domains made up for a test."""

from __future__ import annotations

from casper import Domain

KITCHEN = Domain.load("kitchen")


def reading(*observed, **options):
    """A reading of the kitchen that has observed these actions."""
    found = KITCHEN.reading(**options)
    for action in observed:
        found.observe(action)
    return found


def domain(tmp_path, plans):
    """A domain of nothing but plans."""
    (tmp_path / "plans.pl").write_text(plans)
    return Domain.load(tmp_path)
