"""The slow, obviously right ones: what a program means and what explains observations, by sheer enumeration.

For those who test an engine of their own against something that shares no code with it.
"""
