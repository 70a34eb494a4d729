"""Runs programs in the private network of a robot: the command of `understudy exec` for understudy.robot.

Reads one JSON object a line from standard input and answers each by one on standard output: {"run": [words], "cwd": ...,
"env": {...}, "output": file}, {"poll": pid}, {"signal": number, "pid": pid}. Ends with its input, and its programs with it.
"""

import json
import os
import subprocess
import sys


def answer(programs, asked):
    if "run" in asked:
        with open(asked["output"], "ab") as output:
            program = subprocess.Popen(
                asked["run"], cwd=asked["cwd"], env=os.environ | asked["env"], stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT,
            )  # fmt: skip
        programs[program.pid] = program
        return {"pid": program.pid}
    if "poll" in asked:
        return {"code": programs[asked["poll"]].poll()}
    programs[asked["pid"]].send_signal(asked["signal"])
    return {}


def main():
    programs = {}
    print(json.dumps({"ready": True}), flush=True)
    for line in sys.stdin:
        try:
            answered = answer(programs, json.loads(line))
        except OSError as error:
            answered = {"error": str(error)}
        print(json.dumps(answered), flush=True)


if __name__ == "__main__":
    main()
