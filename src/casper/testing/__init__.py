"""Helpers for test suites that use CASPER."""
