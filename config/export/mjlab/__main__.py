"""python -m FOLDER train | play [OPTIONS OF MJLAB]; `train --help` shows them."""

import sys

from mjlab.scripts import play, train

from .task import TASK

COMMANDS = {"train": train.main, "play": play.main}

if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in COMMANDS:
        sys.exit(f"expected train or play, then options of mjlab; got {' '.join(sys.argv[1:]) or 'nothing'}")
    command = sys.argv[1]
    sys.argv[1] = TASK
    COMMANDS[command]()
