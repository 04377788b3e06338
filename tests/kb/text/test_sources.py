"""Texts of several files: include and use, and the mistakes one can make with them."""

import os
import re

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound, make_list
from casper.kb.text import sources
from casper.kb.text.namespace import prefixed
from casper.kb.text.reader import read_query, read_statement, read_text
from casper.kb.text.sources import Sources, fingerprint
from casper.kb.text.writer import program_text


def written(folder, **files):
    for name, text in files.items():
        path = folder / f"{name.replace('__', '/')}.pl"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    return folder / "main.pl"


def loaded(file, roots=()):
    kb = KnowledgeBase()
    kb.add(Sources(roots).sentences(file))
    return kb


# --- include --------------------------------------------------------------------------------------------------------


def test_an_included_file_stands_where_the_line_stands(tmp_path):
    main = written(tmp_path, main='p(a).\n:- include("other.pl").\np(c).\n', other="p(b).\n")
    assert [row for (row,) in loaded(main).rows("p", 1)] == ["a", "b", "c"]


def test_it_is_looked_for_beside_the_file_that_includes_it(tmp_path):
    main = written(tmp_path, main=':- include("parts/one.pl").', parts__one=':- include("two.pl").', parts__two="p(a).")
    assert loaded(main).ask("p(a)")


def test_a_clause_of_an_included_file_knows_its_own_place(tmp_path):
    main = written(tmp_path, main=':- include("other.pl").', other="p(a).\nq(X) :- r(X).\n")
    with pytest.raises(CasperError, match=r"other\.pl:2:9: nothing defines r/1"):
        loaded(main).compile()


def test_a_file_is_read_once_however_often_it_is_included(tmp_path):
    main = written(tmp_path, main=':- include("a.pl").\n:- include("b.pl").', a=':- include("c.pl").', b=':- include("c.pl").', c="t --> s.")
    assert len(Sources().sentences(main)) == 1


# --- use ------------------------------------------------------------------------------------------------------------

HOME = """\
food(bread).
cat(tom).
eat(A, T) :- cat(A), food(T), T \\= fish.
tidy(A) :- cat(A), \\+ did(eat(A, _), _).
:- dynamic(fresh/1).
never("cats eat fresh things") :- claim(eat(_, T)), \\+ fresh(T).
never("nothing twice") :- claim(S), S = eat(A, T), did(eat(A, T), _).
"""


def test_the_predicates_of_a_used_text_bear_its_prefix(tmp_path):
    main = written(tmp_path, main=':- use("home.pl", as(home)).\nfood(stone).\nmine(X) :- home:food(X), \\+ food(X).\n', home=HOME)
    kb = loaded(main)
    assert list(kb.query("mine(X)")) == [{"X": "bread"}]
    assert list(kb.query("home:eat(A, T)")) == [{"A": "tom", "T": "bread"}]
    assert list(kb.query("food(X)")) == [{"X": "stone"}]
    assert not kb.defines("eat", 2)


def test_of_a_folder_its_ontology_is_used(tmp_path):
    main = written(tmp_path, main=':- use("house", as(h)).', house__ontology=':- include("more.pl").', house__more="food(bread).")
    assert loaded(main).ask("h:food(bread)")


def test_a_domain_can_be_used_by_its_name_where_there_are_roots(tmp_path):
    main = written(tmp_path, main=':- use("house", as(h)).')
    (tmp_path / "shipped" / "house").mkdir(parents=True)
    (tmp_path / "shipped" / "house" / "ontology.pl").write_text("food(bread).")
    assert loaded(main, [tmp_path / "shipped"]).ask("h:food(bread)")


def test_a_file_that_is_not_beside_is_included_from_the_roots_and_one_that_is_comes_first(tmp_path):
    main = written(tmp_path, main=':- include("house/food.pl").')
    (tmp_path / "shipped" / "house").mkdir(parents=True)
    (tmp_path / "shipped" / "house" / "food.pl").write_text("food(bread).")
    assert list(loaded(main, [tmp_path / "shipped"]).query("food(X)")) == [{"X": "bread"}]
    (tmp_path / "house").mkdir()
    (tmp_path / "house" / "food.pl").write_text("food(rice).")
    assert list(loaded(main, [tmp_path / "shipped"]).query("food(X)")) == [{"X": "rice"}]


