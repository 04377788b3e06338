"""``python -m casper`` is the ``casper`` command."""

from casper.cli import main

main()
