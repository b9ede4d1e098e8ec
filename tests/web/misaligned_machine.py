# SPDX-License-Identifier: Apache-2.0
"""A daemon with the simulated machine whose rig file is wrong: every ball 5 % too large and
displaced, the thermal camera turned by 10 degrees. The true values are computed here by plain
vectors, from the poses that the demo's rig file states."""

import tomllib

import numpy

from appliance import Appliance

TOO_LARGE = 1.05
BESIDE = 0.05  # share of the radius, to the right and down
TURNED_DEG = 10


def outline_of(camera, ball):
    """Limb of the ball for a pinhole camera: centre, radii, angle in degrees."""
    lens = camera["intrinsics"]
    to_pixels = numpy.array([[lens["fx"], 0, lens["cx"]], [0, lens["fy"], lens["cy"]], [0, 0, 1]])
    rotation = numpy.reshape(camera["pose"]["rotation"], (3, 3))
    towards = rotation @ (numpy.array(ball["centre"]) - camera["pose"]["position"])
    distance = numpy.linalg.norm(towards)
    axis = towards / distance
    # The rays w of the limb are those with (axis . w)^2 = cos^2 |w|^2: a conic.
    cosine2 = 1 - (ball["radius"] / distance) ** 2
    inverse = numpy.linalg.inv(to_pixels)
    conic = inverse.T @ (numpy.outer(axis, axis) - cosine2 * numpy.eye(3)) @ inverse
    quadratic, linear = conic[:2, :2], conic[:2, 2]
    centre = numpy.linalg.solve(quadratic, -linear)
    scale = -(conic[2, 2] + linear @ centre)
    values, vectors = numpy.linalg.eigh(quadratic / scale)
    radii = 1 / numpy.sqrt(values)
    angle = numpy.degrees(numpy.arctan2(vectors[1, 0], vectors[0, 0]))
    return {"u": centre[0], "v": centre[1], "rx": radii[0], "ry": radii[1], "angle": angle}


def seen_at(camera, ball, point):
    """Pixel at which the ball shows a point: at the point of reflection, both angles to the
    sphere's normal are the same."""
    eye = numpy.array(camera["pose"]["position"]) - ball["centre"]
    point = numpy.array(point) - ball["centre"]
    forward = eye / numpy.linalg.norm(eye)
    across = point - (point @ forward) * forward
    across /= numpy.linalg.norm(across)

    def excess(a):
        """Excess of the angle between the normal and the camera over that between the normal and
        the point."""
        normal = numpy.cos(a) * forward + numpy.sin(a) * across
        along = -numpy.sin(a) * forward + numpy.cos(a) * across
        to_eye, to_point = (end - ball["radius"] * normal for end in (eye, point))
        return (numpy.arctan2(-(to_eye @ along), to_eye @ normal)
                - numpy.arctan2(to_point @ along, to_point @ normal))

    low, high = 0, numpy.arccos(ball["radius"] / numpy.linalg.norm(eye))
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    spot = ball["radius"] * (numpy.cos(low) * forward + numpy.sin(low) * across)
    lens = camera["intrinsics"]
    x, y, z = numpy.reshape(camera["pose"]["rotation"], (3, 3)) @ (spot - eye)
    return lens["fx"] * x / z + lens["cx"], lens["fy"] * y / z + lens["cy"]


def direction_of(yaw, pitch):
    """Unit vector, from degrees."""
    yaw, pitch = numpy.radians([yaw, pitch])
    return numpy.array([numpy.sin(yaw) * numpy.cos(pitch), numpy.cos(yaw) * numpy.cos(pitch),
                        numpy.sin(pitch)])


def registration_of(camera):
    """Rotation from the camera's own axes, X = -right, Y = -forward, Z = -down, to the
    machine's."""
    right, down, forward = numpy.reshape(camera["pose"]["rotation"], (3, 3))
    return numpy.column_stack([-right, -forward, -down])


