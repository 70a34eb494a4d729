"""examples/policy: what deploy.py makes of a policy's file, and what it does when that is not good enough. What
`understudy policy check` finds."""

import importlib.util
import pathlib
import re
import sys

import numpy as np
import pytest

from policies import write_policy

POLICY = pathlib.Path(__file__).parents[2] / "examples" / "policy"


@pytest.fixture(scope="module")
def deploy():
    spec = importlib.util.spec_from_file_location("deploy", POLICY / "deploy.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def saved(tmp_path, **layers):
    """The file of a policy for two motors."""
    np.savez(tmp_path / "two.npz", family="go", slots=[3, 5], q0=[0.1, -0.2], kp=[1, 1], kd=[1, 1], scale=0.5,
             gyro_scale=0.25, dq_scale=0.05, command_scale=np.array([2, 2, 0.5]), **layers)
    return tmp_path / "two.npz"


def observe(policy):
    return policy.targets(np.array([1., 2, 3]), np.array([0., 0, -1]), np.array([1., -1, 2]), np.array([0.3, 0.2]),
                          np.array([10., -20]))


def test_an_observation_has_the_usual_order_and_scales_and_the_last_action(deploy, tmp_path):
    for place, value in enumerate([0.25, 0.5, 0.75, 0, 0, -1, 2, -2, 1, 0.2, 0.4, 0.5, -1]):
        w = np.zeros((2, 15))
        w[1, place] = 1
        targets = observe(deploy.Policy(saved(tmp_path, w0=w, b0=np.zeros(2))))
        assert targets == pytest.approx([0.1, -0.2 + 0.5 * value])
    w = np.zeros((2, 15))
    w[0, 13] = 2  # twice its last action
    policy = deploy.Policy(saved(tmp_path, w0=w, b0=np.array([1., 0])))
    actions = [(observe(policy)[0] - 0.1) / 0.5 for _ in range(3)]
    assert actions == pytest.approx([1, 3, 7])


def test_there_is_an_elu_between_layers_and_none_behind_the_last(deploy, tmp_path):
    policy = deploy.Policy(saved(tmp_path, w0=np.zeros((2, 15)), b0=np.array([-1., 2]), w1=np.eye(2), b1=np.array([0., -5])))
    assert observe(policy) == pytest.approx([0.1 + 0.5 * (np.exp(-1) - 1), -0.2 + 0.5 * -3])


def test_a_network_of_another_size_is_refused(deploy, tmp_path):
    with pytest.raises(SystemExit, match="takes 14 numbers, not 9 \\+ 3 \\* 2"):
        deploy.Policy(saved(tmp_path, w0=np.zeros((2, 14)), b0=np.zeros(2)))


def test_a_policy_whose_robot_falls_damps_and_ends_with_code_1(understudy, tmp_path):
    script = tmp_path / "kick.yaml"
    script.write_text('script:\n  - {when: the program prints "the policy runs", push: {force: [0, 900, 0], for: 0.2}}\n')
    policy = tmp_path / "go2.npz"
    written = understudy("exec", "go2", "--script", script, "--", "sh", "-c",
                         f"{sys.executable} {POLICY}/standing.py go2 {policy} && "
                         f"{sys.executable} {POLICY}/deploy.py {policy} lo --at-once --seconds 8")
    assert written.returncode == 1, written.stdout + written.stderr
    assert "it fell" in written.stdout and "damping" in written.stdout


def test_the_walk_of_the_training_example_is_not_passed_by_standing(understudy, tmp_path):
    walk = POLICY.parent / "training" / "go2_flat" / "walk.yaml"
    judged = understudy("rehearse", walk, "--out", tmp_path / "judged", "--", "sh", "-c",
                        f"{sys.executable} {POLICY}/standing.py go2 {tmp_path}/walk.npz && "
                        f"{sys.executable} {POLICY}/deploy.py {tmp_path}/walk.npz lo --at-once --seconds 8")
    assert judged.returncode == 10, judged.stdout + judged.stderr
    failed = re.findall("FAIL  (.*?)  ", judged.stdout.split("the script was refused")[1])
    assert failed == ["is as fast as commanded", "is not faster"], judged.stdout  # their window never began


def test_a_policy_that_fits_is_tried_and_its_joints_are_shown(understudy, tmp_path):
    done = understudy("policy", "check", write_policy(tmp_path), "--robot", "go2", "--velocity", "0.5", "0", "0")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "45 numbers in, 12 out, every 0.02 s" in done.stdout
    assert re.search(r"^FL_calf_joint +5 +-1.500 +-2.72 +-0.84 +0.250 +40 +2 +45.43$", done.stdout, re.MULTILINE)
    assert re.search(r"^5.0 s: 250 commands taken, 0 refused; tilt at most [0-9.]+ deg", done.stdout, re.MULTILINE)


@pytest.mark.parametrize("old, new, code, told", [
    ("base_ang_vel", "base_angvel", 3, "did you mean 'base_ang_vel'"),
    ("  joint_pos_rel: {params: {}, clip: [-100, 100]}\n", "", 3, "the network takes 45 numbers; the observations"),
    ("[0, 1, 2, 3,", "[0, 1, 2, 2,", 3, "FR_calf_joint is in the list already"),
    ("default_joint_pos: [0,", "default_joint_pos: [2,", 10, "FR_hip_joint: default_joint_pos is outside"),
    ("stiffness: [20,", "stiffness: [0,", 10, "FR_hip_joint: has an action, and its stiffness is 0"),
    ("damping: [1,", "damping: [-1,", 3, "damping.0: expected at least 0"),
    ("step_dt: 0.02", "step_dt: 0.0015", 3, "step_dt: expected a multiple"),
    ("stiffness: [20, 20, 40, 20, 20, 40, 20, 20, 40, 20, 20, 40]", "stiffness: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]", 10,
     "the robot sank down"),
])
def test_a_policy_that_does_not_fit_is_refused_before_it_moves_or_fails(understudy, tmp_path, old, new, code, told):
    file = write_policy(tmp_path)
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))
    done = understudy("policy", "check", file, "--robot", "go2")
    assert (done.returncode, told in done.stdout + done.stderr) == (code, True), done.stdout + done.stderr
    assert ("commands taken" in done.stdout) == ("sank" in told)


def test_a_humanoid_is_let_go_on_its_feet(understudy, tmp_path):
    done = understudy("policy", "check", write_policy(tmp_path, "g1"), "--robot", "g1", "--seconds", "0.5")
    assert done.returncode == 0 and "25 commands taken, 0 refused" in done.stdout, done.stdout + done.stderr
