"""Examples in a domain's text: the author's own tests, tried out by ``casper check``."""

from pathlib import Path

import pytest

from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import Domain
from casper.engine.domain.examples import examples_of, failure

ONTOLOGY = """
human(ann). robot(bot). food(bread). drinkable(tea).
drink(A, D) :- human(A), drinkable(D). medicine(pills).
eat(A, F) :- human(A), food(F).
take(A, M) :- human(A), medicine(M), did(eat(A, _), T), T < 60.
never("nobody takes pills twice") :- claim(take(A, M)), did(take(A, M), _).
"""
PLANS = "meal --> eat(bread), drink(tea). cure --> eat(bread), take(pills)."


def folder_of(tmp_path: Path, tests: str) -> Path:
    (tmp_path / "ontology.pl").write_text(ONTOLOGY, encoding="utf-8")
    (tmp_path / "plans.pl").write_text(PLANS, encoding="utf-8")
    (tmp_path / "tests.pl").write_text(tests, encoding="utf-8")
    return tmp_path


def told(tmp_path: Path, tests: str) -> list[str]:
    """The errors that are found in the examples."""
    findings = check_domain(folder_of(tmp_path, tests))
    return [finding.message for finding in findings if finding.place.file.endswith("tests.pl")]


@pytest.mark.parametrize(
    "example",
    [
        "example(valid, eat(ann, bread)).",
        "example(invalid, eat(bot, bread)).",
        'example(invalid, eat(bot, bread), "not a human").',
        "example(valid, take(ann, pills), [did(eat(ann, bread), 59.5)]).",
        "example(invalid, take(ann, pills), \"\", [did(eat(ann, bread), 60)]).",
        'example(invalid, take(ann, pills), "twice", [did(eat(ann, bread), 6), did(take(ann, pills), 70)]).',
        "example(reads, [eat(bread), take(pills)], cure).",
        "% nothing but a comment",
    ],
)
def test_an_example_that_holds_is_not_worth_a_word(tmp_path: Path, example: str) -> None:
    assert told(tmp_path, example) == []


@pytest.mark.parametrize(
    "example, words",
    [
        ("example(valid, eat(bot, bread)).", "eat(bot, bread) is not valid, because bot is not a human"),
        ("example(invalid, eat(ann, bread)).", "eat(ann, bread) is valid, and should not be"),
        ('example(invalid, eat(bot, bread), "no food").', "but not because 'no food': bot is not a human"),
        ("example(invalid, et(bot, bread)).", ""),
        ("example(valid, et(ann, bread)).", "did you mean eat?"),
        ("example(reads, [eat(bread)], cure).", "leaves the goal open"),
        ("example(reads, [eat(bread), take(pills)], meal).", "reads as cure"),
        ("example(reads, [eat(bread), take(pills), drink(tea)], cure).", "drink(tea), action 3, fits no plan"),
        ("example(reads, [take(pills)], cur).", "did you mean cure?"),
        ("example(reads, [tak(pills)], cure).", "did you mean take?"),
        ("example(reads, [], cure).", "reads as nothing"),
        ("example(reads, eat, cure).", "no list"),
        ("example(valid, 5).", "no statement"),
        ("example(valid, eat(ann, bread), [eat]).", "did(Statement, Seconds)"),
        ("example(invalid, eat(ann, bread), 5).", "a reason is a text"),
        ("example(right, eat(ann, bread)).", "example(valid, Statement)"),
        ("eat(ann, bread).", "holds examples only"),
        ("example(valid, eat(ann, bread)) :- human(ann).", "holds examples only"),
        ("example(valid, eat(ann, ", "the text ends here"),
    ],
)
def test_an_example_that_does_not_hold_is_told_with_what_is_so(tmp_path: Path, example: str, words: str) -> None:
    found = told(tmp_path, f"\n{example}")
    assert len(found) == (1 if words else 0) and all(words in message for message in found)


def test_a_failing_example_has_its_place_and_makes_the_check_fail(tmp_path: Path) -> None:
    (finding,) = [f for f in check_domain(folder_of(tmp_path, "\n\nexample(valid, eat(bot, bread)).")) if f.severity == "error"]
    assert (finding.place.line, finding.place.column) == (3, 1)


def test_mistakes_in_the_examples_are_told_also_where_the_domain_is_broken(tmp_path: Path) -> None:
    folder = folder_of(tmp_path, "example(right, x).")
    (folder / "plans.pl").write_text("meal --> .", encoding="utf-8")
    files = {Path(f.place.file).name for f in check_domain(folder) if f.severity == "error"}
    assert files == {"plans.pl", "tests.pl"}


def test_examples_are_no_part_of_the_domain(tmp_path: Path) -> None:
    domain = Domain.load(folder_of(tmp_path, "example(valid, eat(ann, bread))."))
    assert not domain.kb.defines("example", 2)


def test_a_domain_without_ontology_has_no_valid_statements(tmp_path: Path) -> None:
    folder = folder_of(tmp_path, "example(valid, eat(ann, bread)).\nexample(reads, [take], cure).")
    (folder / "ontology.pl").unlink()
    (folder / "plans.pl").write_text("meal --> eat. cure --> take.", encoding="utf-8")
    domain = Domain.load(folder)
    first, second = examples_of(folder)
    assert "no ontology.pl" in failure(domain, first) and failure(domain, second) is None


def test_the_kitchen_s_examples_hold() -> None:
    kitchen = Domain.load("kitchen")
    examples = examples_of(kitchen.folder)
    assert len(examples) >= 8 and [failure(kitchen, example) for example in examples] == [None] * len(examples)
