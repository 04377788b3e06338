"""All that is wrong with a domain: its clauses (`kb.checks`), its plans (`plans.checks`), how they fit together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from casper.engine.domain.check_settings import wrong_settings
from casper.engine.domain.domain import FILES, ONTOLOGY, SHIPPED, Domain, build, find_domain
from casper.engine.domain.examples import TESTS, examples_of, failure
from casper.engine.domain.relations import SHARING_NAMES, SYSTEM_RELATIONS
from casper.engine.domain.trying.plans import plans_nobody_can_do
from casper.engine.perception.remembering.asked import ASKED
from casper.engine.perception.remembering.checking import misread_memories
from casper.kb.checks.check import Context, check_sentences
from casper.kb.checks.finding import Finding, Severity, error, finding_of, sorted_findings
from casper.kb.errors import CasperError, DomainError, Place, PlanError
from casper.kb.terms.clauses import Clause, Indicator, Production, Sentence
from casper.kb.terms.operators import Operators
from casper.kb.text.files import is_there, read_utf8
from casper.kb.text.reader import Told, read_text
from casper.kb.text.recovery import read_tolerantly
from casper.kb.text.sources import Sources
from casper.plans.checks import telling_apart
from casper.plans.checks.check import check_plans, items_of
from casper.plans.grammar.conditions import condition_clauses
from casper.plans.library import GOAL
from casper.plans.relations import RELATIONS


def check_domain(name: str | Path) -> list[Finding]:
    """Everything that is wrong with a domain, by file and line.

    Raises:
        DomainError: there is no such domain.
    """
    folder = find_domain(name)
    read = _Read(folder)
    findings = list(read.findings)
    checked = check_sentences([*_knowledge(read), *_conditions(read)], _context(read))
    ours = [f"{name}/{arity}" for name, arity in {clause.head.indicator for clause in _conditions(read)}]
    findings += [f for f in checked.findings if f.severity is not Severity.NOTE or not _mentions(f, ours)]
    defined = {c.head.indicator for c in checked.kb.clauses} | {c.head.indicator for c in checked.faulty}

    def is_action(indicator: Indicator) -> bool:
        statement = (indicator[0], indicator[1] + 1)
        return statement in defined or checked.kb.defines(*statement) or indicator[0] in read.half_read

    findings += check_plans(read.everything, is_action if read.verifies else None)
    findings += wrong_settings(checked.kb)
    findings += misread_memories((s for s in read.everything if isinstance(s, Clause)), checked.kb)
    if not any(f.severity is Severity.ERROR for f in findings):
        findings += _as_a_whole(folder, read)
    else:
        findings += _unread_examples(folder)
    return sorted_findings(findings)


class _Read:
    """The sentences of a domain's files, as far as they can be read."""

    def __init__(self, folder: Path) -> None:
        self.findings: list[Finding] = []
        self.half_read: set[str] = set()
        self.sources = Sources((SHIPPED,), self._file, self._note)
        present = [file for file in FILES if is_there(folder / file)]
        self.sentences = {file: self.sources.sentences(folder / file) for file in present}
        self.verifies = ONTOLOGY in self.sentences

    @property
    def everything(self) -> list[Sentence]:
        return [sentence for found in self.sentences.values() for sentence in found]

    def _file(self, path: Path, operators: Operators, told: Told) -> list[Sentence]:
        try:
            text = read_utf8(path)
        except OSError as mistake:
            raise DomainError(f"this file cannot be read ({mistake})", Place(str(path))) from None
        if self.sources.is_foreign(path):  # what can be read of it in spite of a mistake is nobody's business
            return read_text(text, str(path), operators, told)
        read = read_tolerantly(text, str(path), operators, told)
        self.findings.extend(map(finding_of, read.mistakes))
        self.half_read |= read.half_read
        return read.sentences

    def _note(self, mistake: CasperError) -> None:
        self.findings.append(finding_of(mistake))


def _knowledge(read: _Read) -> list[Sentence]:
    """What the clauses' checks see: a domain without an ontology never asks the conditions of its goals."""
    if read.verifies:
        return read.everything
    return [s for s in read.everything if not (isinstance(s, Clause) and s.head.indicator == GOAL)]


def _mentions(finding: Finding, names: list[str]) -> bool:
    """Whether a finding is of a relation that stands for a condition of plans: that is asked as the plans ask it."""
    return any(name in finding.message for name in names)


def _conditions(read: _Read) -> list[Clause]:
    """The rules that conditions of plans stand for, as far as they can be read; without an ontology none is asked."""
    found: list[Clause] = []
    for production in read.everything if read.verifies else ():
        if isinstance(production, Production):
            with suppress(PlanError):  # which `check_plans` tells
                found.extend(condition_clauses([production]))
    return list(dict.fromkeys(found))


def _context(read: _Read) -> Context:
    """Who asks what in a domain."""
    productions = [s for s in read.everything if isinstance(s, Production)]
    actions = {(i.functor, i.arity + 1) for p in productions for i in items_of(p.body)}
    seen = set(_recognised(read.everything))
    heads = {s.head.indicator for s in read.everything if isinstance(s, Clause)}
    asked = {*SYSTEM_RELATIONS, *actions, *((name, arity) for name, arity in heads if name in seen and arity > 1)}
    asked |= {clause.head.indicator for clause in _conditions(read)}
    given: tuple[Indicator, ...] = (*ASKED, *((*RELATIONS, GOAL) if productions else ()))
    return Context(asked, [i for i in given if i not in heads], read.half_read, SHARING_NAMES | {*ASKED})


def _recognised(sentences: Iterable[Sentence]) -> Iterator[str]:
    """Names of the actions that the low level can see."""
    for sentence in sentences:
        if isinstance(sentence, Clause) and sentence.head.indicator in (("transition", 4), ("context", 3)):
            name = sentence.head[1 if sentence.head.functor == "transition" else 3]
            if isinstance(name, str):
                yield name


def _as_a_whole(folder: Path, read: _Read) -> Iterator[Finding]:
    """What only shows when the domain is put together; by then it should load."""
    try:
        domain = build(folder.name, folder, read.sentences)
    except CasperError as mistake:
        yield finding_of(mistake, Place(str(folder)))
        return
    yield from _asked_of(domain)
    yield from telling_apart.findings(domain.library)
    yield from _examples(folder, domain)


def _examples(folder: Path, domain: Domain) -> Iterator[Finding]:
    """The author's own tests, those that do not hold."""
    try:
        examples = examples_of(folder)
    except CasperError as mistake:
        yield finding_of(mistake, Place(str(folder / TESTS)))
        return
    for example in examples:
        wrong = failure(domain, example)
        if wrong is not None:
            yield error(example.place, f"this example does not hold: {wrong}")


def _unread_examples(folder: Path) -> Iterator[Finding]:
    """Mistakes in the text of the examples, where the domain itself cannot be asked."""
    try:
        examples_of(folder)
    except CasperError as mistake:
        yield finding_of(mistake, Place(str(folder / TESTS)))


def _asked_of(domain: Domain) -> Iterator[Finding]:
    if domain.verifies:
        yield from plans_nobody_can_do(domain)
    try:
        if domain.library.productions:
            domain.reading()
    except CasperError as mistake:  # its priors do not add up
        yield finding_of(mistake, Place(str(domain.folder)))