def test_its_constraints_are_about_its_own_statements(tmp_path):
    main = written(tmp_path, main=':- use("home.pl", as(home)).\n:- include("local.pl").', home=HOME, local="eat(tom, bread).")
    kb = loaded(main)
    assert kb.verify("home:eat(tom, bread)").reasons == ("cats eat fresh things",)
    assert kb.verify("eat(tom, bread)").valid is True
    fresh = loaded(written(tmp_path, main=':- use("home.pl", as(home)).\n:- include("local.pl").', local="", home=HOME + "fresh(bread)."))
    assert fresh.verify("home:eat(tom, bread)").valid is True
    assert fresh.verify("home:eat(tom, bread)", [("home:eat(tom, bread)", 1.0)]).reasons == ("nothing twice",)
    assert fresh.ask("home:tidy(tom)")


def test_a_text_that_uses_others_can_be_used_itself(tmp_path):
    main = written(tmp_path, main=':- use("b.pl", as(b)).\nr(X) :- b:q(X).', b=':- use("c.pl", as(c)).\nq(X) :- c:p(X).', c="p(a).")
    kb = loaded(main)
    assert kb.ask("r(a)")
    assert kb.ask("b:c:p(a)")


def test_one_text_under_two_prefixes_is_two(tmp_path):
    main = written(tmp_path, main=':- use("c.pl", as(one)).\n:- use("c.pl", as(two)).\n:- use("c.pl", as(one)).', c="p(a).")
    assert [c.head.indicator for c in loaded(main).clauses] == [("one:p", 1), ("two:p", 1)]


def test_what_is_used_prints_to_a_text_of_its_own(tmp_path):
    kb = loaded(written(tmp_path, main=':- use("home.pl", as(home)).\nmine(X) :- home:food(X).', home=HOME))
    again = KnowledgeBase.from_text(kb.to_text())
    assert again.clauses == kb.clauses
    assert again.ask("mine(bread)")


def test_a_prefix_in_a_statement_is_a_part_of_the_name():
    assert read_statement("home:eat(tom, X)").indicator == ("home:eat", 2)
    assert read_statement("valid(home:eat(tom, X))")[1].indicator == ("home:eat", 2)
    ((literal,),) = read_query("\\+ home:rain")
    assert (literal.atom, literal.negated) == (Compound(("home:rain",)), True)


def test_a_built_in_keeps_its_name_unless_the_text_defines_it_and_the_goals_in_it_bear_the_prefix():
    text = """n(1). n(2). last(a, b). one(X) :- member(X, [1, 3]), n(X). z(X) :- last(X, b). all :- maplist(n, [1, 2]).
        small(X) :- call(n, X), call(<, X, 2). large(L) :- findall(X, (n(X), X > 1), L)."""
    base = KnowledgeBase(list(prefixed(read_text(text), "k")))
    assert base.ask("k:all")
    answers = {"one": 1, "z": "a", "small": 1, "large": make_list([2])}
    assert {name: [a["X"] for a in base.query(f"k:{name}(X)")] for name in answers} == {n: [x] for n, x in answers.items()}


def test_a_pair_in_the_data_stays_a_pair():
    (fact,) = read_text("p(a: b).")
    assert fact.head[1] == Compound((":", "a", "b"))


@pytest.mark.parametrize("text", ["p :- X:q.", "p :- a:X.", "p :- 1:q.", "p :- a:1.", "a:p(b).", "p :- f(a):q."])
def test_what_is_no_name_with_a_prefix_is_refused(text):
    with pytest.raises(CasperError, match="cannot stand here"):
        read_text(text)


def test_plans_stay_with_the_text_they_are_in():
    assert program_text(prefixed(read_text("t --> p(a). p(a)."), "h")) == "'h:p'(a).\n"


