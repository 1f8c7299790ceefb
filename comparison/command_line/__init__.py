"""The ``bentbeam`` command: one file a command, and the console that they share."""
