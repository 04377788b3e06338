"""``--language``: sentences in it, terms elsewhere as they are."""


def test_verify_tells_reasons_in_the_language(casper):
    told = casper("verify", "kitchen", "eat(tiago, meal, plate)", "--language", "fr")
    assert told.code == 1
    assert told.out.splitlines()[:2] == [
        "✘ Tiago ne peut pas manger le repas dans l'assiette   [eat(tiago, meal, plate)]",
        "  car Tiago n'est pas une personne",
    ]


def test_json_has_the_same_terms_and_only_its_sentences_in_the_language(casper):
    plain = casper("verify", "kitchen", "eat(tiago, meal, plate)", "--json").json[0]
    french = casper("verify", "kitchen", "eat(tiago, meal, plate)", "--json", "--language", "fr").json[0]
    assert french.pop("reasons") == ["Tiago n'est pas une personne"] != plain.pop("reasons")
    assert french == plain


def test_a_language_nobody_speaks_is_one_sentence(casper):
    told = casper("explain", "kitchen", "eat", "--language", "tlh")
    assert told.code == 2 and told.err == "casper: nothing of kitchen is said in 'tlh'; there are en, fr\n"


def test_a_session_tells_why_not_in_the_language(casper):
    told = casper("repl", "kitchen", "--language", "en", stdin="why not eat(tiago, meal, plate)\n")
    assert told.out == "Tiago is not a person\n"
