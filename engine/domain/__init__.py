"""A domain: one folder of text as a knowledge base and a plan library; its checks, and its reload.

In: a name or a folder. Out: a `Domain`, or findings with file and line.
"""
