"""Sentences of authors (``say/2``, ``say/3``): variables that do not occur, what is said of nothing or never told."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Iterator, Sequence
from difflib import get_close_matches

from casper.kb.checks.finding import Finding, error, warning
from casper.kb.errors import Place
from casper.kb.program.refusals import undefined_sentence
from casper.kb.reasons.says import SAYS, Say, fits, is_say, say_of
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Production, Sentence
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import Compound, Term, as_term
from casper.kb.terms.unification import Bindings, substitute, variables_of

_CONSTRAINT: Indicator = ("never", 1)
_ANY = "any: "  # in front of the name of what stands for every value; no text has such a functor


def wrong_says(
    sentences: Sequence[Sentence], known: Collection[Indicator], half_read: Collection[str]
) -> Iterator[Finding]:
    """Whatever is wrong with the sentences of a text.

    Args:
        sentences: the whole text, plans included: their goals, tasks and actions may be worded.
        known: predicates that are defined, here or elsewhere.
        half_read: names of clauses that could not be read: nobody knows what they would have defined.
    """
    clauses = [s for s in sentences if isinstance(s, Clause) and is_say(s)]
    if not clauses:
        return
    things = _Things(sentences, known)
    says: dict[Hashable, list[Say]] = {}  # by language and what they are about
    for clause in clauses:
        mistake = mistake_of(clause)
        if mistake is not None:
            yield error(clause.place, mistake)
            continue
        say = say_of(clause)
        assert say is not None
        if say.about.functor not in half_read and (nothing := things.missing(say)):
            yield warning(clause.place, nothing)
        before = says.setdefault((say.language, say.key), [])
        earlier = next((other for other in before if _covers(other, say)), None)
        if earlier is not None:
            where = _where(earlier.clause.place, clause.place)
            yield warning(clause.place, f"this sentence is never told: {where} has one for {_text(earlier)} already")
        before.append(say)


def mistake_of(clause: Clause) -> str | None:
    """What makes a sentence one that cannot be told; None where it can."""
    if clause.body:
        return "a sentence has no conditions; end it with a full stop behind say(…)"
    say = say_of(clause)
    if say is None:
        wrong = clause.head[-2] if clause.head.arity == 2 or isinstance(clause.head[1], str) else clause.head[1]
        named = "nothing that can be worded" if wrong is clause.head[-2] else "no language, such as fr"
        return (
            f'{term_text(wrong)} is {named}: write say(eat(A, T, D), "{{A}} eats {{T}}") or say(fr, eat(A, T, D), "…")'
        )
    names = [v.name for v in variables_of(say.about) if not v.is_anonymous]
    for name in say.names:
        if name not in names:
            return f"the sentence has {{{name}}}, which does not occur in {_text(say)}{_instead(name, names)}"
    return None


def _instead(name: str, names: Sequence[str]) -> str:
    close = get_close_matches(name, names, n=1) or [n for n in names if n.lower() == name.lower()]
    if close:
        return f"; did you mean {{{close[0]}}}?"
    listed = " and ".join(f"{{{n}}}" for n in names)
    return f"; it has {listed}" if names else "; it has no variables (write {{ and }} for brackets)"


class _Things:
    """What there is to be worded."""

    def __init__(self, sentences: Iterable[Sentence], known: Collection[Indicator]) -> None:
        self.known = {*known, *SYSTEM, *BUILTINS, *((name, 2) for name in COMPARISONS)} - {*SAYS}
        self.constants: set[str] = set()
        self.constraints: set[str] = set()
        for sentence in sentences:
            if isinstance(sentence, Clause) and not is_say(sentence):
                self._clause(sentence)
            elif isinstance(sentence, Production):
                self._production(sentence)

    def missing(self, say: Say) -> str:
        """That a sentence is about nothing there is; empty where it is about something."""
        name, arity = say.about.indicator
        if say.about.indicator == _CONSTRAINT and isinstance(say.about[1], str):
            if say.about[1] in self.constraints:
                return ""
            close = get_close_matches(say.about[1], sorted(self.constraints), n=1)
            hint = f'; did you mean "{close[0]}"?' if close else ""
            return f"no constraint has this sentence, so nothing is ever told so{hint}"
        if (name, arity) in self.known or (not arity and name in self.constants):
            return ""
        if not arity:
            close = get_close_matches(name, sorted({*self.constants, *(n for n, _ in self.known)}), n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            return f"nothing here is called {term_text(name)}: its sentence is never told{hint}"
        reason = undefined_sentence((name, arity), self.known).replace("add a fact or a rule for it", "nothing is near")
        return f"this sentence is never told: {reason}"

    def _clause(self, clause: Clause) -> None:
        if clause.is_constraint and isinstance(clause.head[1], str):
            self.constraints.add(clause.head[1])
        for atom in (clause.head, *(literal.atom for literal in clause.body)):
            self._values(atom)

    def _production(self, production: Production) -> None:
        """A goal or task, and the steps it is made of, with the agent and without."""
        self.known.add(production.head.indicator)
        self._values(production.head)
        waiting: list[Term] = [production.body]
        while waiting:
            term = waiting.pop()
            if isinstance(term, Compound):
                self.known |= {term.indicator, (term.functor, term.arity + 1)}
                self._values(term)
                waiting.extend(term.args)
            elif isinstance(term, str):
                self.known |= {(term, 0), (term, 1)}

    def _values(self, atom: Compound) -> None:
        waiting: list[Term] = list(atom.args)
        while waiting:
            term = waiting.pop()
            if isinstance(term, str):
                self.constants.add(term)
            elif isinstance(term, Compound):
                self.known.add(term.indicator)
                waiting.extend(term.args)


def _covers(earlier: Say, later: Say) -> bool:
    """Whether whatever the later sentence is for is told by the earlier one: it fits, and needs no value more."""
    marks: Bindings = {v: Compound((_ANY, v.name)) for v in variables_of(later.about)}
    found: dict[str, Term] = {}
    if not fits(earlier.about, substitute(later.about, marks), found):
        return False
    return all(_values_in(found[name]) <= {*later.names} for name in earlier.names)


def _values_in(term: Term) -> set[str]:
    """The variables of the later pattern whose values a term is made of."""
    if not isinstance(term, Compound):
        return set()
    return {str(term[1])} if term[0] == _ANY else set().union(*map(_values_in, term.args))


def _text(say: Say) -> str:
    text = term_text(as_term(say.about))
    return f"\\+ {text}" if say.denied else text


def _where(place: Place, seen_from: Place) -> str:
    file = place.file.rsplit("/", 1)[-1]
    return f"line {place.line}" if place.file == seen_from.file else f"{file}:{place.line}"
