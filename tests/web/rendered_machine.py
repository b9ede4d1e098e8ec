# SPDX-License-Identifier: Apache-2.0
"""A daemon that replays rendered pictures of a machine, whose geometry is known, as its cameras."""

import json
import pathlib
import tempfile

import numpy

from appliance import ROOT, Appliance, free_port

PICTURES = ROOT / "../shared/data/renders"
KELVIN_PER_COUNT = 0.04
MARGIN = 1.02  # radius of a ball's view, relative to the limb


def numbers(values):
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def rig_of(scene, machine, cameras):
    """Shifts by half a pixel: the pictures' pixels have their centres at +0.5, the product's at
    integers."""
    lines = ["[ball]", f"centre = {numbers(scene['ball']['centre'])}",
             f"radius = {machine['ball_radius']}", "[scene]", 'room = "box"',
             f"low = {numbers(scene['box']['lo'])}", f"high = {numbers(scene['box']['hi'])}",
             "[[scene.obstacle]]", 'name = "table"', f"low = {numbers(scene['table']['lo'])}",
             f"high = {numbers(scene['table']['hi'])}"]
    for name, camera in cameras.items():
        rotation = numbers(value for row in camera["R_wc"] for value in row)
        lines += ["[[camera]]", f'name = "{name}"', f"width = {camera['width']}",
                  f"height = {camera['height']}", "[camera.intrinsics]",
                  f"fx = {camera['fx']}", f"fy = {camera['fy']}", f"cx = {camera['cx'] - 0.5}",
                  f"cy = {camera['cy'] - 0.5}", "[camera.pose]",
                  f"position = {numbers(camera['C'])}", f"rotation = {rotation}"]
    return "\n".join(lines) + "\n"


class RenderedMachine(Appliance):
    """Camera A in colour and C, thermal, of the machine of real size. Views: `ball` and `heat` show
    the ball pixel by pixel like the cameras; `turned` of A, and `both` of A and, in its blind cone,
    of C."""

    WIDTH, HEIGHT = 900, 520

    def __init__(self, quality):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-web-"))
        self.port = free_port()
        self.daemon = None
        scene = json.loads((PICTURES / "scene.json").read_text(encoding="utf-8"))
        machine = scene["scenes"]["near"]
        cameras = {name: machine["cameras"][name] for name in "AC"}
        self.blind_half_angle = 180 - cameras["A"]["alpha_deg"] / 2
        (self.folder / "rig.toml").write_text(rig_of(scene, machine, cameras), encoding="utf-8")
        (self.folder / "demo.toml").write_text(self.site(cameras, quality), encoding="utf-8")

    def site(self, cameras, quality):
        def side(camera):
            left, top, right, bottom = camera["outline"]["bbox"]
            return round(MARGIN * max(right - left, bottom - top))

        def ball(name):
            return f'kind = "ball"\nwidth = {side(cameras[name])}\nheight = {side(cameras[name])}\n'

        thermal = '[[view.source]]\ncamera = "C"\nrange = [15, 60]\n'
        # Sharpening would amplify the JPEG losses of the ball's picture.
        colour = '[[view.source]]\ncamera = "A"\nsharpness = 0\n'
        perspective = f"width = {self.WIDTH}\nheight = {self.HEIGHT}\n"
        text = f'''state_folder = "state"
rig = "rig.toml"
[web]
enabled = true
port = {self.port}
[web.jpeg]
quality = {quality}
'''
        for name, camera in cameras.items():
            text += f'''[[camera]]
name = "{name}"
back_end = "replay"
width = {camera["width"]}
height = {camera["height"]}
frame_rate = 2
{f"kelvin_per_count = {KELVIN_PER_COUNT}" if name == "C" else ""}
[camera.replay]
source = "{(PICTURES / camera["image"]).resolve()}"
'''
        views = [("ball", ball("A"), colour), ("heat", ball("C"), thermal),
                 ("turned", perspective, colour),
                 ("both", perspective + 'combine = "switch"\n', colour + thermal)]
        for name, shape, sources in views:
            text += f'[[view]]\nname = "{name}"\n{shape}{sources}'
        return text

    def angle_from(self, axis, yaw, pitch, h_fov):
        """Angle of each pixel's direction from the vector `axis`, degrees."""
        a, b = numpy.radians([yaw, pitch])
        right = numpy.array([numpy.cos(a), -numpy.sin(a), 0])
        forward = numpy.array([numpy.sin(a) * numpy.cos(b), numpy.cos(a) * numpy.cos(b),
                               numpy.sin(b)])
        up = numpy.cross(right, forward)
        step = 2 * numpy.tan(numpy.radians(h_fov) / 2) / self.WIDTH
        x = (numpy.arange(self.WIDTH) - (self.WIDTH - 1) / 2) * step
        y = ((self.HEIGHT - 1) / 2 - numpy.arange(self.HEIGHT)) * step
        rays = forward + x[None, :, None] * right + y[:, None, None] * up
        cosine = rays @ numpy.array(axis) / numpy.linalg.norm(rays, axis=2)
        return numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1)))
