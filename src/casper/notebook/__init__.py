"""The notebook: what one holds as HTML and pictures, and cells of clauses (``%load_ext casper``).

In: objects of the other rooms, which know nothing of this one (`casper.kb.text.lines.Shown`). Out: HTML and SVG that
show the numbers of ``to_json()``, in light and dark alike; every text in them is escaped (`markup.py` alone writes
tags). `table.py` says what shows which type.
"""
