"""The control plane on TCP, as browsers and malicious clients use it."""

import json
import os
import pathlib
import re
import socket
import subprocess
import tempfile
import urllib.error
import urllib.request

from robots import eventually


def url_of(robot):
    return json.loads(robot.ctl("panel", "--json"))["url"]


def ask(url, path, token=None, body=None, **headers):
    """Status and body of a request at the address that the robot said."""
    if token:
        headers["Authorization"] = f"Bearer {token}"
    request = urllib.request.Request(url.split("/#")[0] + path, headers=headers,
                                     data=None if body is None else json.dumps(body).encode())
    try:
        with urllib.request.urlopen(request, timeout=10) as reply:
            return reply.status, reply.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def test_a_browser_sees_the_robot_and_moves_it_with_the_token(play):
    url = url_of(play("go2", "--start", "standing", "--released"))
    token = url.split("token=")[1]
    scene = json.loads(ask(url, "/scene")[1])
    snapshot = json.loads(ask(url, "/snapshot")[1])
    assert len(scene["bodies"]) == len(snapshot["bodies"])
    assert len(scene["motors"]) == len(snapshot["motors"]) == 12

    push = {"force": [0, 200, 0], "for": 0.3}
    assert ask(url, "/push", body=push)[0] == 401
    assert ask(url, "/push", token="0" * 32, body=push)[0] == 401
    assert ask(url, "/push", token=token, body=push, Origin="http://evil.example")[0] == 403
    before = snapshot["qpos"][1]
    assert ask(url, "/push", token=token, body=push)[0] == 200
    eventually(lambda: abs(json.loads(ask(url, "/snapshot")[1])["qpos"][1] - before) > 0.005)


def test_the_document_that_it_serves_has_its_routes_and_every_request(play):
    url = url_of(play("go2"))
    status, document = ask(url, "/openapi.yaml")
    requests = json.loads(ask(url, "/requests")[1])["requests"]

    assert status == 200
    assert requests
    for path in ["/status", "/snapshot", *("/" + one["name"].replace(".", "/") for one in requests)]:
        assert f"\n  {path}:\n" in document


def test_metrics_are_what_prometheus_reads(play):
    url = url_of(play("go2"))
    line = re.compile(r"^understudy_\w+(\{(\w+=\"[^\"]*\",?)+\})? (-?[0-9.e+-]+|NaN|[+-]Inf)$")
    text = ask(url, "/metrics")[1]
    for row in text.splitlines():
        assert row.startswith(("# HELP ", "# TYPE ")) or line.match(row), row
    steps = int(re.search(r"^understudy_steps_total (\d+)$", text, re.MULTILINE).group(1))
    eventually(lambda: f"understudy_steps_total {steps}\n" not in ask(url, "/metrics")[1])


def test_a_recording_over_the_network_goes_into_a_plain_file_of_the_starts_folder(play, tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    url = url_of(play("go2"))
    token = url.split("token=")[1]

    def start(file):
        return ask(url, "/record/start", token=token, body={"file": file, "overwrite": True})

    precious = tmp_path / "precious.mcap"
    precious.write_text("mine")
    pathlib.Path("link.mcap").symlink_to(precious)
    for file, status, why in ((str(precious), 403, "without a folder"), ("../precious.mcap", 403, "without a folder"),
                              ("link.mcap", 409, "is a link")):
        assert start(file)[0] == status, file
        assert why in start(file)[1]
    assert precious.read_text() == "mine"
    assert start("walk.mcap")[0] == 200
    assert ask(url, "/record/stop", token=token, body={})[0] == 200
    assert pathlib.Path("walk.mcap").stat().st_size > 0


def test_no_panel_serves_nothing_on_tcp(play, understudy):
    robot = play("go2", "--no-panel")
    assert "panel: http" not in robot.said()
    done = understudy("ctl", "--name", robot.name, "panel")
    assert done.returncode == 1
    assert "no panel" in done.stderr


def test_the_port_of_exec_is_on_the_machine(understudy):
    """The command waits until its robot has been seen from here."""
    command = "until [ -e seen ]; do sleep 0.02; done"
    with tempfile.TemporaryDirectory() as folder:
        robot = subprocess.Popen([os.environ["UNDERSTUDY"], "exec", "go2", "--name", "outside", "--",
                                  "sh", "-c", command], cwd=folder)
        try:
            eventually(lambda: understudy("ctl", "--name", "outside", "wait").returncode == 0)
            done = understudy("ctl", "--name", "outside", "panel", "--json")
            assert ask(json.loads(done.stdout)["url"], "/status")[0] == 200
        finally:
            (pathlib.Path(folder) / "seen").touch()
            assert robot.wait(timeout=15) == 0


def test_hundreds_of_clients_without_manners_do_not_hold_up_the_robot(play):
    robot = play("go2")
    url = url_of(robot)
    host, port = url.split("/#")[0].removeprefix("http://").split(":")
    clients = []
    for i in range(300):
        client = socket.create_connection((host, int(port)))
        client.sendall([b"GET /scene HTTP/1.1\r\nHost: localhost\r\n\r\n" * 20, b"GET /",
                        b"\x16\x03\x01\x02", b"POST /push HTTP/1.1\r\nContent-Length: 99\r\n\r\n"][i % 4])
        clients.append(client)
    before = robot.status()["time"]
    robot.becomes(lambda now: now["time"] > before + 1)
    for client in clients:
        client.close()
    eventually(lambda: ask(url, "/status")[0] == 200)
