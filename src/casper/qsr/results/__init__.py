"""What was found: relations as arrays, their rows and labels, and episodes with their times.

In: codes. Out: labels, runs of one label, states put in between, tables for pandas and files.
"""
