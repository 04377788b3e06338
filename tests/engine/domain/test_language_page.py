"""docs/language.md says what is so: it has every word of the language, and its refusals are refused."""

import pytest
from pages import DOCS, blocks_of

from casper.engine.domain.domain import FILES
from casper.engine.domain.relations import SECTIONS, SYSTEM_RELATIONS
from casper.kb.base import KnowledgeBase
from casper.kb.checks.check import check_text
from casper.kb.errors import CasperError
from casper.kb.terms.clauses import SYSTEM
from casper.plans.grammar.expansion import SHAPES

PAGE = (DOCS / "language.md").read_text()


def test_every_shape_of_plans_is_on_the_page():
    for shape in SHAPES:
        assert f"`{shape}" in PAGE or f"{shape} " in PAGE


def test_every_relation_of_the_system_and_every_section_and_file_is_on_the_page():
    for name, arity in SYSTEM_RELATIONS - {("goal", 1), ("setting", 3)}:
        assert f"`{name}/{arity}`" in PAGE
    for name, arity in SYSTEM:
        assert f"`{name}/{arity}`" in PAGE
    for word in (*SECTIONS, *FILES):
        assert f"`{word}`" in PAGE or f"({word}, " in PAGE


@pytest.mark.parametrize(
    "text",
    [
        "p(X) :- nobody(X).", "q(1). p(X) :- q(Y), X is foo + Y.", "p(N) :- aggregate_all(count, p(_), N).", "q(a). p :- \\+ q(X).", "p :- \\+ (a, b).", "never(a).", "claim(x).",
        "p :- q, !. q.", "q. p :- assertz(q).", ":- op(1201, xfx, foo).", "a = b.",
    ],
)  # fmt: skip
def test_what_the_page_says_is_refused_is_refused(text):
    with pytest.raises(CasperError):
        KnowledgeBase.from_text(text)
    assert any(f.severity == "error" for f in check_text(text))


def test_the_python_example_prints_what_reads_in_again(capsys):
    (code,) = [block.text for block in blocks_of(DOCS / "language.md") if "Author()" in block.text]
    scope: dict = {}
    exec(compile(code, "language.md", "exec"), scope)
    assert KnowledgeBase.from_text(capsys.readouterr().out).clauses == scope["kb"].clauses
    assert scope["kb"].verify("wave(ann, bob)").reasons == ("nobody waves at bob",)


def test_the_example_of_a_finding_is_what_is_found():
    (finding,) = check_text("human(ann).\n" * 1 + "\n" * 5 + "agent(X) :- humn(X).", "home/ontology.pl")
    assert str(finding) in PAGE
