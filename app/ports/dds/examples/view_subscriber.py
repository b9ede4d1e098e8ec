#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a view of orbwatch and its calibration as a ROS 2 node.

    python3 view_subscriber.py --ros-args -r image:=/orbwatch/front/image_raw \\
        -r camera_info:=/orbwatch/front/camera_info

`front` is a view of sites that `orbwatch setup` wrote; in the installed configuration use `door`.

Needs ROS 2 (Humble or later): rclpy, sensor_msgs, message_filters; no bridge.
"""

import math

import message_filters
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image


class ViewSubscriber(Node):
    def __init__(self):
        super().__init__('view_subscriber')
        # Best effort: a slow reader gets fewer pictures, never old ones.
        image = message_filters.Subscriber(self, Image, 'image', qos_profile=qos_profile_sensor_data)
        info = message_filters.Subscriber(
            self, CameraInfo, 'camera_info', qos_profile=qos_profile_sensor_data)
        # Both of a frame carry the same stamp, so they are paired exactly.
        self.pairs = message_filters.TimeSynchronizer([image, info], queue_size=5)
        self.pairs.registerCallback(self.on_view)

    def on_view(self, image, info):
        h_fov = 2 * math.degrees(math.atan(info.width / 2 / info.k[0]))
        self.get_logger().info(
            f'{image.header.frame_id}: {image.width}x{image.height} {image.encoding}, '
            f'{h_fov:.1f} deg wide, {len(image.data)} bytes')


def main():
    rclpy.init()
    rclpy.spin(ViewSubscriber())


if __name__ == '__main__':
    main()
