"""The language server: a domain's texts in an editor (``casper lsp``, docs/editor.md).

In: documents as they are typed. Out: findings, completion, hover, definitions, references, outlines, repairs. The texts
are analysed here, clause by clause; ``casper check`` as a whole runs in a process of its own, which can be stopped.
"""
