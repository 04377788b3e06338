"""The paper's experiments, one a file, and the numbers beside ours (`casper.experiments.printed`).

In: what is asked, and a function that runs trials. Out: `Data`.
"""
