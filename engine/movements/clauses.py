"""A learned movement tree as clauses of the domain language: one per leaf, to be read and to be queried."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from casper.engine.movements.features import ORDERS, TIMED_ORDERS, Features, TimedFeatures
from casper.engine.movements.tree import Evaluation, Leaf, MovementTree

_PREDICATES = Features._fields
_VARIABLES = tuple(name.capitalize() for name in TimedFeatures._fields)
_DOMAIN = ", ".join(f"{p}({v})" for p, v in zip(_PREDICATES, _VARIABLES))
SEEN = 0.5  # counts added to each movement of a leaf, so that nothing is impossible


def compile_tree(tree: MovementTree, evaluation: Evaluation | None = None) -> str:
    """The text of ``movements.pl``: where it was learned from, the features' values, a clause per leaf.

    With an evaluation also its figures, as a comment, and what the classifier takes for what, as facts
    ``emission(True, Seen, P)``. The same tree gives the same bytes.
    """
    parts = [_header(tree, evaluation)]
    parts += [_values(), _clauses(tree)] if tree.kind is Features else [_timed(tree), _likelihoods(tree)]
    if evaluation is not None:
        parts.append(_emission(evaluation))
    return "\n\n".join(parts) + "\n"


def _header(tree: MovementTree, evaluation: Evaluation | None) -> str:
    shown = ", ".join(_VARIABLES[: len(tree.kind._fields)])
    lines = [
        f"movements.pl - which movement it is, learned: movement({shown}, Movement).",
        f"Learned from {tree.samples} samples of {tree.trials} trials, at most {tree.max_leaf_nodes} leaves, "
        f"seed {tree.seed}.",
        "A feature counts by its place in the order of its facts below."
        if tree.kind is Features
        else "A feature counts by its place in its order: casper.engine.movements.features.",
    ]
    if evaluation is not None:
        lines += _figures(evaluation)
    return "\n".join(f"% {line}".rstrip() for line in lines)


def _figures(evaluation: Evaluation) -> list[str]:
    labels = evaluation.labels
    worst, best = min(evaluation.per_trial.values()), max(evaluation.per_trial.values())
    width = max(map(len, labels)) + 2
    head = "".join(label.rjust(width) for label in labels)
    rows = (
        true.ljust(width) + "".join(str(evaluation.confusion[true][seen]).rjust(width) for seen in labels)
        for true in labels
    )
    return [
        f"Leave-one-trial-out accuracy {evaluation.accuracy:.4f} (by trial {worst:.4f} to {best:.4f}).",
        "Confusion counts (rows: true, columns: classified):",
        "  " + " " * width + head,
        *("  " + row for row in rows),
        *(
            f"{level}: accuracy {share:.4f}, learned without it {_share(evaluation.unseen.get(level))}."
            for level, share in evaluation.per_level.items()
        ),
    ]


def _share(share: float | None) -> str:
    return "unknown" if share is None else f"{share:.4f}"


def _values() -> str:
    lines = (
        " ".join(f"{predicate}({_atom(value)})." for value in order)
        for predicate, order in zip(_PREDICATES, ORDERS, strict=True)
    )
    return "\n".join(lines)


def _clauses(tree: MovementTree) -> str:
    clauses = []
    for leaf in tree.leaves:
        tests = [
            _test(variable, values, order)
            for variable, values, order in zip(_VARIABLES, leaf.allowed, ORDERS)
            if len(values) < len(order)
        ]
        head = f"movement({', '.join(_VARIABLES[: len(ORDERS)])}, {_atom(leaf.label)}) :-"
        body = ",\n    ".join([_DOMAIN, *([", ".join(tests)] if tests else [])])
        clauses.append(f"{head}  % {leaf.samples} samples\n    {body}.")
    return "\n".join(clauses)


def _timed(tree: MovementTree) -> str:
    """A clause a leaf: a single value stands in the head, several are a list (`engine.movements.leaves`)."""
    clauses = []
    for leaf in tree.leaves:
        args, tests = [], []
        for variable, values, order in zip(_VARIABLES, leaf.allowed, TIMED_ORDERS, strict=True):
            args.append(_atom(values[0]) if len(values) == 1 else "_" if len(values) == len(order) else variable)
            if 1 < len(values) < len(order):
                tests.append(f"member({variable}, [{', '.join(map(_atom, values))}])")
        body = f" :- {', '.join(tests)}" if tests else ""
        clauses.append(f"movement({', '.join(args)}, {_atom(leaf.label)}){body}.  % {leaf.samples} samples")
    return "\n".join(clauses)


def _likelihoods(tree: MovementTree) -> str:
    """How likely each leaf is for each movement, as shares."""
    lines = [
        "% likelihood(Clause, Movement, P): of the clause's number, how likely its features are in each movement, as",
        "% shares of the samples of each, half a count added.",
    ]
    for number, leaf in enumerate(tree.leaves, 1):
        shares = leaf_likelihoods(leaf, dict(tree.totals))
        lines.append(" ".join(f"likelihood({number}, {_atom(name)}, {p:.4g})." for name, p in shares.items()))
    return "\n".join(lines)


def leaf_likelihoods(leaf: Leaf, totals: Mapping[str, int]) -> dict[str, float]:
    """P(leaf | movement) by movement, up to a factor: they add up to 1."""
    counts = dict(leaf.counts)
    raw = {name: (counts.get(name, 0) + SEEN) / (total + SEEN) for name, total in totals.items()}
    return {name: p / sum(raw.values()) for name, p in raw.items()}


def _test(variable: str, values: Sequence[str], order: Sequence[str]) -> str:
    if len(values) == 1:
        return f"{variable} = {_atom(values[0])}"
    missing = [value for value in order if value not in values]
    if len(missing) == 1:
        return f"{variable} \\= {_atom(missing[0])}"
    return f"({' ; '.join(f'{variable} = {_atom(value)}' for value in values)})"


def _emission(evaluation: Evaluation) -> str:
    """Shares of the confusion counts, with half a count added to each, so that nothing is impossible."""
    lines = ["% emission(True, Seen, P): the cross-validated confusion, half a count added to each, as shares."]
    for true in evaluation.labels:
        row = evaluation.confusion[true]
        total = sum(row.values()) + 0.5 * len(evaluation.labels)
        lines += [
            f"emission({_atom(true)}, {_atom(seen)}, {(row[seen] + 0.5) / total:.4f})." for seen in evaluation.labels
        ]
    return "\n".join(lines)


def _atom(name: str) -> str:
    plain = name[:1].islower() and name.isascii() and name.replace("_", "a").isalnum()
    return name if plain else "'" + name.replace("\\", "\\\\").replace("'", "\\'") + "'"
