"""How a program on the real clock ends whose readers are called back."""

import json
import os


def end_with(report):
    """Prints it as JSON and ends the program at once. A sample that comes while Python winds up crashes the SDK now and then."""
    print(json.dumps(report), flush=True)
    os._exit(0)
