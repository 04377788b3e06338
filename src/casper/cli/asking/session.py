"""A conversation with a domain: one line in, the answer out. ``casper repl`` reads the lines; tests may, too."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from casper.cli.terminal.hints import hints
from casper.cli.terminal.output import console
from casper.cli.terminal.showing import say, show
from casper.engine.domain.domain import Domain
from casper.engine.domain.reload import carried_over, reloaded
from casper.engine.reading.printing import rejected_text, shares_text
from casper.kb.errors import BudgetExceeded, CasperError
from casper.kb.terms.clauses import Clause, Production
from casper.kb.text.writer import answer_text, indicators_text, sentence_text

if TYPE_CHECKING:
    from casper.engine.reading.reading import Reading

PAGE = 10  # answers shown at once
HELP = """\
  eat(A, T, D), \\+ D = sink   answers, ten at a time; ; shows more
  why eat(human, meal, plate)      the proof
  why not eat(tiago, meal, plate)  the reasons against it
  repair eat(human, bottle, plate) what would make it valid
  observe eat(biscuits, plate)     take in an action of the partner
  explain                          what was observed speaks for these goals
  undo                             take the last observation back
  listing, listing wash            the names there are; the clauses of one
  :reload                          read the changed files; observations are kept
  :help   :quit"""


class Session:
    """Answers lines about one domain; it remembers what was observed and the question whose answers go on."""

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.out = console()
        self._reading: Reading | None = None
        self._more: Iterator[str] | None = None
        self._asked = ""  # whose answers go on
        self._commands: dict[str, Callable[[str], None]] = {
            "why not": self._why_not,
            "why": self._why,
            "repair": self._repair,
            "observe": self._observe,
            "explain": self._explain,
            "undo": self._undo,
            "listing": self._listing,
            ":reload": self._reload,
            ":help": self._help,
            ";": self._next_page,
        }

    def answer(self, line: str) -> None:
        """Print the answer to one line; a mistake is a sentence like any other and ends nothing."""
        line = line.strip().removeprefix("?-").strip()
        if not line or line.startswith("%"):
            return
        try:
            self._dispatch(line)
        except BudgetExceeded as mistake:
            self._say(f"unknown: {mistake}")
        except CasperError as mistake:
            self._say(str(mistake))
        except RecursionError:
            self._say("this goes too deep to be answered")
        except KeyboardInterrupt:
            self._say("stopped")
        except Exception as mistake:  # a fault of ours: told in full, but no reason to lose what was observed
            self._say(f"casper itself failed at this: {type(mistake).__name__}: {mistake}")

    def completions(self, line: str, word: str) -> list[str]:
        """What the last word of a line may become: a command at its start, a predicate, task or action anywhere."""
        typed = len(line) - len(word)
        commands = [f"{command} " for command in self._commands if command != ";"]
        fitting = [command[typed:] for command in (*commands, ":quit") if command.startswith(line)]
        library = self.domain.library
        names = {name for name, _ in (*self._indicators(), *library.tasks, *library.actions)}
        return [*dict.fromkeys(fitting), *sorted(name for name in names if name.startswith(word))]

    def _dispatch(self, line: str) -> None:
        for command, act in self._commands.items():
            rest = line.removeprefix(command)
            if rest != line and (not rest or rest[0].isspace()):
                act(rest.strip().removesuffix(".").strip())
                return
        if line.startswith(":"):
            self._say(f"there is no command {line}; :help lists them")
            return
        self._more, self._asked = self._answers(line), line
        self._next_page("")

    # --- questions -------------------------------------------------------------------------------------------------

    def _answers(self, goal: str) -> Iterator[str]:
        for answer in self.domain.kb.query(goal):
            yield answer_text(answer)

    def _next_page(self, rest: str) -> None:
        if self._more is None:
            self._say("there is nothing more to show")
            return
        answers, self._more, shown = self._more, None, 0
        for text in islice(answers, PAGE):
            self._say(text)
            shown += 1
        following = next(answers, None) if shown == PAGE else None
        if following is not None:
            self._more = _chained(following, answers)
            self._say("…   ; shows more")
        elif shown == 0:
            self._say("no")
            self._hint(self._asked)

    def _hint(self, question: str) -> None:
        """Names in the question that the domain has nowhere."""
        for sentence in hints(self.domain, [question]):
            self._say(sentence)

    def _why(self, statement: str) -> None:
        proof = self.domain.kb.why(statement)
        self._say(str(proof) if proof is not None else f"it does not hold; ask: why not {statement}")

    def _why_not(self, statement: str) -> None:
        refusal = self.domain.kb.why_not(statement)
        self._say("it holds and breaks no constraint" if refusal is None else str(refusal))
        if refusal is not None:
            self._hint(statement)

    def _repair(self, statement: str) -> None:
        kb = self.domain.kb
        found = kb.repair(statement)
        for repair in found:
            self._say(str(repair))
        if not found:
            valid = kb.verify(statement).valid
            self._say("it is valid as it is" if valid else "no small change of facts makes it valid")

    # --- observations ----------------------------------------------------------------------------------------------

    @property
    def reading(self) -> Reading:
        """The reading of what was observed in this session."""
        if self._reading is None:
            self._reading = self.domain.reading()
        return self._reading

    def _observe(self, action: str) -> None:
        self.reading.observe(action)
        if self.reading.count == 0:
            reasons = rejected_text(self.reading.rejected)
            self.reading.undo()
            self._say(f"{action} fits no plan and is left out ({reasons})")
            return
        self._say(shares_text(self.reading))

    def _explain(self, rest: str) -> None:
        if self.reading.observations:
            show(self.out, self.reading.lines())
        else:
            self._say("nothing was observed yet: observe an action")

    def _undo(self, rest: str) -> None:
        last = self.reading.observations[-1:]
        self.reading.undo()
        self._say(f"{last[0]} is taken back")

    # --- the domain ------------------------------------------------------------------------------------------------

    def _indicators(self) -> list[tuple[str, int]]:
        return list(dict.fromkeys(clause.head.indicator for clause in self.domain.kb.clauses))

    def _listing(self, wanted: str) -> None:
        if not wanted:
            self._say(indicators_text(self._indicators()))
            return
        name, _, arity = wanted.partition("/")
        sentences: list[Clause | Production] = [*self.domain.kb.clauses, *self.domain.library.productions]
        found = [s for s in sentences if s.head.functor == name and arity in ("", str(s.head.arity))]
        for sentence in found:
            self._say(sentence_text(sentence))
        if not found:
            self._say(f"there is no {wanted} here; listing shows what there is")

    def _reload(self, rest: str) -> None:
        domain = reloaded(self.domain)
        if domain is self.domain:
            self._say("no file has changed")
            return
        dropped: Sequence[object] = ()
        if self._reading is not None:
            self._reading, dropped = carried_over(self._reading, domain)
        self.domain, self._more = domain, None
        self._say(f"{domain.name} was read anew")
        for lost in dropped:
            self._say(str(lost))

    def _help(self, rest: str) -> None:
        self._say(HELP)

    def _say(self, text: str) -> None:
        say(self.out, text)


def _chained(first: str, rest: Iterator[str]) -> Iterator[str]:
    yield first
    yield from rest
