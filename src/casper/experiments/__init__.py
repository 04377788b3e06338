"""The paper's tables and figures, and studies beyond it, each from one command (docs/howto/experiment.md).

In: the name of an experiment, how many trials, a folder. Out: data as CSV and JSON, figures drawn from those files
alone, and a page that sets the paper's numbers beside ours. `runner` runs, `registry` knows what there is; an
experiment is a file in `paper` or `studies`, its pictures are in `figures`.

    >>> from casper.experiments.runner import run_experiments
"""
