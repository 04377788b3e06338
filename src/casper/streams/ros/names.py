"""What frames and classes are called in a domain: a text of facts.

    fixed(map).                          % the frame that places are told in
    agent(human, 'person_1/base').       % a frame, or the class of a detection
    hand(human, 'person_1/right_hand').  % what is there is held
    object(plate, plate_link).
    object(glass, cup).
    objects(chair, 'Chair').             % a class of which there are several: chair_1, chair_2, … as they are detected
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from casper.kb.errors import DomainError, ReadError
from casper.kb.terms.clauses import Clause
from casper.kb.text.reader import read_file

KINDS = {"fixed": 1, "agent": 2, "hand": 2, "object": 2, "objects": 2}


@dataclass(frozen=True)
class Names:
    """Names in the domain by frame, class or identifier.

    ``fixed`` is None where the root of the frames is to be taken. Without ``is_complete`` every class of a detection
    that has no name here is an object of its own name. ``several`` are classes of which there is more than one thing.
    """

    agents: Mapping[str, str] = field(default_factory=dict)
    objects: Mapping[str, str] = field(default_factory=dict)
    hands: Mapping[str, str] = field(default_factory=dict)
    fixed: str | None = None
    is_complete: bool = False
    several: Mapping[str, str] = field(default_factory=dict)

    def of_several(self, *labels: str) -> str | None:
        """The kind of thing that one of the labels is a class of, if there are several."""
        return next((self.several[label] for label in labels if label in self.several), None)

    def of_detection(self, *labels: str) -> tuple[str, bool] | None:
        """The name that one of the labels has, and whether it is an agent's."""
        for label in labels:
            if label in self.agents:
                return self.agents[label], True
            if label in self.objects:
                return self.objects[label], False
        return None if self.is_complete or not labels[-1] else (labels[-1], False)


def read_names(file: Path) -> Names:
    """Read them.

    Raises:
        ReadError: a mistake in the text, with its line. DomainError: it cannot be read, or names nobody.
    """
    found: dict[str, dict[str, str]] = {kind: {} for kind in KINDS}
    for clause in read_file(file):
        if not isinstance(clause, Clause) or clause.body or KINDS.get(clause.head.functor) != len(clause.head.args):
            told = ", ".join(f"{kind}/{arity}" for kind, arity in KINDS.items())
            raise ReadError(f"only facts of {told} say what frames are called", clause.place)
        *name, frame = clause.head.args
        if not all(isinstance(arg, str) for arg in clause.head.args):
            raise ReadError("a frame is a name; write it in quotes: 'person_1/base'", clause.place)
        table = found[clause.head.functor]
        if frame in table:
            raise ReadError(f"{frame} is named twice", clause.place)
        table[str(frame)] = str(name[0]) if name else str(frame)
    if not found["agent"]:
        raise DomainError(f"{file} names nobody who acts; write agent(human, FRAME)")
    fixed = next(iter(found["fixed"]), None)
    return Names(found["agent"], found["object"], found["hand"], fixed, is_complete=True, several=found["objects"])
