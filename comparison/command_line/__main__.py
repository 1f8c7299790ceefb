"""``python -m comparison.command_line`` is the ``bentbeam`` command."""

from comparison.command_line.app import main

main()
