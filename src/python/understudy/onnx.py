"""Makes the weights of a policy from a network in ONNX: python -m understudy.onnx WALK.onnx WALK.safetensors

The network has dense layers (Gemm, or MatMul and Add) with Elu, Relu or Tanh between them. What scales observations or
actions (Add, Sub, Mul, Div by constants) goes into the layers. Anything else is refused. Needs the extra `onnx`.
"""

import argparse

import numpy as np

from ._understudy import Error
from .policy import save_weights

ACTIVATIONS = {"Elu": "elu", "Relu": "relu", "Tanh": "tanh"}
ARITHMETIC = {"Add": np.add, "Sub": np.subtract, "Mul": np.multiply, "Div": np.divide}


class _Reader:
    """Follows the values from the input of a graph to its output."""

    def __init__(self, graph, name):
        from onnx import numpy_helper

        self._name = name
        self._constants = {tensor.name: numpy_helper.to_array(tensor) for tensor in graph.initializer}
        for node in graph.node:
            if node.op_type == "Constant":
                self._constants[node.output[0]] = numpy_helper.to_array(node.attribute[0].t)
        inputs = [value.name for value in graph.input if value.name not in self._constants]
        if len(inputs) != 1 or len(graph.output) != 1:
            raise Error(f"{name}: expected one input and one output, got {len(inputs)} and {len(graph.output)}")
        self._value = inputs[0]
        self._before = (np.float64(1), np.float64(0))  # factor and sum of the observations
        self.layers, self.activations, self._open = [], [], False  # whether the last layer has no activation yet
        for node in graph.node:
            if node.op_type != "Constant":
                self._take(node)
        if self._value != graph.output[0].name or not self._open:
            raise Error(f"{name}: expected a dense layer at the end")

    def _fail(self, node, what):
        raise Error(f"{self._name}: node {node.op_type} '{node.name}': {what}")

    def _constant(self, node, place):
        name = node.input[place]
        if name not in self._constants:
            self._fail(node, f"expected '{name}' to be a constant")
        return np.asarray(self._constants[name], np.float64)

    def _take(self, node):
        import onnx

        given = {attribute.name: onnx.helper.get_attribute_value(attribute) for attribute in node.attribute}
        commutes = node.op_type in ("Add", "Mul") and len(node.input) == 2 and node.input[1] == self._value
        if node.input[0] != self._value and not commutes:
            self._fail(node, "expected one chain of layers")
        if node.op_type == "Gemm":
            if given.get("alpha", 1) != 1 or given.get("beta", 1) != 1 or given.get("transA", 0) != 0:
                self._fail(node, "expected alpha 1, beta 1 and transA 0")
            weight = self._constant(node, 1)
            bias = self._constant(node, 2) if len(node.input) > 2 else 0
            self._add_layer(weight if given.get("transB", 0) else weight.T, bias)
        elif node.op_type == "MatMul":
            self._add_layer(self._constant(node, 1).T, 0)
        elif node.op_type in ARITHMETIC:
            self._scale(ARITHMETIC[node.op_type], self._constant(node, 0 if commutes else 1))
        elif node.op_type in ACTIVATIONS and self._open and given.get("alpha", 1) == 1:
            self.activations.append(ACTIVATIONS[node.op_type])
            self._open = False
        elif node.op_type not in ("Identity", "Flatten"):
            known = ", ".join(["Gemm", "MatMul", *ARITHMETIC, *ACTIVATIONS])
            self._fail(node, f"expected dense layers with activations between them, of {known}")
        self._value = node.output[0]

    def _add_layer(self, weight, bias):
        bias = np.broadcast_to(np.ravel(bias), len(weight)).astype(np.float64)
        if self._open:  # two layers without an activation are one
            first, inner = self.layers.pop()
            weight, bias = weight @ first, bias + weight @ inner
        elif not self.layers:
            factor, offset = (np.broadcast_to(np.ravel(value), weight.shape[1]) for value in self._before)
            weight, bias = weight * factor, bias + weight @ offset
        self.layers.append((weight, bias))
        self._open = True

    def _scale(self, act, constant):
        constant = np.ravel(constant)
        if self._open:
            weight, bias = self.layers[-1]
            turned = act(weight, constant[:, None]) if act in (np.multiply, np.divide) else weight
            self.layers[-1] = (turned, act(bias, constant))
        elif self.layers:
            raise Error(f"{self._name}: expected nothing between an activation and the next layer")
        else:
            factor, offset = self._before
            self._before = (act(factor, constant) if act in (np.multiply, np.divide) else factor, act(offset, constant))


def read(file):
    """Returns the layers and the activation of a network in ONNX, for save_weights. Raises Error for any other network."""
    import onnx

    from google.protobuf.message import DecodeError

    try:
        graph = onnx.load(file).graph
    except DecodeError:
        raise Error(f"{file}: expected a network in ONNX") from None
    reader = _Reader(graph, str(file))
    words = set(reader.activations) or {"none"}
    if len(words) > 1:
        raise Error(f"{file}: expected one activation, got {', '.join(sorted(words))}")
    return reader.layers, words.pop()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("network")
    parser.add_argument("weights")
    asked = parser.parse_args()
    try:
        layers, activation = read(asked.network)
    except (Error, OSError) as error:
        raise SystemExit(str(error)) from None
    save_weights(asked.weights, layers, activation)
    print(f"{asked.weights}: {'-'.join(str(weight.shape[1]) for weight, _ in layers)}-{len(layers[-1][1])}, {activation}")


if __name__ == "__main__":
    main()
