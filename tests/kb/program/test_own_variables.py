"""What is counted, listed or tested as a whole has its variables to itself, as in Prolog; its name may be used again."""

import pytest

from casper.kb.base import KnowledgeBase

FACTS = "b(1). b(2). e(1, 3). e(1, 5). e(3, 1)."


def rows(rule, goal="l(X, Z)"):
    return [tuple(answer.values()) for answer in KnowledgeBase.from_text(f"{FACTS} {rule}").query(goal)]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("findall(Y, e(X, Y), A), findall(Y, e(Y, X), B), append(A, B, Z)", [(1, [3, 5, 3]), (2, [])]),
        ("findall(Y, e(X, Y), L), findall(Y - X, member(Y, L), M), length(M, Z)", [(1, 2), (2, 0)]),
        ("findall(Y, e(X, Y), L), aggregate_all(max(Y), member(Y, L), Z)", [(1, 5)]),
        ("aggregate_all(count, e(X, Y), M), aggregate_all(sum(Y), e(X, Y), N), Z is M + N", [(1, 10), (2, 0)]),
        ("findall(Y, e(X, Y), Z), forall(member(Y, Z), Y > 2)", [(1, [3, 5]), (2, [])]),
        ("forall(e(X, Y), Y > 2), findall(Y, e(X, Y), Z)", [(1, [3, 5]), (2, [])]),
        ("findall(Y, e(X, Y), Z), \\+ (e(X, Y), Y > 3)", [(2, [])]),
        ("e(X, Y), Y > 3, findall(Y, e(X, Y), Z)", [(1, [5])]),
        ("findall(Y, e(X, Y), L), e(X, Y), Z = Y - L", [(1, ("-", 3, [3, 5])), (1, ("-", 5, [3, 5]))]),
        ("(findall(Y, e(X, Y), [_ | _]) -> Z = yes ; findall(Y, b(Y), Z))", [(1, "yes"), (2, [1, 2])]),
    ],
)
def test_a_name_may_be_used_again(body, expected):
    found = sorted((tuple(map(plain, row)) for row in rows(f"l(X, Z) :- b(X), {body}.")), key=repr)
    assert found == sorted(expected, key=repr)


def plain(term):
    if term == "[]":
        return []
    if isinstance(term, tuple) and term[0] == ".":
        return [plain(term[1]), *plain(term[2])]
    return tuple(map(plain, term)) if isinstance(term, tuple) else term


def test_a_question_may_use_a_name_again():
    (answer,) = rows("", "findall(Y, e(1, Y), A), findall(Y, e(3, Y), B), append(A, B, Z)")
    assert plain(answer[-1]) == [3, 5, 1]
