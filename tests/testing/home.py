"""A small domain of somebody else's, as it should be, and with a bug planted in it."""

from pathlib import Path

ONTOLOGY = """\
human(ann). robot(bot). cup(mug). cup(glass). kettle(pot). drink(tea). drink(juice).
thing(X) :- cup(X). thing(X) :- kettle(X).
boil(A, K) :- human(A), kettle(K).
brew(A, D, C) :- human(A), D = tea, cup(C), did(boil(_, _), _).
pour(A, D, C) :- human(A), D = juice, cup(C).
sip(A, D, C) :- human(A), drink(D), cup(C).
wash(A, C) :- robot(A), cup(C).
wash(A, C) :- human(A), cup(C).
never("tea is for the mug") :- claim(brew(_, tea, C)), C \\= mug.
never("nothing is both a cup and a kettle") :- cup(X), kettle(X).
"""
PLANS = """\
tea   --> boil(pot), brew(tea, mug), sip(tea, mug), wash(mug).
juice --> pour(juice, glass), sip(juice, glass), wash(glass).
"""
TESTS = """\
example(valid, pour(ann, juice, glass)).
example(invalid, boil(bot, pot), "not a human").
example(reads, [boil(pot)], tea).
"""
BUGS = {  # what is replaced by what, and where
    "a rule too weak": ("ontology.pl", "boil(A, K) :- human(A), kettle(K).", "boil(A, K) :- human(A), thing(K)."),
    "a rule too strong": ("ontology.pl", "sip(A, D, C) :- human(A), drink(D), cup(C).", "sip(A, D, C) :- human(A), drink(D), C = glass."),
    "a plan with swapped steps": ("plans.pl", "boil(pot), brew(tea, mug)", "brew(tea, mug), boil(pot)"),
    "a constraint that never fires": ("ontology.pl", "claim(brew(_, tea, C)), C \\= mug", "claim(brew(_, coffee, C)), C \\= mug"),
    "a goal that hides another": ("plans.pl", "juice --> pour", "rinse --> wash(mug). clean --> wash(mug).\njuice --> pour"),
}

SUITE = """
from casper import Domain
from casper.testing.contract import DomainContract


class TestHome(DomainContract):
    domain = Domain.load({folder!r})

    def expected(self, statement):
        if statement.functor == "boil":
            return statement[1] == "ann" and statement[2] == "pot"
        return None
"""
"""The tests of its author: the contract, and what should be valid."""


def home(folder: Path, bug: str | None = None) -> Path:
    """The domain's folder, with a bug of that name."""
    texts = {"ontology.pl": ONTOLOGY, "plans.pl": PLANS, "tests.pl": TESTS}
    if bug is not None:
        file, right, wrong = BUGS[bug]
        assert right in texts[file]
        texts[file] = texts[file].replace(right, wrong)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder
