"""A policy of one's own: its deploy.yaml and its weights."""

import json
import pathlib

import numpy as np

from ._understudy import Definition, Network, State

ACTIVATIONS = ("none", "elu", "relu", "tanh")


class Policy:
    """Runs a policy on one robot, beside either SDK of the vendor or in this process.

    definition: path of the deploy.yaml; its weights lie beside it. robot: as of Definition.
    """

    def __init__(self, definition, robot):
        self.definition = Definition(definition, robot)
        self._network = Network(self.definition.weights, self.definition)
        self._began = False

    @property
    def step_dt(self):
        """s between two steps."""
        return self.definition.step_dt

    def begin(self, state):
        """Begins anew with a state as of `step`: the last action is 0, histories are as now."""
        self.definition.begin([0], self._sensed(state))
        self._began = True

    def step(self, state, velocity=(0, 0, 0)):
        """Returns the command: a dict of q [rad], kp and kd, each of shape (motors,), in the vendor's order.

        state: the robot's State, or the SDK's LowState. velocity: forward, left m/s, turn rad/s. Call it every
        step_dt seconds. robot.command(**policy.step(robot.state)) sends it in this process.
        """
        if not self._began:
            self.begin(state)
        observation = self.definition.observe(self._sensed(state), np.reshape(velocity, (1, 3)))
        q = self.definition.act(self._network(observation))[0]
        return {"q": q, "kp": self.definition.kp, "kd": self.definition.kd}

    def _sensed(self, state):
        if isinstance(state, State):
            return {"q": [state.q], "dq": [state.dq], "quaternion": [state.quaternion], "gyroscope": [state.gyroscope]}
        motors = [state.motor_state[slot] for slot in self.definition.slots]
        return {
            "q": [[motor.q for motor in motors]],
            "dq": [[motor.dq for motor in motors]],
            "quaternion": [list(state.imu_state.quaternion)],
            "gyroscope": [list(state.imu_state.gyroscope)],
        }


def save_weights(file, layers, activation="elu"):
    """Writes dense layers as the weights of a policy, in the format safetensors.

    layers: (weight, bias) of each, weight of shape (outputs, inputs). activation: one of none, elu, relu, tanh; it acts
    between layers.
    """
    if activation not in ACTIVATIONS:
        raise ValueError(f"activation: expected one of {', '.join(ACTIVATIONS)}, got {activation!r}")
    header, data = {"__metadata__": {"activation": activation}}, b""
    for number, (weight, bias) in enumerate(layers):
        for part, values in (("weight", weight), ("bias", bias)):
            values = np.ascontiguousarray(values, "<f4")
            offsets = [len(data), len(data) + values.nbytes]
            header[f"{number}.{part}"] = {"dtype": "F32", "shape": list(values.shape), "data_offsets": offsets}
            data += values.tobytes()
    text = json.dumps(header).encode()
    pathlib.Path(file).write_bytes(len(text).to_bytes(8, "little") + text + data)
