"""The shipped domains: one folder of text each."""
