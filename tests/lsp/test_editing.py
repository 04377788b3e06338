"""``casper lsp`` over the protocol: what an editor shows while a domain is written."""

import pytest

pytest.importorskip("pygls")

from pygls.exceptions import JsonRpcException

from casper.engine.domain.check import check_domain


def grown(editor, path, more):
    """A text that is open, with more behind it."""
    uri = editor.open(path)
    editor.change(uri, editor.texts[uri] + more)
    return uri


# --- findings --------------------------------------------------------------------------------------------------------


def test_a_misspelt_name_is_found_as_it_is_typed(editor, home):
    uri = grown(editor, home / "ontology.pl", "wave(X) :- humn(X).\n")
    assert editor.findings(uri, bool) == ["nothing defines humn/1; did you mean human?"]
    [found] = editor.found[uri]
    assert (found.range.start.line, found.range.start.character, found.range.end.character) == (15, 11, 15)


def test_a_half_typed_clause_is_a_sentence_and_nothing_else_is_lost(editor, home):
    uri = grown(editor, home / "ontology.pl", "wave(X) :- agent(X")
    assert editor.findings(uri, bool) == ["the text ends here, in the middle of a clause; expected ')' or ','"]
    assert "human" in editor.completions(uri, "wave(X) :- ")


def test_the_whole_of_check_follows_when_the_typing_rests(editor, home):
    uri = grown(editor, home / "ontology.pl", "lonely(ann).\n")
    assert any("nothing needs lonely/1" in each for each in editor.findings(uri, bool))
    (home / "ontology.pl").write_text(editor.texts[uri])
    wanted = [f.message for f in check_domain(home) if f.place.file.endswith("ontology.pl")]
    assert editor.findings(uri, lambda found: sorted(found) == sorted(wanted))


def test_what_was_found_of_a_clause_moves_with_it(editor, home):
    uri = grown(editor, home / "ontology.pl", "lonely(ann).\n")
    editor.findings(uri, bool)
    line = editor.found[uri][0].range.start.line
    seen = editor.told[uri]
    editor.change(uri, "% one line more\n" + editor.texts[uri])
    editor.findings(uri, lambda found: editor.told[uri] > seen)
    assert editor.found[uri][0].range.start.line == line + 1


def test_what_is_open_counts_and_not_what_is_saved(editor, home):
    plans = editor.open(home / "plans.pl")
    grown(editor, home / "ontology.pl", "stir(A, T) :- agent(A), cup(T).\n")
    editor.change(plans, editor.texts[plans] + "serve(C) --> stir(C), carry(C, sink).\n")
    seen = editor.told[plans]
    editor.change(plans, editor.texts[plans] + "% more\n")
    editor.findings(plans, lambda found: editor.told[plans] > seen)
    assert not any("stir" in each for each in editor.findings(plans))


def test_a_step_that_no_rule_knows_is_found_in_the_plans(editor, home):
    uri = grown(editor, home / "plans.pl", "serve(C) --> fil(C, table).\n")
    assert any("did you mean fill?" in each for each in editor.findings(uri, bool))


def test_a_file_beside_it_that_is_no_utf8_is_a_sentence(editor, home):
    (home / "words.pl").write_bytes(b'say(mug, "caf\xe9").\n')
    uri = grown(editor, home / "ontology.pl", "wave(X) :- humn(X).\n")
    assert any("is no UTF-8" in each or "humn" in each for each in editor.findings(uri, bool))
    assert "human/1" in editor.hover(uri, "human(ann)", 2)


def test_a_text_outside_a_domain_is_checked_alone(editor, tmp_path):
    uri = editor.open(tmp_path / "notes.pl", "cup(mug). full(X) :- cp(X).\n")
    assert editor.findings(uri, bool) == ["nothing defines cp/1; did you mean cup?"]


def test_a_text_that_is_closed_has_no_findings(editor, home):
    uri = grown(editor, home / "ontology.pl", "wave(X) :- humn(X).\n")
    editor.findings(uri, bool)
    editor.close(uri)
    assert editor.findings(uri, lambda found: not found) == []


