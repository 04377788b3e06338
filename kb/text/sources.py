"""Texts made of several files: ``:- include("other.pl").`` and ``:- use("folder", as(prefix)).``

``include`` reads another file as if it stood here, with the operators in force there; what it declares is in force
after the line. A file is read once, however often it is included. ``use`` makes the predicates of another text
available under a prefix (`namespace`): of a file, or of a folder's ontology.pl; its operators are its own. Both names
are relative to the file that has the line; what is not beside it is looked for among the shipped texts. Only regular
files are read, up to a size each and together, and of a file outside the domain's folder and the shipped ones no
mistake shows any text: a domain may come from anybody.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

from casper.kb.errors import CasperError, DomainError, Place, ProgramError, ReadError
from casper.kb.terms.clauses import Directive, Sentence
from casper.kb.terms.operators import STANDARD, Operators
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.files import is_there, is_within, oddity, read_bytes, real
from casper.kb.text.namespace import prefixed
from casper.kb.text.reader import Told, read_file

MAIN = "ontology.pl"  # what is used of a folder
MOST_ALTOGETHER = 256 * 2**20  # bytes of all files of a domain
MOST_OPEN = 50  # files within files
_INCLUDE, _USE = ("include", 1), ("use", 2)


def _refuse(mistake: CasperError) -> NoReturn:
    raise mistake


@dataclass
class _Inserted:
    """What an include stands for, and the operators in force after it."""

    operators: Operators
    sentences: list[Sentence] = field(default_factory=list)
    mistake: CasperError | None = None


@dataclass
class Sources:
    """Reads files with what they include and use.

    Args:
        roots: folders in which what is not beside the file is looked for: the shipped domains.
        read: how one file is read, with the operators in force, and told of each directive as it is reached.
        mistake: what happens to a mistake; by default it is raised, ``casper check`` collects them.

    ``files`` are all the files that were read so far, in order.
    """

    roots: Sequence[Path] = ()
    read: Callable[[Path, Operators, Told], list[Sentence]] = read_file
    mistake: Callable[[CasperError], None] = _refuse
    files: list[Path] = field(default_factory=list)
    _open: list[Path] = field(default_factory=list)  # the files whose reading is under way, outermost first
    _read: set[Path] = field(default_factory=set)
    _prefixes: dict[str, Path] = field(default_factory=dict)
    _operators: Operators = field(default_factory=STANDARD.copy)  # in force where the reading is
    _inserted: dict[Place, _Inserted] = field(default_factory=dict)  # what stands for each include
    _sizes: dict[Path, int] = field(default_factory=dict)  # bytes of what was read, by anybody

    def sentences(self, file: Path) -> list[Sentence]:
        """Every sentence of the file, with those of the files it includes and uses in their place.

        Raises:
            DomainError, ReadError: as `kb.text.reader.read_file`.
            ProgramError: with the place of the line, when a file is missing or no regular one, contains itself, is
                one too many, or a prefix is taken.
        """
        self._operators = STANDARD.copy()
        return self._sentences(file)

    def _sentences(self, file: Path) -> list[Sentence]:
        """As `sentences`, with the operators in force."""
        known = real(file)
        if known in self._read:
            return []
        self._read.add(known)
        self.files.append(known)
        self._open.append(file)
        try:
            return [s for sentence in self._content(file) for s in self._expanded(sentence, file.parent)]
        except CasperError as mistake:
            self.mistake(mistake)
            return []
        finally:
            self._open.pop()

    def _insert(self, directive: Directive, folder: Path) -> None:
        """Read what is included as soon as the line is reached: what it declares is in force from there on.

        A line may be reached again where the reader starts anew after a mistake.
        """
        if directive.term.indicator != _INCLUDE:
            return
        found = self._inserted.get(directive.place)
        if found is not None:
            self._operators.become(found.operators)
            return
        found = self._inserted[directive.place] = _Inserted(self._operators)
        try:
            found.sentences = self._sentences(self._included(directive, folder))
        except CasperError as mistake:
            try:
                self.mistake(mistake)
            except CasperError as raised:
                found.mistake = raised
        found.operators = self._operators.copy()

    def is_foreign(self, file: Path) -> bool:
        """Whether a file lies outside the folder of what is being read, and outside the roots."""
        return not is_within(file, (self._open[0].parent, *self.roots))

    def _content(self, file: Path) -> list[Sentence]:
        self._check_size(file)
        try:
            return self.read(file, self._operators, lambda directive: self._insert(directive, file.parent))
        except ReadError as mistake:
            raise _discreet(mistake) if self.is_foreign(file) else mistake from None

    def _check_size(self, file: Path) -> None:
        with suppress(OSError):  # then reading it says so
            self._sizes[real(file)] = file.stat().st_size
        if sum(self._sizes.values()) > MOST_ALTOGETHER:
            most = f"{MOST_ALTOGETHER // 2**20} MiB, the most that is read of a domain"
            raise DomainError(f"with {file} the files of this domain are larger than {most}")

    def _expanded(self, sentence: Sentence, folder: Path) -> Iterator[Sentence]:
        if not (isinstance(sentence, Directive) and sentence.term.indicator in (_INCLUDE, _USE)):
            yield sentence
        elif sentence.term.indicator == _INCLUDE:
            self._insert(sentence, folder)  # a reader of the caller's own may have told nothing
            found = self._inserted[sentence.place]
            if found.mistake is not None:
                raise found.mistake
            yield from found.sentences
        else:
            try:
                yield from self._used(sentence, folder)
            except CasperError as mistake:
                self.mistake(mistake)

    def _included(self, directive: Directive, folder: Path) -> Path:
        for place in (folder, *self.roots):
            file = place / _name(directive)
            if is_there(file):
                _check_regular(file, directive)
                self._check_circle(file, directive)
                return file
        raise ProgramError(f"there is no file {_name(directive)} to include beside this one", directive.place)

    def _used(self, directive: Directive, folder: Path) -> Iterator[Sentence]:
        prefix, file = _prefix(directive), self._found(_name(directive), directive, folder)
        known = self._prefixes.setdefault(prefix, real(file))
        if known != real(file):
            raise ProgramError(f"the prefix {prefix} already stands for {known}; choose another one", directive.place)
        self._check_circle(file, directive)
        inner = Sources(self.roots, self.read, self.mistake, self.files, self._open, _sizes=self._sizes)
        key = Path(f"{prefix}:{real(file)}")  # the same line in two included files adds nothing
        if key not in self._read:
            self._read.add(key)
            yield from prefixed(inner.sentences(file), prefix)

    def _found(self, name: str, directive: Directive, folder: Path) -> Path:
        for place in (folder, *self.roots):
            file = place / name / MAIN if os.path.isdir(place / name) else place / name
            if is_there(file):
                _check_regular(file, directive)
                return file
        sentence = f"there is no domain {name} to use: give a file, or a folder with an {MAIN}, beside this one"
        raise ProgramError(sentence, directive.place)

    def _check_circle(self, file: Path, directive: Directive) -> None:
        known = [real(path) for path in self._open]
        if real(file) in known:
            names = [path.name for path in self._open[known.index(real(file)) :]]
            circle = " needs ".join([*names, file.name])
            raise ProgramError(f"this file contains itself ({circle}); take the line out", directive.place)
        if len(self._open) >= MOST_OPEN:
            sentence = f"files may stand within files {MOST_OPEN} deep, and this is one more; include it further up"
            raise ProgramError(sentence, directive.place)


def _check_regular(file: Path, directive: Directive) -> None:
    odd = oddity(file)
    if odd is not None:
        raise ProgramError(f"{file} is {odd}, and only regular files are read", directive.place)


def _discreet(mistake: ReadError) -> ReadError:
    """The mistake without anything of the text it was found in."""
    assert mistake.place is not None
    told = mistake.sentence.replace(mistake.quoted, "something", 1) if mistake.quoted else mistake.sentence
    return ReadError(f"{told} (its line is not shown, as the file lies outside the domain's folder)", mistake.place)


def fingerprint(files: Iterable[Path]) -> str:
    """A text that is another one as soon as a file has changed, has gone, or has come."""
    told = hashlib.sha256()
    for file in sorted(set(files)):
        try:
            content = hashlib.sha256(read_bytes(file)).hexdigest()
        except OSError:  # what cannot be read, or is no regular file
            content = "nothing"
        told.update(f"{file}\n{content}\n".encode())
    return told.hexdigest()


def _name(directive: Directive) -> str:
    name = directive.term[1]
    if not isinstance(name, str) or not name:
        shown = term_text(as_term(directive.term))
        raise ProgramError(f'{shown} names no file: write include("other.pl")', directive.place)
    return name


def _prefix(directive: Directive) -> str:
    given = directive.term[2]
    if isinstance(given, Compound) and given.indicator == ("as", 1):
        prefix = given[1]
        if isinstance(prefix, str) and prefix.isidentifier() and prefix[0].islower():
            return prefix
    shown = term_text(as_term(directive.term))
    raise ProgramError(f'{shown} has no prefix: write use("folder", as(prefix))', directive.place)
