# SPDX-License-Identifier: Apache-2.0
"""A daemon with one camera that paints each frame's number, and a view of it pixel by pixel."""

import pathlib
import tempfile

from appliance import Appliance, free_port


class NumberedMachine(Appliance):
    def __init__(self, width, height, frame_rate):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-web-"))
        self.port = free_port()
        self.daemon = None
        self.width, self.height, self.frame_rate = width, height, frame_rate
        size = f"width = {width}\nheight = {height}\n"
        middle = [(width - 1) / 2, (height - 1) / 2]
        (self.folder / "rig.toml").write_text(f'''[[camera]]
name = "ball"
{size}[camera.intrinsics]
fx = {5 * width}
fy = {5 * width}
cx = {middle[0]}
cy = {middle[1]}
[camera.outline]
centre = {middle}
radii = [{0.48 * height}, {0.48 * height}]
''', encoding="utf-8")
        (self.folder / "demo.toml").write_text(f'''state_folder = "state"
rig = "rig.toml"
[web]
enabled = true
port = {self.port}
[[camera]]
name = "ball"
back_end = "test_pattern"
{size}frame_rate = {frame_rate}
[camera.test_pattern]
pixel_format = "nv12"
numbered = true
[[view]]
name = "ball"
kind = "ball"
{size}[[view.source]]
camera = "ball"
''', encoding="utf-8")