# --- completion ------------------------------------------------------------------------------------------------------


def test_predicates_are_proposed_with_their_comments(editor, home):
    uri = grown(editor, home / "ontology.pl", "wave(X) :- ag")
    item = editor.completions(uri, "wave(X) :- ag")["agent"]
    assert (item.detail, item.documentation.value) == ("agent/1", "people act")


def test_things_are_proposed_as_arguments_and_variables_of_the_clause(editor, home):
    uri = grown(editor, home / "ontology.pl", "wave(Xavier) :- cup(")
    assert {"mug", "glass", "Xavier"} <= editor.completions(uri, "wave(Xavier) :- cup(").keys()


def test_in_plans_tasks_and_actions_are_proposed(editor, home):
    uri = grown(editor, home / "plans.pl", "serve(C) --> ")
    found = editor.completions(uri, "carry(C, table).\nserve(C) --> ")
    assert found["carry"].detail == "carry/2" and "tea" in found and "optional" in found


def test_settings_are_proposed_with_their_defaults(editor, home):
    uri = grown(editor, home / "ontology.pl", "setting(focus, thr")
    item = editor.completions(uri, "setting(focus, thr")["threshold"]
    assert item.detail == "default 0.45" and "threshold: the share" in item.documentation.value


def test_in_a_comment_nothing_is_proposed(editor, home):
    uri = grown(editor, home / "ontology.pl", "% hum")
    assert editor.completions(uri, "% hum") == {}


# --- places ----------------------------------------------------------------------------------------------------------


def test_hovering_tells_what_defines_a_name_its_comment_and_its_sentence(editor, home):
    uri = editor.open(home / "ontology.pl")
    told = editor.hover(uri, "carry(A", 2)
    assert "**carry/3** — predicate, 1 clause" in told and "to carry something somewhere" in told
    assert "“{A} carries {T} to {D}”" in told and "defined in ontology.pl:11" in told


def test_hovering_tells_how_many_rows_there_are_once_all_is_checked(editor, home):
    uri = grown(editor, home / "ontology.pl", "lonely(ann).\n")
    editor.findings(uri, bool)
    assert "2 rows" in editor.hover(uri, "agent(X) :-", 2)


def test_hovering_over_a_thing_tells_what_is_stated_of_it(editor, home):
    uri = editor.open(home / "ontology.pl")
    assert "stated: cup" in editor.hover(uri, "mug", 1)


def test_a_step_of_a_plan_leads_to_the_rule_of_its_action(editor, home):
    uri = editor.open(home / "plans.pl")
    assert editor.definition(uri, "carry(C", 2) == ["ontology.pl:11: carry(A, T, D) :- agent(A), cup(T), place(D)."]
    assert editor.definition(uri, "serve(C), opt", 2) == ["plans.pl:3: serve(C) --> carry(C, table)."]


def test_every_use_of_an_action_is_found(editor, home):
    uri = editor.open(home / "ontology.pl")
    lines = {":".join(each.split(":")[:2]) for each in editor.references(uri, "carry(A", 2)}
    assert lines == {"ontology.pl:11", "ontology.pl:13", "ontology.pl:15", "plans.pl:3"}


def test_a_variable_is_one_in_its_clause(editor, home):
    uri = editor.open(home / "ontology.pl")
    assert len(editor.references(uri, "T, D) :- agent", 0)) == 2


# --- changes ---------------------------------------------------------------------------------------------------------


def test_an_action_is_renamed_everywhere(editor, home):
    uri = editor.open(home / "ontology.pl")
    found = editor.rename(uri, "carry(A", "bring", 2)
    assert found["plans.pl"].count("bring(C, table)") == 1
    assert "claim(bring(_, mug, D))" in found["ontology.pl"] and "carry(" not in found["ontology.pl"]
    assert "% to carry something" in found["ontology.pl"]


def test_a_variable_is_renamed_in_its_sentence_too(editor, home):
    uri = editor.open(home / "ontology.pl")
    found = editor.rename(uri, "say(carry(A", "Who", len("say(carry("))["ontology.pl"]
    assert 'say(carry(Who, T, D), "{Who} carries {T} to {D}").' in found


