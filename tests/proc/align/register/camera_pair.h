// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "proc/align/register/registration.h"
#include "tests/support/mirror_room.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::tests {

/// Two cameras of one simulated room: all of the first one is known, and of the second one
/// everything except its registration.
struct CameraPair {
  MirrorRoomPair room;
  optics::Rig rig;
  optics::RigCamera known;
  optics::RigCamera sought;
  optics::Mat3 truth;  ///< the second camera's registration

  align::ReferenceCamera reference() const {
    return {picture_of_mat(room.first.pixels), *optics::ball_projection(rig, known)};
  }
  align::SoughtCamera unknown() const {
    return {picture_of_mat(room.second.pixels), rig, sought, 0};
  }
};

/// The camera's own axes: X = -right, Y = -forward, Z = -down.
inline optics::Mat3 registration_of_axes(const optics::Mat3& axes) {
  return transposed(optics::Mat3{-axes.row0, -axes.row2, -axes.row1});
}

inline optics::Intrinsics intrinsics_of(const MirrorRoomPicture& seen) {
  optics::Intrinsics lens;
  lens.width = seen.pixels.cols;
  lens.height = seen.pixels.rows;
  lens.fx = lens.fy = seen.focal_length;
  lens.cx = (lens.width - 1) * 0.5;
  lens.cy = (lens.height - 1) * 0.5;
  return lens;
}

/// The outline; the limb's longer axis points to the principal point.
inline optics::Outline outline_of(const MirrorRoomPicture& seen) {
  const optics::Intrinsics lens = intrinsics_of(seen);
  const optics::Vec2 c = seen.limb.centre;
  const double radial = std::atan2(c.v - lens.cy, c.u - lens.cx);
  return {c, seen.limb.ry, seen.limb.rx, optics::degrees(radial)};
}

/// Settings of a random camera.
inline MirrorRoomSettings any_camera(std::uint64_t seed, bool thermal, std::mt19937_64& random) {
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  MirrorRoomSettings s;
  s.seed = seed;
  s.thermal = thermal;
  s.width = thermal ? 320 : 800;
  s.height = thermal ? 256 : 600;
  s.distance = std::exp(in(std::log(5), std::log(30)));
  s.radius = thermal ? in(80, 115) : in(150, 280);
  const double off = in(0, 0.5), way = in(0, 2 * std::numbers::pi);
  s.off_axis = {off * std::cos(way), off * std::sin(way)};
  while (share_outside(s) > 0) s.off_axis = {0.9 * s.off_axis.u, 0.9 * s.off_axis.v};
  s.exposure = in(-1, 1);
  s.noise = thermal ? in(1, 3) : in(0.5, 3);
  s.blur = in(0.3, 1);
  return s;
}

/// A colour camera, and a second one of either kind. Outlines, lenses, radius and the room's walls
/// and boxes are stated. `seed` determines everything. `table`: adds a big box on the floor.
inline CameraPair camera_pair(std::uint64_t seed, bool thermal, bool table = false) {
  std::mt19937_64 random(seed);
  MirrorRoomSettings first = any_camera(seed, false, random);
  first.table = table;
  first.limb_hidden = std::uniform_real_distribution<double>(0, 0.1)(random);
  const MirrorRoomSettings second = any_camera(seed, thermal, random);
  CameraPair pair{mirror_room_pair(first, second), {}, {}, {}, {}};
  const MirrorRoomPicture &a = pair.room.first, &b = pair.room.second;
  pair.rig.ball = {{}, 1};
  pair.rig.scene = pair.room.scene;
  pair.known.name = "A";
  pair.known.width = first.width;
  pair.known.height = first.height;
  pair.known.intrinsics = intrinsics_of(a);
  pair.known.pose = optics::Pose{a.axes, a.position};
  pair.sought.name = "B";
  pair.sought.width = second.width;
  pair.sought.height = second.height;
  pair.sought.intrinsics = intrinsics_of(b);
  pair.sought.outline = outline_of(b);
  pair.truth = registration_of_axes(b.axes);
  return pair;
}

}  // namespace orbwatch::tests
