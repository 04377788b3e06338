"""The integer datatypes of XML Schema by their least and greatest values, and names for what is called alike."""

import pytest
from ontologies import imported, reasons, rows

BOUNDS = {
    "long": (-9223372036854775808, 9223372036854775807),
    "int": (-2147483648, 2147483647),
    "short": (-32768, 32767),
    "byte": (-128, 127),
    "unsignedLong": (0, 18446744073709551615),
    "unsignedInt": (0, 4294967295),
    "unsignedShort": (0, 65535),
    "unsignedByte": (0, 255),
    "nonNegativeInteger": (0, None),
    "positiveInteger": (1, None),
    "nonPositiveInteger": (None, 0),
    "negativeInteger": (None, -1),
}
INSIDE = [(name, bound) for name, bounds in BOUNDS.items() for bound in bounds if bound is not None]
OUTSIDE = [(name, low - 1) for name, (low, _) in BOUNDS.items() if low is not None]
OUTSIDE += [(name, high + 1) for name, (_, high) in BOUNDS.items() if high is not None]


def stated(datatype, number):
    return f'DataPropertyAssertion(:size :rex "{number}"^^xsd:{datatype})'


@pytest.mark.parametrize(("datatype", "number"), INSIDE)
def test_the_least_and_the_greatest_value_are_values(datatype, number):
    found = imported(stated(datatype, number))
    assert found.findings == [] and rows(found.knowledge_base(), "size(rex, X)") == [(number,)]


@pytest.mark.parametrize(("datatype", "number"), OUTSIDE)
def test_a_number_beyond_them_is_refused(datatype, number):
    (told,) = reasons(stated(datatype, number))
    assert told.endswith(f"is no {datatype}; mend the value")


@pytest.mark.parametrize("sign", ["", "-"])
def test_integers_have_no_bound_up_to_a_thousand_digits(sign):
    number = int(sign + "9" * 1000)
    assert rows(imported(stated("integer", number)).knowledge_base(), "size(rex, X)") == [(number,)]
    (told,) = reasons(stated("integer", f"{number}0"))
    assert told.endswith("the number is too large to be kept")


@pytest.mark.parametrize("spelt", ["", "+", "--1", "+-1", "1.0", "1e3", "0x1", "١", "1_000"])
def test_what_is_spelt_otherwise_is_no_integer(spelt):
    (told,) = reasons(stated("integer", spelt))
    assert told.endswith("is no integer; mend the value")


def test_an_integer_may_have_a_sign_and_spaces_around_it():
    assert rows(imported(stated("integer", " +7 ")).knowledge_base(), "size(rex, X)") == [(7,)]


def test_names_that_are_alike_are_counted_on_without_a_gap():
    facts = (f"ClassAssertion(<http://{place}.org/Dog> :rex)" for place in "abcd")
    kb = imported(*facts).knowledge_base()
    named = {iri: name for name, iri in rows(kb, "iri(N, I)")}
    assert [named[f"http://{place}.org/Dog"] for place in "abcd"] == ["dog", "dog_2", "dog_3", "dog_4"]


def test_a_number_that_another_is_called_by_is_left_to_it():
    facts = (f"ClassAssertion(<http://{place}> :rex)" for place in ("a.org/Dog", "b.org/Dog", "c.org/dog_2"))
    kb = imported(*facts).knowledge_base()
    named = {iri: name for name, iri in rows(kb, "iri(N, I)")}
    assert (named["http://b.org/Dog"], named["http://c.org/dog_2"]) == ("dog_3", "dog_2")
