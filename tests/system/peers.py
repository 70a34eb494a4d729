"""Other programs on the robot's network, played by this process with the vendor's message types."""

import contextlib
import functools
import gc
import time

from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.internal import InvalidSample
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from unitree_sdk2py.core.channel import ChannelFactoryInitialize
from unitree_sdk2py.idl.default import (
    unitree_go_msg_dds__LowCmd_,
    unitree_go_msg_dds__LowState_,
    unitree_hg_msg_dds__LowCmd_,
)
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_ as GoLowCmd
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_ as GoLowState
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_ as HgLowCmd
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowState_ as HgLowState
from unitree_sdk2py.utils.crc import CRC

from robots import eventually

CONFIG = ('<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="{}"/>'
          "</Interfaces></General></Domain></CycloneDDS>")
KEEP_ALL = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepAll)
KEEP_NEWEST = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(1))


@functools.cache
def join(domain, interface="lo"):
    """Joins the domain on that interface for the life of this process; 0 as the vendor's SDK does,
    so that its clients can be used beside ours."""
    return ChannelFactoryInitialize(0, interface) if domain == 0 else Domain(
        domain, CONFIG.format(interface))


class Listener:
    """Keeps every sample of a topic from its construction on, or what `qos` says."""

    def __init__(self, topic="rt/lowstate", message=GoLowState, domain=0, qos=KEEP_ALL):
        join(domain)
        self._participant = DomainParticipant(domain)
        topic = Topic(self._participant, topic, message)
        self._reader = DataReader(self._participant, topic, qos=qos)

    def take(self):
        """What has arrived since the last call."""
        return [sample for sample in self._reader.take(N=100_000)
                if not isinstance(sample, InvalidSample)]

    def take_for(self, seconds):
        time.sleep(seconds)
        return self.take()

    def wait(self):
        """The first samples to arrive."""
        return eventually(self.take, what="a sample arrives")


@contextlib.contextmanager
def listener(*arguments, **how):
    """A Listener that leaves the network at the end of the block."""
    one = Listener(*arguments, **how)
    try:
        yield one
    finally:
        del one._reader, one._participant
        gc.collect()


class Speaker:
    """A writer of any topic; silent until it is told to write."""

    def __init__(self, topic, message, domain=0):
        join(domain)
        self._participant = DomainParticipant(domain)
        self._writer = DataWriter(self._participant, Topic(self._participant, topic, message))
        self._crc = CRC()

    def write(self, message):
        self._writer.write(message)

    def speak_until(self, condition, message):
        """Writes the message again and again until condition() holds; gives its value."""
        def spoken():
            self.write(message)
            return condition()

        return eventually(spoken, what="what was said has its effect")

    def write_signed(self, message):
        """Fills the CRC first."""
        message.crc = self._crc.Crc(message)
        self._writer.write(message)

    def write_for(self, seconds, message, period=0.005):
        """The same signed message again and again."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.write_signed(message)
            time.sleep(period)


@contextlib.contextmanager
def speaker(topic, message, domain=0):
    """A Speaker that leaves the network at the end of the block."""
    one = Speaker(topic, message, domain)
    try:
        yield one
    finally:
        del one._writer, one._participant
        gc.collect()


def stranger():
    """Somebody else's robot: a Speaker on rt/lowstate."""
    return speaker("rt/lowstate", GoLowState)


def go_state():
    return unitree_go_msg_dds__LowState_()


def go_command():
    """A LowCmd that a Go2 takes and that moves nothing: all motors on, without gains."""
    message = unitree_go_msg_dds__LowCmd_()
    message.head = [0xFE, 0xEF]
    message.level_flag = 0xFF
    for motor in message.motor_cmd:
        motor.mode = 1
    return message


def hg_command(mode_machine, mode_pr=0):
    message = unitree_hg_msg_dds__LowCmd_()
    message.mode_machine = mode_machine
    message.mode_pr = mode_pr
    for motor in message.motor_cmd:
        motor.mode = 1
    return message


__all__ = ["KEEP_NEWEST", "GoLowCmd", "GoLowState", "HgLowCmd", "HgLowState", "go_command", "go_state",
           "hg_command", "join", "listener", "speaker", "stranger"]
