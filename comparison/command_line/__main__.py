"""``python -m comparison.command_line`` and the ``bentbeam`` command; light: interrupts are caught from the start."""

import sys


def main() -> None:
    try:
        from comparison.command_line import app
    except KeyboardInterrupt:
        print("error: interrupted; nothing had begun", file=sys.stderr)
        sys.exit(130)
    app.main()


if __name__ == "__main__":
    main()
