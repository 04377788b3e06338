"""Whatever a domain's text says, a page shows it and obeys none of it."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from markup import parsed, words

from casper import Domain
from casper.engine.events.curves import focus_curve
from casper.engine.events.event import Event
from casper.kb.terms.writeq import writeq
from casper.kb.text.lines import visible
from casper.notebook.markup import tag, text

EVIL = "</code></style><script>alert(1)</script><img src=x onerror=alert(1)>\"'&"
NAME = writeq(EVIL)
HOME = Domain.from_text(
    ontology=f"human(ann). robot({NAME}). cup({NAME}).\nsip(A, C) :- human(A), cup(C).\nfill(A, C) :- robot(A), cup(C).\n"
    f"never({NAME}) :- claim(sip(_, C)), did(sip(_, C), _).\n",
    plans=f"tea --> sip({NAME}), fill({NAME}).\n",
)


def things():
    reading = HOME.reading()
    reading.observe(f"sip({NAME})")
    curve = focus_curve(
        [Event("focus", t, {"target": EVIL, "destination": None, "scores": {EVIL: 0.5}}) for t in (0.0, 9.0)]
    )
    kb, robot = HOME.kb, EVIL
    return [
        HOME, HOME.library, HOME.library.ways[0], reading, reading.first, reading.plan_for(robot), curve,
        kb.why(f"sip(ann, {NAME})"), kb.why_not(f"sip({NAME}, {NAME})"), kb.verify(f"sip({NAME}, {NAME})"),
        *kb.repair(f"sip({NAME}, {NAME})"), kb.plan(f"sip(X, {NAME})"),
    ]  # fmt: skip


@pytest.mark.parametrize("thing", things(), ids=lambda thing: type(thing).__name__)
def test_no_text_of_a_domain_becomes_a_tag(thing):
    for shown in filter(None, (thing._repr_html_(), thing._repr_svg_())):
        root = parsed(shown)
        assert not [e.tag for e in root.iter() if e.tag in ("script", "img", "style")]
        assert not [name for e in root.iter() for name in e.attrib if name.startswith("on") or name == "href"]
        assert "alert(1)" in words(root)


@settings(max_examples=50)
@given(st.text(), st.text())
def test_any_text_is_shown_as_it_is_or_spelt_out(inside, attribute):
    root = parsed(str(tag("p", inside, title=attribute)))
    assert len(root) == 0
    assert (root.text or "") == visible(inside, keep="\n\t")


def test_what_turns_the_direction_of_writing_is_spelt_out():
    assert text("a\u202eb\x00") == r"a\u202eb\x00"
