"""Random terms, as SWI-Prolog reads and writes them."""

from __future__ import annotations

from pathlib import Path
from random import Random

from swipl import asked
from tally import Tally

from casper.kb.terms.operators import STANDARD
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, make_list
from casper.kb.terms.writeq import writeq
from casper.kb.text.reader import read_term

NAMES = [
    "a", "bob", "aB_1", "éclair", "Ünal", "食", "_x", "0a", "X", "Big name", "it's", "", "a\nb", "x\ty", "\x07\x1b", "\\", "'", '"',
    "`", "!", ";", ",", "|", ".", "..", "/*", "%", "→", "→→", "a→", "&", "=>", "$", "[]x", "a.b", "end_of_file", "mod", "\u200b", "e\u0301",
]  # fmt: skip
OPERATORS = sorted({*STANDARD.infix, *STANDARD.prefix})
INTEGERS = [0, 1, -1, 42, -7, 10**20, -(10**18)]
FLOATS = [1.0, -0.5, 0.0, -0.0, 1e100, 1e15, 1e14, 123456789012345.0, 1e-4, 1e-5, -2.5e-7, 1e22, 5e-324, 1.7976931348623157e308]


def random_term(random, depth):
    kind = random.random()
    if depth <= 0 or kind < 0.3:
        return random_constant(random)
    inner = [random_term(random, depth - 1) for _ in range(random.randint(1, 3))]
    if kind < 0.55:
        return Compound((random.choice(OPERATORS), inner[0], random_term(random, depth - 1)))
    if kind < 0.7:
        return Compound((random.choice(OPERATORS), inner[0]))
    if kind < 0.78:
        return make_list(inner, "[]" if random.random() < 0.7 else random_term(random, depth - 1))
    if kind < 0.83:
        return Compound(("{}", inner[0]))
    return Compound((random.choice([name for name in NAMES if name != "."]), *inner))


def random_constant(random):
    return random.choice(
        [
            random.choice(NAMES), random.choice(NAMES), random.choice(OPERATORS), random.choice(["[]", "{}"]), random.choice(INTEGERS),
            random.choice(FLOATS), random.uniform(-1e6, 1e6) * 10.0 ** random.randint(-20, 20), Variable(random.choice(["X", "_Y", "Ünal", "A1"])),
        ]
    )  # fmt: skip


def random_terms(seed, count):
    random = Random(seed)
    return [random_term(random, random.randint(0, 4)) for _ in range(count)]


def typed(term):
    return (tuple(map(typed, term)),) if isinstance(term, tuple) else (type(term), term, repr(term))


def told(count: int, seed: int, folder: Path) -> list[tuple[Term, str, str]]:
    """Random terms with how SWI-Prolog writes them, and ``same`` where it reads our text of them as the same."""
    terms = random_terms(seed, count)
    found = asked([(term, term_text(term, 1200)) for term in terms], folder)
    return [(term, *pair) for term, pair in zip(terms, found, strict=True)]


def compare(count: int, seed: int, folder: Path) -> Tally:
    """Write every term as SWI-Prolog does, read what it writes, and have it read what we write."""
    tally = Tally(asked=count)
    for term, written, same in told(count, seed, folder):
        if writeq(term) == written and typed(read_term(written)) == typed(term) and same == "same":
            tally.equal += 1
        else:
            tally.disagreements.append(f"{writeq(term)}\nSWI-Prolog: {written} ({same})")
    return tally
