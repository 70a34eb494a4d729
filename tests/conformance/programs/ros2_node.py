"""A node of ROS 2 on Fast DDS 3: lists the topics, listens to one, and writes to one that it has another message for.

The report: {"middleware": its name, "types": {topic: its types}, "heard": a text}.
"""

import json
import time

import rclpy
from std_msgs.msg import String, UInt8MultiArray

PATIENCE = 30.0  # s

rclpy.init()
node = rclpy.create_node("conformance")
heard = []
node.create_subscription(String, "/rtc/state", heard.append, 10)
# It has uint8 in it, at whose description Cyclone DDS 0.10.2 crashes.
publisher = node.create_publisher(UInt8MultiArray, "/lowcmd", 10)
deadline = time.monotonic() + PATIENCE
while "/lowstate" not in dict(node.get_topic_names_and_types()) and time.monotonic() < deadline:
    rclpy.spin_once(node, timeout_sec=0.1)
for _ in range(80):
    publisher.publish(UInt8MultiArray(data=bytes(8)))
    rclpy.spin_once(node, timeout_sec=0.05)
print(json.dumps({
    "middleware": rclpy.get_rmw_implementation_identifier(),
    "types": dict(node.get_topic_names_and_types()),
    "heard": heard[0].data if heard else None,
}))
rclpy.shutdown()
