"""Networks in ONNX become weights of policies."""

import pathlib
import subprocess
import sys

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper, numpy_helper

import understudy
import understudy.onnx

RANDOM = np.random.default_rng(5)
SHAPES = {"w0": (16, 45), "b0": (16,), "w1": (16, 12), "b1": (12,), "mean": (45,), "deviation": (45,), "two": ()}
VALUES = {name: np.asarray(RANDOM.uniform(0.5, 1.5, shape), np.float32) / 5 for name, shape in SHAPES.items()}


def written(file, nodes, output):
    value = lambda name, width: helper.make_tensor_value_info(name, TensorProto.FLOAT, [1, width])  # noqa: E731
    graph = helper.make_graph(
        [helper.make_node(op, inputs, [out], **how) for op, inputs, out, how in nodes], "network", [value("x", 45)],
        [value(output, 12)], [numpy_helper.from_array(values, name) for name, values in VALUES.items()],
    )  # fmt: skip
    onnx.save(helper.make_model(graph), file)
    return file


USUAL = [
    ("Sub", ["x", "mean"], "a", {}), ("Div", ["a", "deviation"], "b", {}),
    ("Gemm", ["b", "w0", "b0"], "c", {"transB": 1}), ("Elu", ["c"], "d", {}),
    ("MatMul", ["d", "w1"], "e", {}), ("Add", ["b1", "e"], "f", {}), ("Mul", ["f", "two"], "y", {}),
]  # fmt: skip


def test_a_network_with_a_normalizer_gives_what_onnx_says(tmp_path):
    file = written(tmp_path / "walk.onnx", USUAL, "y")
    done = subprocess.run([sys.executable, "-m", "understudy.onnx", file, tmp_path / "deploy.safetensors"], capture_output=True, text=True)
    assert done.returncode == 0 and "45-16-12, elu" in done.stdout, done.stderr
    definition = understudy.Definition(pathlib.Path(understudy.__file__).parent / "tasks" / "go2_flat.yaml", "go2")
    network = understudy.Network(tmp_path / "deploy.safetensors", definition)
    x = RANDOM.normal(size=(4, 45)).astype(np.float32)
    hidden = ((x - VALUES["mean"]) / VALUES["deviation"]) @ VALUES["w0"].T + VALUES["b0"]
    hidden = np.where(hidden > 0, hidden, np.expm1(np.minimum(hidden, 0)))
    assert network(x) == pytest.approx((hidden @ VALUES["w1"] + VALUES["b1"]) * VALUES["two"], rel=1e-4, abs=1e-4)


@pytest.mark.parametrize("nodes, output, told", [
    ([*USUAL[:3], ("Softmax", ["c"], "y", {})], "y", "Softmax.*expected dense layers"),
    ([*USUAL[:4], ("Tanh", ["d"], "y", {})], "y", "Tanh.*expected dense layers"),
    (USUAL[:4], "d", "expected a dense layer at the end"),
    ([*USUAL[:3], ("Elu", ["c"], "d", {"alpha": 0.5}), *USUAL[4:]], "y", "Elu.*expected dense layers"),
    ([*USUAL[:2], ("Gemm", ["x", "w0", "b0"], "y", {"transB": 1})], "y", "expected one chain"),
    ([("Gemm", ["x", "x", "b0"], "y", {})], "y", "expected 'x' to be a constant"),
])  # fmt: skip
def test_another_network_is_refused_by_its_node(tmp_path, nodes, output, told):
    with pytest.raises(understudy.Error, match=told):
        understudy.onnx.read(written(tmp_path / "walk.onnx", nodes, output))


def test_a_file_that_is_no_network_is_refused_by_its_name(tmp_path):
    file = tmp_path / "walk.onnx"
    file.write_bytes(b"garbage")
    done = subprocess.run([sys.executable, "-m", "understudy.onnx", file, tmp_path / "walk.safetensors"],
                          capture_output=True, text=True)  # fmt: skip
    assert (done.returncode, done.stderr) == (1, f"{file}: expected a network in ONNX\n")