def angles_of(rotation):
    """Yaw, pitch and roll of a rotation."""
    right, forward, up = rotation.T
    return numpy.degrees([numpy.arctan2(forward[0], forward[1]), numpy.arcsin(forward[2]),
                          numpy.arctan2(-right[2], up[2])])


def rotation_of(angles):
    """The inverse of angles_of()."""
    yaw, pitch, roll = numpy.radians([angles["yaw"], angles["pitch"], angles["roll"]])
    about_z = numpy.array([[numpy.cos(yaw), numpy.sin(yaw), 0],
                           [-numpy.sin(yaw), numpy.cos(yaw), 0], [0, 0, 1]])
    about_x = numpy.array([[1, 0, 0], [0, numpy.cos(pitch), -numpy.sin(pitch)],
                           [0, numpy.sin(pitch), numpy.cos(pitch)]])
    about_y = numpy.array([[numpy.cos(roll), 0, numpy.sin(roll)], [0, 1, 0],
                           [-numpy.sin(roll), 0, numpy.cos(roll)]])
    return about_z @ about_x @ about_y


def degrees_between(a, b):
    """Angle of the rotation that leads from one rotation to the other."""
    return numpy.degrees(numpy.arccos(numpy.clip((numpy.trace(a @ b.T) - 1) / 2, -1, 1)))


def turned(rotation, degrees):
    """Rotation about an axis that is not one of the machine's."""
    axis = numpy.array([0.48, 0.6, 0.64])
    cross = numpy.cross(numpy.eye(3), axis)
    a = numpy.radians(degrees)
    return (numpy.eye(3) + numpy.sin(a) * cross + (1 - numpy.cos(a)) * cross @ cross) @ rotation


class MisalignedMachine(Appliance):
    """`truth`: outline and registration of each camera. Cameras can be unplugged."""

    def __init__(self):
        super().__init__()
        rig = tomllib.loads((self.folder / "demo-rig.toml").read_text(encoding="utf-8"))
        self.truth = {camera["name"]: (outline_of(camera, rig["ball"]), registration_of(camera))
                      for camera in rig["camera"]}
        self.rig = rig
        (self.folder / "demo-rig.toml").write_text(self.wrong_rig(), encoding="utf-8")
        site = self.folder / "demo.toml"
        connected = self.folder / "connected"
        connected.mkdir()
        for name in self.truth:
            (connected / name).touch()
        site.write_text(site.read_text(encoding="utf-8")
                        + f'\n[simulation]\nconnected = "{connected}"\n', encoding="utf-8")

    def unplug(self, camera):
        (self.folder / "connected" / camera).unlink()

    def plug_in(self, camera):
        (self.folder / "connected" / camera).touch()

    def wrong_rig(self):
        ball, scene = self.rig["ball"], self.rig["scene"]
        text = (f"[ball]\ncentre = {ball['centre']}\nradius = {ball['radius']}\n[scene]\n"
                f"room = \"box\"\nlow = {scene['low']}\nhigh = {scene['high']}\n")
        for obstacle in scene["obstacle"]:
            text += (f"[[scene.obstacle]]\nname = \"{obstacle['name']}\"\nlow = {obstacle['low']}\n"
                     f"high = {obstacle['high']}\n")
        for camera in self.rig["camera"]:
            outline, registration = self.truth[camera["name"]]
            beside = BESIDE * outline["rx"]
            if camera["name"] == "thermal":
                registration = turned(registration, TURNED_DEG)
            lens = "\n".join(f"{key} = {value}" for key, value in camera["intrinsics"].items())
            text += (f"[[camera]]\nname = \"{camera['name']}\"\nwidth = {camera['width']}\n"
                     f"height = {camera['height']}\n[camera.intrinsics]\n{lens}\n"
                     f"[camera.outline]\ncentre = [{outline['u'] + beside}, {outline['v'] + beside}]"
                     f"\nradii = [{TOO_LARGE * outline['rx']}, {TOO_LARGE * outline['ry']}]\n"
                     f"angle = {outline['angle']}\n"
                     f"rotation = {[float(angle) for angle in angles_of(registration)]}\n")
        return text
