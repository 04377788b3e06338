"""What is told of a verdict as JSON, by ``casper verify`` and by the server alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from casper.kb.base import KnowledgeBase

if TYPE_CHECKING:
    from casper.kb.reasons.validity import Verdict


def verdict_json(
    kb: KnowledgeBase, text: str, verdict: Verdict | None = None, with_proof: bool = True
) -> dict[str, Any]:
    """``{"statement", "valid", "completed", "proof", "reasons", "repair"}`` of a statement.

    Finding a proof takes longer than judging: without it ``proof`` is None.

    Raises:
        CasperError: the text is no statement, or nothing defines its predicate.
    """
    judged = kb.verify(text) if verdict is None else verdict
    proof = kb.why(judged.completed) if judged.valid and with_proof else None
    return {
        "statement": text,
        "valid": judged.valid,
        "completed": repr(judged.completed) if judged.valid else None,
        "proof": proof.to_json() if proof is not None else None,
        "reasons": list(judged.reasons),
        "repair": [repair.to_json() for repair in kb.repair(judged.statement)] if judged.valid is False else [],
    }
