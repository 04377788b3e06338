"""Names: predicates nobody defines, one name with several arities, variables that stand alone."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Sequence

from casper.kb.checks.finding import Finding, error, finding_of, note, warning
from casper.kb.errors import Place, ProgramError
from casper.kb.program.control import is_control
from casper.kb.program.listing import is_range_restricted
from casper.kb.program.program import analyse
from casper.kb.program.refusals import undefined_sentence
from casper.kb.reasons.says import is_say, parts_of
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Directive, Indicator, Production, Sentence, is_auxiliary
from casper.kb.terms.control import CONTROL
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import variables_of
from casper.kb.text.writer import literal_text

_PROLOG = {
    "assert": "add facts from Python",
    "assertz": "add facts from Python",
    "retract": "remove facts from Python",
    "write": "print from Python",
}
_GUARDED = {name for name, _ in (*SYSTEM, *CONTROL)} | {"=", "is", "call"}
_GIVEN = BUILTINS | set(SYSTEM)


def needed_by(parts: Iterable[Clause]) -> set[Indicator]:
    """The predicates that a clause needs, given as plain ones."""
    return {x.needed for part in parts for x in part.body if x.needed is not None and not is_auxiliary(x.needed)}


def undefined_names(
    parts: Iterable[Clause], known: Collection[Indicator], half_read: Collection[str]
) -> Iterator[Finding]:
    """Every condition of a clause (given as plain ones) whose predicate nobody defines, with what may have been meant.

    ``half_read`` are names of clauses that could not be read: nobody knows what they would have defined.
    """
    for literal in (x for part in parts for x in part.body):
        needed = literal.needed
        if needed is None or needed in _GIVEN or needed in known or is_auxiliary(needed) or needed[0] in half_read:
            continue
        sentence = undefined_sentence(needed, known)
        if needed[0] in _PROLOG and "did you mean" not in sentence:
            sentence = f"{needed[0]}/{needed[1]} is not part of the language; {_PROLOG[needed[0]]}"
        yield error(literal.place, sentence)


def own_mistakes(parts: Sequence[Clause]) -> Iterator[Finding]:
    """What is wrong with a clause by itself: a reserved name, a constraint without sentence, an unbound negation."""
    clause = parts[0]
    if not clause.body and clause.head.functor not in _GUARDED:
        return
    try:
        analyse(parts, needed_by(parts) - _GIVEN - {part.head.indicator for part in parts})
    except ProgramError as mistake:
        yield finding_of(mistake, clause.place)


def unbound_conditions(clause: Clause) -> Iterator[Finding]:
    """Comparisons and negations that have to wait for the one who asks: nothing in the rule binds their variables."""
    binders = [x for x in clause.body if not x.negated and (not x.is_comparison or x.atom[0] in ("=", "is"))]
    for literal in clause.body:
        is_equality = literal.is_comparison and literal.atom[0] == "=" and not literal.negated
        if is_equality or is_control(literal) or is_range_restricted(Clause(Compound(("asked",)), (*binders, literal))):
            continue
        name, arity = clause.head.indicator
        sentence = f"nothing here binds the variables of {literal_text(literal)}"
        yield note(literal.place, f"{sentence}: {name}/{arity} must be asked with them")


def single_variables(sentences: Iterable[Sentence]) -> Iterator[Finding]:
    """Variables that stand alone in their clause: most often a slip of the pen.

    Clauses of one place are the alternatives of one rule, and a variable may stand in some of them only.
    """
    rules: dict[Place, list[Counter[Variable]]] = defaultdict(list)
    for sentence in sentences:
        if not isinstance(sentence, Directive):
            rules[sentence.place].append(Counter(_occurrences(sentence)))
    for place, alternatives in rules.items():
        most: Counter[Variable] = Counter()
        for counted in alternatives:
            most |= counted
        alone = [v.name for v, times in most.items() if times == 1 and not v.name.startswith("_")]
        if alone:
            stand, it = ("stands", "it is") if len(alone) == 1 else ("stand", "they are")
            fix = " or ".join(["_", *(f"_{name}" for name in alone[:1])])
            yield warning(place, f"{_listed(alone)} {stand} only once here; write {fix} if {it} meant to be anything")
        marked = [v.name for v, times in most.items() if times > 1 and v.name.startswith("_") and not v.is_anonymous]
        if marked:
            yield note(place, f"{_listed(marked)} {'starts' if len(marked) == 1 else 'start'} with _ but is used twice")


def arity_clashes(clauses: Iterable[Clause], exempt: Collection[Indicator]) -> Iterator[Finding]:
    """One name with several numbers of arguments, where neither predicate is defined by the other.

    ``exempt`` are relations that the system reads: they may well share their names.
    """
    table: dict[str, dict[int, list[Clause]]] = defaultdict(dict)
    for clause in clauses:
        name, arity = clause.head.indicator
        if clause.head.indicator not in exempt and name != "never" and not is_say(clause):
            table[name].setdefault(arity, []).append(clause)
    for name, arities in table.items():
        if len(arities) > 1 and not _are_related(name, arities):
            usual = max(arities, key=lambda arity: len(arities[arity]))
            for arity, found in arities.items():
                if arity != usual:
                    other = arities[usual][0].place
                    where = f" ({_where(other, found[0].place)})" if other.line else ""
                    sentence = f"{name} has {_arguments(arity)} here, and {usual} elsewhere{where}"
                    yield warning(found[0].place, f"{sentence}; they are two different relations")


def _are_related(name: str, arities: dict[int, list[Clause]]) -> bool:
    """Whether one of the predicates is defined by another: an accumulator, a default for an argument."""
    needed = {(arity, x.atom.indicator) for arity, found in arities.items() for clause in found for x in clause.body}
    return any(other[0] == name and other[1] != arity and other[1] in arities for arity, other in needed)


def _occurrences(sentence: Clause | Production) -> Iterator[Variable]:
    if isinstance(sentence, Production):
        waiting: list[Term] = [sentence.head, sentence.body]
    else:
        waiting = [sentence.head, *(literal.atom for literal in sentence.body)]
        if is_say(sentence):  # what stands in the sentence of a say stands there a second time
            named = set(parts_of(str(sentence.head[-1]))[1::2])
            yield from (v for v in variables_of(sentence.head) if v.name in named)
    waiting.reverse()
    while waiting:
        term = waiting.pop()
        if isinstance(term, Variable):
            yield term
        elif isinstance(term, Compound):
            waiting.extend(reversed(term))


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _arguments(arity: int) -> str:
    return "1 argument" if arity == 1 else f"{arity or 'no'} arguments"


def _where(place: Place, seen_from: Place) -> str:
    """A place in few words: the line, and the file where it is another one."""
    file = place.file.rsplit("/", 1)[-1]
    return f"line {place.line}" if place.file == seen_from.file else f"{file}:{place.line}"
