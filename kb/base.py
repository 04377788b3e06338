"""The knowledge base: facts, rules and constraints, with everything one can ask of them.

    >>> kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    >>> kb.ask("agent(ann)"), list(kb.query("agent(X)"))
    (True, [{'X': 'ann'}])
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from casper.kb.goals.goals import Predicate
from casper.kb.program.refusals import undefined_sentence
from casper.kb.reasons.constraints import History
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.repair import Repair, repairs
from casper.kb.reasons.validity import Verdict
from casper.kb.reasons.why_not import Refusal, Violation
from casper.kb.store.judging import judged, nobody_defines, why, why_not
from casper.kb.store.known import MOST_INDEXED, Statement
from casper.kb.store.questions import Questions
from casper.kb.store.versioned import NO_HISTORY, of_one_moment
from casper.kb.terms.clauses import SYSTEM
from casper.kb.terms.terms import Compound, predication
from casper.kb.terms.unification import is_ground
from casper.kb.text.triples import triples_text
from casper.kb.top_down.answering import Answering

_NAMES = frozenset({str})  # what a statement is made of whose verdict is remembered: 1 and 1.0 would be one


class KnowledgeBase(Questions):
    """Relations that answer in every direction, with reasons.

    Every question sees one state, whatever other threads change meanwhile; so do several questions of one `snapshot`.
    What is asked without reasons is in `kb.store.questions`; authoring and change are in `kb.store.clause_store`.
    """

    # --- authoring -------------------------------------------------------------------------------------------------

    def facts(self, name: str, rows: Any, *, header: bool = True) -> None:
        """Load many facts of one predicate: ``kb.facts("edge", [("a", "b"), ("b", "c")])``, ``kb.facts("edge", path)``.

        Args:
            name: the predicate; its arity is the number of columns.
            rows: rows of constants, a numpy array (one or two dimensions, or structured), a pandas data frame, an Arrow
                table, or the path of a ``.csv``, ``.tsv`` or ``.parquet`` file.
            header: whether the first line of a CSV file names the columns.

        Raises:
            ProgramError: rows of different lengths, or something in them that is no constant, with row and column.
            ReadError: a file that cannot be read, with its line. CasperError: the library for it is not installed.
        """
        from casper.kb.relations.tables.sources import rows_of

        found, columns = rows_of(rows, header)
        if columns is not None:  # defined even without a row
            with self._changing():
                self._stated.dynamic.add((name, columns))
                self._forget()
        super().facts(name, found)

    # --- reasons ---------------------------------------------------------------------------------------------------

    @of_one_moment
    def why(self, statement: Statement) -> Proof | Doubt | None:
        """A proof of the statement (of its first instance, where it has unknown parts), or None when it fails.

        Of a statement that is undefined, the circle or the failed evaluation that makes it so.
        """
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        found = why(atom, self._model, self.solver)
        return replace(found, words=self.words) if isinstance(found, Proof) and self.words else found

    @of_one_moment
    def why_not(self, statement: Statement, history: History = NO_HISTORY) -> Refusal | None:
        """Why the statement is not provable or not valid; None when it is both."""
        atom = self._statement(statement)
        if atom.indicator == ("valid", 1) and isinstance(atom[1], (str, tuple)):
            return self.why_not(predication(atom[1]), history)
        refusal = self._refused_at_once(atom)
        found = why_not(atom, self._model, self._searches(history)) if refusal is None else refusal
        return found if found is None else replace(found, words=self.words)

    @of_one_moment
    def verify(self, statement: Statement, history: History = NO_HISTORY) -> Verdict:
        """Judge a statement: provable, and no constraint broken when it is claimed after the history.

        A statement whose predicate nobody defines is invalid, with a reason; it is not an error.
        """
        atom = self._statement(statement)
        refusal = self._refused_at_once(atom)
        verdict = self._judged(atom, history) if refusal is None else Verdict(atom, False, atom, refusal)
        if not self.words:
            return verdict
        refusal = None if verdict.refusal is None else replace(verdict.refusal, words=self.words)
        return replace(verdict, refusal=refusal, words=self.words)

    def _judged(self, atom: Compound, history: History) -> Verdict:
        """The verdict on a statement; one of names is remembered, unless what happened may change it."""
        if not _NAMES.issuperset(map(type, atom)) or (history and self._model.program.looks_back):
            return judged(atom, self._model, self._searches(history))
        verdicts = self._verdicts
        found = verdicts.get(atom)
        if found is None:
            found = judged(atom, self._model, self._searches(history))
            if found.valid is not None and len(verdicts) < MOST_INDEXED:
                verdicts[atom] = found
        return found

    def _refused_at_once(self, atom: Compound) -> Refusal | None:
        """The refusal of a statement whose predicate nobody defines."""
        if atom.indicator in self._model.program.clauses:
            return None
        return Refusal(atom, undefined=nobody_defines(atom.indicator, self._model, list(self._stated.statements)))

    def _searches(self, history: History) -> Callable[[], Answering]:
        """What makes searches over how it is now, after what happened earlier."""
        if not history:
            return self.solver
        return partial(self.solver, history=[(self._statement(statement), seconds) for statement, seconds in history])

    @of_one_moment
    def repair(self, statement: Statement, history: History = NO_HISTORY, limit: int = 3) -> list[Repair]:
        """The smallest changes of base facts that make the statement valid; none for one that is, or beyond mending."""
        return repairs(self, self._statement(statement), history, limit)

    @of_one_moment
    def broken(self) -> Sequence[Violation]:
        """The constraints that the facts alone break."""
        always, words = self._model.constraints.always, self.words
        return tuple(replace(found, sentence=words.constraint(found.sentence)) for found in always) if words else always

    def changed(self, repair: Repair) -> KnowledgeBase:
        """A copy of the knowledge base with facts added and removed; this one stays as it is."""
        return self.assume(*sorted(repair.add, key=repr), without=repair.remove)

    def row_counts(self) -> dict[str, int]:
        """How many rows each predicate has, by ``name/arity``, of those whose rows are listed."""
        return {f"{name}/{arity}": len(relation) for (name, arity), relation in self._model.relations.items()}

    # --- as RDF ----------------------------------------------------------------------------------------------------

    def to_rdf(self, derived: bool = False) -> str:
        """The stated facts as N-Triples (which is Turtle, too); with ``derived``, all that follows from them as well.

        A text that was imported from an ontology has its IRIs in iri/2, and gives its individuals back; a name without
        an IRI is under ``urn:casper:``. Predicates that are answered top-down have only their stated facts.
        """
        iris = {str(name): str(iri) for name, iri in self.rows("iri", 2)}
        data = {str(name) for (name,) in self.rows("data_property", 1)}
        datatypes = {str(name): str(datatype) for name, datatype in self.rows("datatype", 2)}
        stated = ((c.head.indicator, c.head.args) for c in self.clauses if not c.body and is_ground(c.head))
        rows = dict.fromkeys(stated)
        if derived:
            for indicator, relation in self._model.relations.items():
                rows.update(((indicator, tuple(row)), None) for row in relation)
        about = {("iri", 2), ("data_property", 1), ("datatype", 2)} if iris else set()
        facts = sorted(((i, row) for i, row in rows if i not in about), key=repr)
        return triples_text(((name, row) for (name, _), row in facts), iris, data, datatypes)

    # --- by name ---------------------------------------------------------------------------------------------------

    def __getattr__(self, name: str) -> Predicate:
        """A predicate by its name, to be used as a kanren goal constructor: ``kb.eat(x, "biscuits", "plate")``."""
        if name.startswith("_"):
            raise AttributeError(name)
        found = self.__dict__[name] = self.predicate(name)  # the next look finds it without coming here
        return found

    def predicate(self, name: str) -> Predicate:
        """A predicate by its name, also one that is called like a method of this class.

        Raises:
            AttributeError: nothing defines the name.
        """
        known = self._model.program.clauses
        if all(name != defined for defined, _ in (*known, *SYSTEM)):
            raise AttributeError(undefined_sentence((name, 0), known))
        return Predicate(self, name)
