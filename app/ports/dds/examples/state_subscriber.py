#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the process state and the events of orbwatch as a ROS 2 node.

    python3 state_subscriber.py --ros-args -r state:=/orbwatch/process_state \\
        -r event:=/orbwatch/event

Needs ROS 2 (Humble or later): rclpy, and orbwatch_msgs built in the workspace; no bridge.
"""

import rclpy
from orbwatch_msgs.msg import Event, ProcessState
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile


def figure(component, name):
    """The figure of that name, or None: figures may be added, none is ever removed."""
    return next((f for f in component.figures if f.name == name), None)


class StateSubscriber(Node):
    def __init__(self):
        super().__init__('state_subscriber')
        # Transient local: the newest state and the last events arrive at once.
        def latched(depth):
            return QoSProfile(depth=depth, durability=DurabilityPolicy.TRANSIENT_LOCAL)

        self.create_subscription(ProcessState, 'state', self.on_state, latched(1))
        self.create_subscription(Event, 'event', self.on_event, latched(64))

    def on_state(self, state):
        for region in (c for c in state.components if c.kind == 'region'):
            width = figure(region, 'hot_spot_width')  # NaN: not valid
            self.get_logger().info(
                f'frame set {state.frame_set}, {region.name}: {width.value:.2f} {width.unit}')

    def on_event(self, event):
        self.get_logger().info(f'event {event.number}: {event.text}')


def main():
    rclpy.init()
    rclpy.spin(StateSubscriber())


if __name__ == '__main__':
    main()
