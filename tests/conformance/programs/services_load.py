"""A thousand calls a second beside another client, a client killed in a call, and leases.

Prints one JSON object: how many calls were made and answered, the slowest answer, what the client
beside them was answered, whether the service still answers after a client's death, and the codes of a
second client while the first has a lease.
"""

import json
import signal
import subprocess
import sys
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.internal import InvalidSample
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from unitree_sdk2py.go2.vui.vui_client import VuiClient
from unitree_sdk2py.idl.unitree_api.msg.dds_ import (
    Request_,
    RequestHeader_,
    RequestIdentity_,
    RequestLease_,
    RequestPolicy_,
    Response_,
)
from unitree_sdk2py.rpc.lease_client import LeaseClient

from sdk_session import arguments

GET_VOLUME = 1004
SET_VOLUME = 1003
CALLS_PER_SECOND = 1000
SECONDS = 10
KEEP_ALL = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepAll)

# A client of its own that never stops calling.
ENDLESS = f"""
from unitree_sdk2py.core.channel import ChannelFactoryInitialize
from unitree_sdk2py.go2.vui.vui_client import VuiClient
ChannelFactoryInitialize(0, "lo")
client = VuiClient()
client.SetTimeout(3.0)
client.Init()
print("calling", flush=True)
while True:
    client._Call({GET_VOLUME}, "{{}}")
"""

# One that calls, one call after the other, until its stdin is closed; then says what it was answered.
BESIDE = f"""
import json, select, sys
from unitree_sdk2py.core.channel import ChannelFactoryInitialize
from unitree_sdk2py.go2.vui.vui_client import VuiClient
ChannelFactoryInitialize(0, "lo")
client = VuiClient()
client.SetTimeout(3.0)
client.Init()
print("calling", flush=True)
calls = dict()
while not select.select([sys.stdin], [], [], 0.005)[0]:
    code = client._Call({GET_VOLUME}, "{{}}")[0]
    calls[code] = calls.get(code, 0) + 1
print(json.dumps(calls))
"""


class RawClient:
    """Asks without waiting for an answer, and keeps all of them."""

    def __init__(self):
        self._participant = DomainParticipant(0)
        topic = "rt/api/vui/"
        self._writer = DataWriter(self._participant,
                                  Topic(self._participant, topic + "request", Request_))
        self._reader = DataReader(self._participant,
                                  Topic(self._participant, topic + "response", Response_),
                                  qos=KEEP_ALL)
        self.asked, self.answered = {}, {}
        self._wait_until_matched()

    def ask(self):
        number = time.monotonic_ns()
        header = RequestHeader_(RequestIdentity_(number, GET_VOLUME), RequestLease_(0),
                                RequestPolicy_(0, False))
        self.asked[number] = time.monotonic()
        self._writer.write(Request_(header, "{}", []))

    def collect(self):
        for sample in self._reader.take(N=1000):
            if not isinstance(sample, InvalidSample):
                number = sample.header.identity.id
                if number in self.asked:  # not another client's, nor one of before the load
                    self.answered.setdefault(number, time.monotonic() - self.asked[number])

    def _wait_until_matched(self):
        deadline = time.monotonic() + 10
        while not self.answered and time.monotonic() < deadline:
            self.ask()
            time.sleep(0.1)
            self.collect()
        self.asked.clear()
        self.answered.clear()


def run_load():
    client = RawClient()
    start = time.monotonic()
    for call in range(CALLS_PER_SECOND * SECONDS):
        while time.monotonic() < start + call / CALLS_PER_SECOND:
            client.collect()
            time.sleep(0.0002)
        client.ask()
    deadline = time.monotonic() + 2
    while len(client.answered) < len(client.asked) and time.monotonic() < deadline:
        time.sleep(0.01)
        client.collect()
    return {"asked": len(client.asked), "answered": len(client.answered),
            "slowest": max(client.answered.values(), default=None)}


def start(program):
    """Starts it; returns once it calls."""
    child = subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE,
                             stdout=subprocess.PIPE, text=True)
    for line in child.stdout:
        if line.strip() == "calling":
            break
    return child


def kill_a_client():
    """Ends a program with SIGKILL while it calls."""
    program = start(ENDLESS)
    time.sleep(0.2)
    program.send_signal(signal.SIGKILL)
    program.wait()


def lease_codes(client):
    """SetVolume without the lease, with it, and after it is over."""
    lease = LeaseClient("vui")
    lease._LeaseClient__Apply()  # Init would renew it for ever
    parameter = json.dumps({"volume": 4})
    without = client._CallBase(SET_VOLUME, parameter)[0]
    with_it = client._CallBase(SET_VOLUME, parameter, 0, lease.GetId())[0]
    reading = client._CallBase(GET_VOLUME, "{}")[0]
    time.sleep(1.2)
    return {"without": without, "with": with_it, "reading": reading,
            "after": client._CallBase(SET_VOLUME, parameter)[0]}


def main():
    arguments(__doc__.splitlines()[0])
    client = VuiClient()
    client.SetTimeout(3.0)
    client.Init()
    beside = start(BESIDE)
    report = {"load": run_load()}
    report["beside"] = json.loads(beside.communicate()[0])
    kill_a_client()
    report["after_a_killed_client"] = client.GetVolume()[0]
    report["lease"] = lease_codes(client)
    print(json.dumps(report))


if __name__ == "__main__":
    main()
