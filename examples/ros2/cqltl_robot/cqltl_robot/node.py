"""A ROS 2 node between people, a cqltl service and a robot.

    ros2 run cqltl_robot follow --ros-args -p server:=http://127.0.0.1:8000 -p environment:=toys-4x1-cylinder

It listens to `command` (std_msgs/String, English) and `state` (std_msgs/String, JSON: object to attribute to value, all
that changes). After each state, while there is a command, it publishes an `action` (std_msgs/String, empty: let a step
pass); do it, then publish the state anew. `status` says what became of a command.
"""

import json
import queue
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

from cqltl_robot.following import Follower, ServiceError


class FollowingNode(Node):
    """HTTP is spoken in a thread of its own, so that callbacks return at once."""

    def __init__(self) -> None:
        super().__init__("cqltl_robot")
        server = self.declare_parameter("server", "http://127.0.0.1:8000").value
        environment = self.declare_parameter("environment", "toys").value
        self._follower = Follower(server, environment)
        self._events: queue.Queue = queue.Queue()
        self._state = None
        self._action = self.create_publisher(String, "action", 10)
        self._status = self.create_publisher(String, "status", 10)
        self.create_subscription(String, "command", lambda message: self._events.put(("command", message.data)), 10)
        self.create_subscription(String, "state", lambda message: self._events.put(("state", message.data)), 10)
        threading.Thread(target=self._work, daemon=True).start()

    def _work(self) -> None:
        while True:
            kind, data = self._events.get()
            try:
                self._command(data) if kind == "command" else self._observed(data)
            except (ServiceError, ValueError) as error:
                self.get_logger().error(str(error))
                self._status.publish(String(data=f"refused: {error}"))

    def _command(self, text: str) -> None:
        understood = self._follower.take(text, self._state)
        self._status.publish(String(data=f"doing: {understood}"))
        if self._state is not None:
            self._act()

    def _observed(self, text: str) -> None:
        self._state = json.loads(text)
        if self._follower.busy:
            self._act()

    def _act(self) -> None:
        step = self._follower.step(self._state)
        if step.status in ("satisfied", "lost"):
            self._status.publish(String(data=step.status))
        else:
            self._action.publish(String(data=step.action or ""))


def main() -> None:
    """Run until interrupted."""
    rclpy.init()
    node = FollowingNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
