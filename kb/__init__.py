"""The knowledge base: a Prolog-style text becomes relations that answer in every direction and give reasons."""
