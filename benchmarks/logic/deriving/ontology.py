"""A generated ontology: 85,000 type and property facts under 1,110 axioms, the same tuples for every engine.

Timed: deriving everything that follows from loaded facts. The axioms come in two encodings that must agree:
as facts under eight general rules (the way OWL 2 RL is written down), and each as a rule, every class and
property being a predicate.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from ..bounds import Bound
from ..figures import OURS, Amounts, Figure, Row, Rows, Sizes, Skipped
from ..peers.engines import Program, derivations

TITLE = "The ontology task"
TIMED = (
    "Facts and axioms are loaded; timed is deriving all that follows (casper: `compile` and a first "
    "`ask`; clingo: grounding; SWI-Prolog: one tabled query for all answers). Loading is building the "
    "base and deriving, together."
)
TASK = "ontology, axioms as {encoding}"
GENERAL_RULES = (
    "type(X, D) :- type(X, C), subclass(C, D)",
    "type(X, C) :- holds(X, P, _), domain(P, C)",
    "type(Y, C) :- holds(_, P, Y), range(P, C)",
    "holds(X, Q, Y) :- holds(X, P, Y), subproperty(P, Q)",
    "holds(Y, Q, X) :- holds(X, P, Y), inverse(P, Q)",
    "holds(Y, P, X) :- holds(X, Q, Y), inverse(P, Q)",
    "holds(Y, P, X) :- holds(X, P, Y), symmetric(P)",
    "holds(X, P, Z) :- holds(X, P, Y), transitive(P), holds(Y, P, Z)",
)
RULE_OF_AXIOM = {
    "subclass": ("{1}(X) :- {0}(X)",),
    "domain": ("{1}(X) :- {0}(X, _)",),
    "range": ("{1}(Y) :- {0}(_, Y)",),
    "subproperty": ("{1}(X, Y) :- {0}(X, Y)",),
    "inverse": ("{1}(Y, X) :- {0}(X, Y)", "{0}(Y, X) :- {1}(X, Y)"),
    "symmetric": ("{0}(Y, X) :- {0}(X, Y)",),
    "transitive": ("{0}(X, Z) :- {0}(X, Y), {0}(Y, Z)",),
}
KINDS = {"transitive": 20, "inverse": 20, "symmetric": 10, "subproperty": 20, "domain": 25, "range": 25}
PROPERTIES, SUBCLASSES, TYPES, LINKS, INDIVIDUALS, BLOCK = 100, 990, 50_000, 35_000, 25_000, 5
ROOTS = 40  # in a hundred subclass axioms


@dataclass(frozen=True, slots=True)
class Ontology:
    """Facts ``type(individual, class)`` and ``holds(subject, property, object)``, and axioms by kind."""

    types: Rows
    links: Rows
    axioms: dict[str, Rows]


def generated(share: float = 1.0, seed: int = 1) -> Ontology:
    """An ontology with a share of the full number of facts and of subclass axioms."""
    random = Random(seed)
    axioms = {"subclass": _subclasses(random, max(10, round(SUBCLASSES * share)))}
    classes = sorted({str(c) for pair in axioms["subclass"] for c in pair})
    axioms |= _property_axioms(random, classes)
    individuals = max(BLOCK, round(INDIVIDUALS * share))
    types = _distinct(
        round(TYPES * share), lambda: (_individual(random, individuals), random.choice(classes))
    )
    links = _distinct(round(LINKS * share), lambda: _link(random, individuals))
    return Ontology(types, links, axioms)


def _subclasses(random: Random, axioms: int) -> Rows:
    """A directed acyclic graph: every class but the roots lies below one class, some below a second one."""
    roots = axioms * ROOTS // 100
    classes = axioms + roots * 9 // 10
    single = [(f"c{at}", f"c{_above(random, at)}") for at in range(roots, classes)]
    return single + _distinct(axioms - len(single), lambda: _pair(random, roots, classes), set(single))


def _above(random: Random, at: int) -> int:
    return random.randrange(at // 2)


def _pair(random: Random, roots: int, classes: int) -> Row:
    at = random.randrange(roots, classes)
    return f"c{at}", f"c{_above(random, at)}"


def _property_axioms(random: Random, classes: list[str]) -> dict[str, Rows]:
    """Properties in blocks: 0-19 transitive, 20-29 symmetric, 40-59 below 60-79, 0-19 inverse to 80-99."""
    top = classes[: len(classes) // 2]
    return {
        "transitive": [(f"p{at}",) for at in range(KINDS["transitive"])],
        "symmetric": [(f"p{20 + at}",) for at in range(KINDS["symmetric"])],
        "subproperty": [(f"p{40 + at}", f"p{60 + at}") for at in range(KINDS["subproperty"])],
        "inverse": [(f"p{at}", f"p{80 + at}") for at in range(KINDS["inverse"])],
        "domain": [
            (f"p{at}", random.choice(top)) for at in random.sample(range(PROPERTIES), KINDS["domain"])
        ],
        "range": [(f"p{at}", random.choice(top)) for at in random.sample(range(PROPERTIES), KINDS["range"])],
    }


def _individual(random: Random, individuals: int) -> str:
    return f"i{random.randrange(individuals)}"


def _link(random: Random, individuals: int) -> Row:
    """A link; transitive properties stay inside a block, lower to higher, so their closure stays small."""
    subject, kind = random.randrange(individuals), random.randrange(PROPERTIES)
    if kind >= KINDS["transitive"]:
        return f"i{subject}", f"p{kind}", _individual(random, individuals)
    start = subject - subject % BLOCK
    low, high = sorted(random.sample(range(start, start + BLOCK), 2))
    return f"i{low}", f"p{kind}", f"i{high}"


def _distinct(count: int, draw, taken: set[Row] = frozenset()) -> Rows:  # type: ignore[no-untyped-def,assignment]
    rows: dict[Row, None] = {}
    while len(rows) < count:
        row = draw()
        if row not in taken:
            rows[row] = None
    return list(rows)


def as_facts(ontology: Ontology) -> Program:
    """The axioms as facts, under general rules."""
    facts = {"type": ontology.types, "holds": ontology.links, **ontology.axioms}
    counted = (("type", 2), ("holds", 3))
    return Program(facts, GENERAL_RULES, counted, ("subsumptive",))  # variant tabling takes over a minute


def as_rules(ontology: Ontology) -> Program:
    """Each axiom as a rule, each class and each property a predicate."""
    facts: dict[str, Rows] = {}
    for individual, class_ in ontology.types:
        facts.setdefault(str(class_), []).append((individual,))
    for subject, property_, object_ in ontology.links:
        facts.setdefault(str(property_), []).append((subject, object_))
    classes = {str(c) for pair in ontology.axioms["subclass"] for c in pair}
    properties = [f"p{at}" for at in range(PROPERTIES)]
    rules = [
        r.format(*row) for kind, rows in ontology.axioms.items() for row in rows for r in RULE_OF_AXIOM[kind]
    ]
    counted = [(c, 1) for c in sorted(classes)] + [(p, 2) for p in properties]
    return Program(facts, tuple(rules), tuple(counted))


def measure(sizes: Sizes) -> Iterator[Figure | Skipped]:
    """Deriving in both encodings by every engine."""
    ontology = generated(sizes.ontology)
    for encoding, program in (("facts", as_facts(ontology)), ("rules", as_rules(ontology))):
        yield from derivations(TASK.format(encoding=encoding), [program], sizes)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Each engine on the encoding of the axioms that suits it best."""
    tasks = [TASK.format(encoding=encoding) for encoding in ("facts", "rules")]
    ours, theirs = ([amounts[t, engine] for t in tasks if (t, engine) in amounts] for engine in (OURS, "clingo"))
    value = min(ours) / min(theirs) if ours and theirs else None
    yield Bound("the ontology, each in its best encoding, against clingo", value, 1, "×")