# --- mistakes -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("files", "sentence"),
    [
        ({"main": 'p.\n:- include("gone.pl").'}, "main.pl:2:1: there is no file gone.pl to include beside this one"),
        ({"main": 'p.\n:- include("main.pl").'}, "main.pl:2:1: this file contains itself (main.pl needs main.pl)"),
        ({"main": ':- include("a.pl").', "a": 'p.\n\n:- include("main.pl").'}, "a.pl:3:1: this file contains itself (main.pl needs a.pl needs main.pl)"),
        ({"main": ':- use("a.pl", as(a)).', "a": ':- use("main.pl", as(m)).'}, "a.pl:1:1: this file contains itself (main.pl needs a.pl needs main.pl)"),
        ({"main": ':- use("gone", as(g)).'}, "main.pl:1:1: there is no domain gone to use"),
        ({"main": ':- use("a.pl", as(x)).\n:- use("b.pl", as(x)).', "a": "p.", "b": "p."}, "main.pl:2:1: the prefix x already stands for"),
        ({"main": ':- use("a.pl", x).', "a": "p."}, "has no prefix: write use(\"folder\", as(prefix))"),
        ({"main": ':- use("a.pl", as("Big Name")).', "a": "p."}, "has no prefix"),
        ({"main": ":- include(X)."}, "names no file"),
        ({"main": ':- include("a.pl").', "a": "p(a."}, "a.pl:1:4"),
        ({"main": ':- use("a.pl", as(a)).', "a": "p(X) :- q(X)."}, "a.pl:1:9: nothing defines a:q/1"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_sentence_with_its_place(tmp_path, files, sentence):
    with pytest.raises(CasperError) as told:
        loaded(written(tmp_path, **files)).compile()
    assert sentence in str(told.value)


def test_all_mistakes_can_be_collected_and_the_rest_is_read(tmp_path):
    main = written(tmp_path, main='p(a).\n:- include("gone.pl").\n:- include("bad.pl").\n:- use("gone", as(g)).\np(b).', bad="q(")
    mistakes = []
    sentences = Sources(mistake=mistakes.append).sentences(main)
    assert [m.place.line for m in mistakes] == [2, 1, 4]
    assert sentences == read_text("p(a). p(b).")


def test_the_fingerprint_changes_with_any_file(tmp_path):
    main = written(tmp_path, main=':- include("other.pl").', other="p(a).")
    read = Sources()
    read.sentences(main)
    before = fingerprint(read.files)
    assert fingerprint(read.files) == before
    (tmp_path / "other.pl").write_text("p(b).")
    changed = fingerprint(read.files)
    assert changed != before
    (tmp_path / "other.pl").unlink()
    assert fingerprint(read.files) not in (before, changed)


# --- files of others ------------------------------------------------------------------------------------------------


def told(file, roots=()):
    with pytest.raises(CasperError) as mistake:
        loaded(file, roots)
    return str(mistake.value)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this platform has no pipes with a name")
@pytest.mark.parametrize("line", ['include("{}")', 'use("{}", as(p))'])
@pytest.mark.parametrize(("name", "kind"), [("pipe.pl", "a pipe"), ("/dev/zero", "a device"), ("circle.pl", "a circle of links"), ("lost.pl", "a link to nothing")])
def test_what_is_no_regular_file_is_refused_before_it_is_opened(tmp_path, line, name, kind):
    os.mkfifo(tmp_path / "pipe.pl")
    (tmp_path / "circle.pl").symlink_to("circle.pl")
    (tmp_path / "lost.pl").symlink_to("gone.pl")
    main = written(tmp_path, main=f"p.\n:- {line.format(name)}.")
    assert told(main) == f"{main}:2:1: {tmp_path / name} is {kind}, and only regular files are read"


def test_a_folder_is_no_file_to_include(tmp_path):
    (tmp_path / "parts").mkdir()
    main = written(tmp_path, main=':- include("parts").')
    assert told(main) == f"{main}:1:1: {tmp_path / 'parts'} is a folder, and only regular files are read"


@pytest.mark.parametrize("name", ["x" * 5000, "a\\0b.pl", "main.pl/b.pl"])
@pytest.mark.parametrize(("line", "sentence"), [('include("{}")', "there is no file"), ('use("{}", as(p))', "there is no domain")])
def test_a_name_no_file_can_have_is_a_sentence_too(tmp_path, name, line, sentence):
    assert f"main.pl:1:1: {sentence} " in told(written(tmp_path, main=f":- {line.format(name)}."))


def test_a_link_to_the_folder_itself_is_no_way_to_read_a_file_twice(tmp_path):
    (tmp_path / "again").symlink_to(tmp_path)
    main = written(tmp_path, main=':- include("again/again/b.pl").\n:- include("b.pl").', b='p(a).\n:- include("again/c.pl").', c="p(b).")
    assert len(Sources().sentences(main)) == 2


def test_files_stand_within_files_only_so_deep(tmp_path):
    names = [f"f{n}" for n in range(200)]
    files = {name: f':- include("f{n + 1}.pl").' for n, name in enumerate(names[:-1])}
    main = written(tmp_path, main=':- include("f0.pl").', **files, **{names[-1]: "p(a)."})
    assert told(main).startswith(f"{tmp_path / 'f48.pl'}:1:1: files may stand within files 50 deep")
    used = {name: text.replace("include", "use").replace('pl"', 'pl", as(p)') for name, text in files.items()}
    assert "50 deep" in told(written(tmp_path, main=':- use("f0.pl", as(p)).', **used))


def test_all_files_together_are_read_up_to_a_size(tmp_path, monkeypatch):
    monkeypatch.setattr(sources, "MOST_ALTOGETHER", 2**20)
    main = written(tmp_path, main=':- include("a.pl").\n:- use("b.pl", as(b)).', a="p(a).\n" + " " * 600_000, b="p(a).\n" + " " * 600_000)
    assert told(main) == f"with {tmp_path / 'b.pl'} the files of this domain are larger than 1 MiB, the most that is read of a domain"


SECRETS = {
    "passwords": "root:hunter2:0:0\n",
    "a name": "hunter2 hunter2.\n",
    "a quote": "p('hunter2\n",
    "a comment": "/* hunter2",
    "no end": "p(hunter2",
    "no clause": "hunter2 : -1 :- p.\np :- 'hunter2': 1.\n",
    "a number": f"p({'1' * 5000}hunter2).",
    "negated": "p :- \\+ (hunter2 + 1, b).",
    "a large file": "p(a).\n" * 5000 + "hunter2 hunter2.\n",
}


@pytest.mark.parametrize("secret", SECRETS.values(), ids=SECRETS)
@pytest.mark.parametrize("way", ["include", "use", "a link"])
def test_a_mistake_outside_the_folder_shows_its_place_and_no_text(tmp_path, secret, way):
    (tmp_path / "home").mkdir()
    (tmp_path / "secret.pl").write_text(secret)
    lines = {"include": ':- include("../secret.pl").', "use": ':- use("../secret.pl", as(s)).', "a link": ':- include("link.pl").'}
    (tmp_path / "home" / "link.pl").symlink_to(tmp_path / "secret.pl")
    (tmp_path / "home" / "main.pl").write_text(lines[way])
    sentence = told(tmp_path / "home" / "main.pl")
    assert "hunter2" not in sentence
    assert "\n" not in sentence
    assert re.match(r".*(secret|link)\.pl:\d+:\d+: .* \(its line is not shown, as the file lies outside the domain's folder\)$", sentence)


def test_a_mistake_in_the_folder_and_in_a_shipped_text_shows_the_line(tmp_path):
    text = "p(a).\nq q.\n"
    main = written(tmp_path, main=':- include("deep/a.pl").', deep__a=text)
    assert told(main).endswith("2:3: 'q' does not belong here; expected a full stop\n    q q.\n      ^")
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / "main.pl").write_text(':- use("deep/a.pl", as(a)).')
    assert "    q q.\n" in told(tmp_path / "home" / "main.pl", [tmp_path])


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this platform has no pipes with a name")
def test_a_fingerprint_waits_for_no_pipe(tmp_path):
    file = tmp_path / "a.pl"
    file.write_text("p.")
    before = fingerprint([file])
    file.unlink()
    os.mkfifo(file)
    assert fingerprint([file]) != before


def test_a_predicate_that_a_used_text_only_declares_is_its_own(tmp_path):
    kb = loaded(written(tmp_path, main=':- use("home.pl", as(home)).', home=":- dynamic(guest/1).\nset(X) :- guest(X)."))
    kb.assert_(("home:guest", "ann"))
    assert kb.ask("home:set(ann)") and not kb.ask("home:set(bob)") and not kb.defines("guest", 1)
