"""What is asked: lookups, joins, lists and programs, one question at a time, and reasons."""
