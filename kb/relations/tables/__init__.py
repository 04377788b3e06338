"""Relations and columns: answers handed to numpy, pandas and Arrow, facts taken from them and from files.

In: stored rows, arrays, data frames, Arrow tables, CSV and Parquet files. Out: columns of answers, rows of constants.
"""
