"""Text to sentences and back: the grammar, the readers, includes and namespaces, the writer.

In: text and files. Out: clauses, productions and directives with their places, or a `ReadError` that shows the line.
"""
