"""What tells a domain from one that says something else, wherever its files lie and however they are laid out."""

from __future__ import annotations

from hashlib import sha256

from casper.engine.domain.domain import Domain


def digest(domain: Domain) -> str:
    """SHA-256, in hexadecimal, of all that the domain states, and of the language it is told in."""
    text = f"{domain.kb.to_text()}\n{domain.library.to_text()}\n{domain.verifies}{domain.kb.language}"
    return sha256(text.encode("utf-8", "surrogateescape")).hexdigest()
