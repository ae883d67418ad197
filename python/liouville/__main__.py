"""The command `liouville`, also as `python -m liouville`."""

import signal
import sys

from ._liouville import run


def main() -> int:
    """Runs the command with the arguments of the process."""
    # The interpreter's handler would wait for the command to end.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["liouville", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
