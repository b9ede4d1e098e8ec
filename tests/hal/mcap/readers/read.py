# SPDX-License-Identifier: Apache-2.0
"""read.py FOLDER: prints what rosbags reads of a bag (metadata.yaml and recording), a line per message."""
import sys

from rosbags.rosbag2 import Reader

with Reader(sys.argv[1]) as reader:
    lines = [f"{connection.topic} {connection.msgtype} {timestamp} {bytes(data).hex()}"
             for connection, timestamp, data in reader.messages()]
print("\n".join(sorted(lines)))
