// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "proc/optics/scene_proxy.h"
#include "proc/optics/vec.h"

namespace orbwatch::tests {

/// A random room with a mirror ball, or without one, and a camera in front of it. Rays are
/// reflected by plain vectors; nothing of the product's ball models is used. Lengths in ball radii,
/// the ball at the origin.
///
/// The room is a box that is full of boxes, tubes and matt spheres, with patterned surfaces and
/// lamps; a camera outside sees through its walls. The ball hangs on a rod.
struct MirrorRoomSettings {
  std::uint64_t seed = 1;
  int width = 640;
  int height = 480;
  double distance = 12;    ///< the camera's, from the ball's centre
  double radius = 150;     ///< approximate radius of the ball's picture, px
  optics::Vec2 off_axis;   ///< offset of the ball's centre, as a share of the half field
  double limb_hidden = 0;  ///< share of the limb that the rod hides
  double exposure = 0;     ///< EV
  double noise = 1;        ///< counts of 255; thermal: of 25 mK
  double blur = 0.5;       ///< sigma, px
  bool thermal = false;    ///< 16 bit grey, 25 counts per K, else 8 bit BGR
  bool ball = true;        ///< false: the room without the ball
  bool table = false;      ///< a big box on the floor, unless it is in the cameras' way
};

/// An ellipse in a picture: pixels with centres at integers.
struct TrueLimb {
  optics::Vec2 centre;
  double rx = 0, ry = 0;
};

struct MirrorRoomPicture {
  cv::Mat pixels;
  TrueLimb limb;
  double focal_length = 0;  ///< px; the principal point is the middle
  optics::Vec3 ball;        ///< camera frame, ball radii
  optics::Mat3 axes;        ///< the camera's axes in the room: right, down, forward
  optics::Vec3 position;    ///< the camera's position in the room, ball radii
  /// For a pair: the point in the room that a pixel shows by the ball; nullopt beside the ball.
  std::function<std::optional<optics::Vec3>(const optics::Vec2&)> mirrored;
};

/// The approximate share of the limb that lies outside of the picture.
double share_outside(const MirrorRoomSettings& settings);

/// Traces a room; pixels near the limb by 4x4 rays. Reentrant.
MirrorRoomPicture mirror_room(const MirrorRoomSettings& settings);

/// The same room seen by two cameras from different sides.
struct MirrorRoomPair {
  MirrorRoomPicture first;
  MirrorRoomPicture second;
  optics::Scene scene;  ///< the room's walls and boxes; its tubes and spheres are left out
  std::optional<optics::Box> table;  ///< the last one of the scene's boxes, if there is a table
};

/// The room of `first.seed`, with the rod that hides part of the first camera's limb. A thermal
/// camera sees the same surfaces, but patterns of temperature that do not follow those of the
/// colours: other values, half of the patches missing, faint stripes and stains. The ball is always
/// present. Reentrant.
MirrorRoomPair mirror_room_pair(const MirrorRoomSettings& first, const MirrorRoomSettings& second);

}  // namespace orbwatch::tests
