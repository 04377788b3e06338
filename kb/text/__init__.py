"""Text to sentences and back: tokens, the parser and the readers, includes and namespaces, the writer.

In: text and files. Out: clauses, productions and directives with their places, or a `ReadError` that shows the line.
"""
