"""The terminal shows what ``print`` shows: it adds colours and takes no text of a domain for markup."""

import io
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from readings import KITCHEN, reading
from rich.console import Console

from casper.cli.terminal.plain import visible
from casper.cli.terminal.showing import STYLES, say, show
from casper.kb.text.lines import Span, line, text_of

# Marks that turn the direction of writing are spelled out, as control characters are: `visible`.
SPANS = st.builds(Span, st.text(st.characters(exclude_categories=["Cs", "Cc", "Zl", "Zp"])), st.sampled_from(list(STYLES)))
ONTOLOGY = (
    "human(ann). cup('a:x:b'). cup('[bold]').\nfill(A, C) :- human(A), cup(C).\nsip(A, C) :- human(A), cup(C).\n"
    'never("not the [red]bold[/] one :smile:") :- claim(sip(_, \'[bold]\')).\n'
)
PLANS = "goal(tea(C)) :- cup(C).\ntea(C) --> fill(C), sip(C).\n"


def shown(lines, **options):
    out = io.StringIO()
    show(Console(file=out, highlight=False, soft_wrap=True, **options), lines)
    return out.getvalue()


@pytest.fixture
def home(tmp_path):
    (tmp_path / "ontology.pl").write_text(ONTOLOGY)
    (tmp_path / "plans.pl").write_text(PLANS)
    return str(tmp_path)


@given(st.lists(SPANS))
def test_without_colours_it_is_the_text_itself(spans):
    assert shown([line(*spans)]) == f"{visible(text_of([line(*spans)]))}\n"


@given(st.lists(SPANS))
def test_colours_are_all_that_a_terminal_adds(spans):
    coloured = shown([line(*spans)], force_terminal=True, color_system="standard", legacy_windows=False)
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured) == f"{visible(text_of([line(*spans)]))}\n"


def test_roles_are_coloured():
    coloured = shown([line(Span("✔", "good"))], force_terminal=True, color_system="standard", legacy_windows=False)
    assert coloured == "\x1b[32m✔\x1b[0m\n"


def test_a_control_character_of_a_domain_is_spelled_out():
    out = io.StringIO()
    say(Console(file=out), "a\x1b[31mb\x07\tc")
    assert out.getvalue().startswith("a\\x1b[31mb\\x07")


def test_explain_shows_what_the_reading_prints(casper):
    assert casper("explain", "kitchen", "pick_and_place").out == f"{reading('pick_and_place')}\n"
    both = f"{reading('pick_and_place')}\n{reading('pick_and_place', 'eat')}\n"
    assert casper("explain", "kitchen", "pick_and_place", "eat").out == both


def test_verify_shows_what_the_verdict_prints_and_then_what_would_mend_it(casper):
    statement = "eat(human, bottle, plate)"
    told = casper("verify", "kitchen", statement).out
    assert told == f"{KITCHEN.kb.verify(statement)}\n  it would be: add eatable(bottle)\n"


def test_the_conversation_explains_by_the_same_printer(casper):
    told = casper("repl", "kitchen", stdin="observe eat\nexplain\n").out
    assert told.endswith(f"{reading('eat')}\n")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["explain", "fill('a:x:b')"], "tea('a:x:b')"),
        (["explain", "fill('[bold]')"], "● fill('[bold]')"),
        (["verify", "fill(ann, 'a:x:b')"], "✔ fill(ann, 'a:x:b') is valid"),
        (["verify", "sip(ann, '[bold]')"], "because not the [red]bold[/] one :smile:"),
        (["query", "cup(X)"], "X = 'a:x:b'\nX = '[bold]'"),
    ],
)
def test_codes_of_markup_and_emoji_are_shown_as_they_are(casper, home, arguments, line):
    command, *rest = arguments
    assert line in casper(command, home, *rest).out


def test_they_are_in_a_conversation_too(casper, home):
    told = casper("repl", home, stdin="cup(X)\nobserve fill('[bold]')\nwhy not sip(ann, '[bold]')\nlisting cup\n").out
    for text in ("X = 'a:x:b'", "tea 1.00", "not the [red]bold[/] one :smile:", "cup('[bold]')."):
        assert text in told
