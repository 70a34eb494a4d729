"""The files of a policy that holds its default pose."""

import json
import pathlib

import numpy as np

TASKS = pathlib.Path(__file__).parents[2] / "src" / "python" / "understudy" / "tasks"


def write_policy(folder, robot="go2"):
    """Returns the deploy.yaml, with its weights beside it."""
    actions = {"go2": 12, "g1": 29}[robot]
    header, data = {"__metadata__": {"activation": "none"}}, b""
    for name, shape in (("0.weight", (actions, 9 + 3 * actions)), ("0.bias", (actions,))):
        values = np.zeros(shape, "<f4").tobytes()
        header[name] = {"dtype": "F32", "shape": shape, "data_offsets": [len(data), len(data) + len(values)]}
        data += values
    text = json.dumps(header).encode()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "deploy.safetensors").write_bytes(len(text).to_bytes(8, "little") + text + data)
    file = folder / "deploy.yaml"
    file.write_text((TASKS / f"{robot}_flat.yaml").read_text())
    return file
