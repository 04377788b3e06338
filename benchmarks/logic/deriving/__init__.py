"""What is derived: closures, an ontology, games, minima and counts; its upkeep and its memory."""
