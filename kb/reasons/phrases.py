"""What the knowledge base itself says around an author's sentences, by language; English where a language has none."""

from __future__ import annotations

from collections.abc import Mapping

PHRASES: Mapping[str, Mapping[str, str]] = {
    "en": {
        "not so": "it is not so that {0}",
        "valid": "{0}: valid",
        "not valid": "{0}: not valid",
        "unknown": "{0}: unknown",
        "so": "so {0}",
        "because": "because {0}",
        "fails": "{0} does not hold",
        "holds": "{0} holds",
        "nothing gives": "no fact or rule gives {0}",
    },
    "fr": {
        "not so": "c'est faux : {0}",
        "valid": "{0} : valable",
        "not valid": "{0} : non valable",
        "unknown": "{0} : inconnu",
        "so": "donc {0}",
        "because": "car {0}",
        "fails": "{0} n'est pas vrai",
        "holds": "{0} est vrai",
        "nothing gives": "aucun fait et aucune règle ne donne {0}",
    },
}


def phrased(table: Mapping[str, Mapping[str, str]], language: str, name: str, *values: object) -> str:
    """A phrase of a table in a language (English where the table has none), with its values in it."""
    return table.get(language, table["en"])[name].format(*values)