@pytest.mark.parametrize(
    ("mark", "further", "new", "why"),
    [
        ("agent(X) :-", 1, "cup", "there is a cup/1 already"),
        ("agent(X) :-", 1, "Agent", "Agent is no name"),
        ("setting(", 1, "choice", "has a meaning to the system"),
        ("T, D) :- agent", 0, "A", "A is another variable"),
        ("T, D) :- agent", 0, "t", "t is no variable"),
    ],
)
def test_a_name_that_cannot_be_is_refused_in_a_sentence(editor, home, mark, further, new, why):
    uri = editor.open(home / "ontology.pl")
    with pytest.raises(JsonRpcException, match=why):
        editor.rename(uri, mark, new, further)


def test_actions_that_are_recognised_are_renamed_there_too(editor, kitchen):
    uri = editor.open(kitchen / "ontology.pl")
    found = editor.rename(uri, "eat(A, T, D)", "consume", 1)
    assert "context(use, plate, consume)." in found["actions.pl"] and "consumes(consume)." in found["scene.pl"]
    for name, text in found.items():
        (kitchen / name).write_text(text)
    assert not [f for f in check_domain(kitchen) if f.severity == "error"]


def test_what_is_included_from_the_package_is_known_and_keeps_its_names(editor, home):
    uri = grown(editor, home / "ontology.pl", ':- include("household.pl").\nslow(M) :- movement(_, _, _, _, M).\n')
    assert editor.definition(uri, "movement(_", 2)[0].startswith("movements.pl:")
    with pytest.raises(JsonRpcException, match="has a meaning to the system"):
        editor.rename(uri, "movement(_", "motion", 2)
    editor.change(uri, editor.texts[uri] + "quick(M) :- hold(M).\n")
    with pytest.raises(JsonRpcException, match="comes with casper, and keeps its name"):
        editor.rename(uri, "hold(M)", "grip", 2)


def test_misspelt_names_are_mended(editor, home):
    uri = grown(editor, home / "ontology.pl", "wave(X, Y) :- humn(X).\n")
    editor.findings(uri, lambda found: len(found) == 2)
    repairs = editor.repairs(uri)
    assert repairs["write human"].endswith("wave(X, Y) :- human(X).\n")
    assert repairs["write _Y"].endswith("wave(X, _Y) :- humn(X).\n")
    assert repairs["write _ for Y"].endswith("wave(X, _) :- humn(X).\n")


def test_a_misspelt_setting_is_mended(editor, home):
    uri = grown(editor, home / "ontology.pl", "setting(focus, thresold, 0.4).\n")
    editor.findings(uri, lambda found: any("did you mean threshold?" in each for each in found))
    assert editor.repairs(uri)["write threshold"].endswith("setting(focus, threshold, 0.4).\n")


def test_columns_are_counted_as_the_editor_counts_them(editor, home):
    uri = grown(editor, home / "ontology.pl", "'\U0001f375'(X) :- cup(X), humn(X).\n")
    editor.findings(uri, bool)
    assert "human(X).\n" in editor.repairs(uri)["write human"][-12:]


# --- outlines --------------------------------------------------------------------------------------------------------


def test_the_outline_of_plans_has_goals_tasks_and_their_steps(editor, home):
    uri = editor.open(home / "plans.pl")
    found = [(each.name, [child.name for child in each.children]) for each in editor.outline(uri)]
    assert found == [("goal/1", []), ("tea/1", ["serve/1", "fill/2"]), ("serve/1", ["carry/2"])]


def test_the_outline_of_an_ontology_has_predicates_and_constraints(editor, home):
    uri = editor.open(home / "ontology.pl")
    names = [each.name for each in editor.outline(uri)]
    assert names[:4] == ["human/1", "robot/1", "agent/1", "cup/1"] and "the mug stays at the table" in names


def test_the_server_says_what_it_can(editor):
    for each in ("completion", "hover", "definition", "references", "rename", "document_symbol", "code_action"):
        assert getattr(editor.capabilities, f"{each}_provider")
