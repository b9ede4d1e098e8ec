// SPDX-License-Identifier: Apache-2.0
#include "tests/proc/align/place/mirrored_tags.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/aruco.hpp>
#include <optional>
#include <type_traits>

namespace orbwatch::tests {
namespace {

constexpr int kCells = 8;  ///< cells of a side of the tag, its border included

/// The cells, true where white.
using Cells = std::array<std::array<bool, kCells>, kCells>;

template <class Given>
const cv::aruco::Dictionary& value(const Given& dictionary) {
  if constexpr (std::is_same_v<Given, cv::Ptr<cv::aruco::Dictionary>>) {
    return *dictionary;
  } else {
    return dictionary;
  }
}

Cells cells_of(int id) {
  const auto given = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  const cv::aruco::Dictionary& dictionary = value(given);
  const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(
      dictionary.bytesList.rowRange(id, id + 1), dictionary.markerSize);
  Cells cells{};
  for (int row = 0; row < bits.rows; ++row) {
    for (int column = 0; column < bits.cols; ++column) {
      cells[std::size_t(row) + 1][std::size_t(column) + 1] =
          bits.at<std::uint8_t>(row, column) != 0;
    }
  }
  return cells;
}

/// A printed sheet in space.
struct Sheet {
  explicit Sheet(const PrintedTag& tag)
      : cells(cells_of(tag.id)),
        corner(tag.corners[0]),
        right(tag.corners[1] - tag.corners[0]),
        down(tag.corners[3] - tag.corners[0]),
        normal(cross(right, down)) {}

  /// Brightness and distance of a ray's intersection with the sheet.
  struct Meeting {
    double way;
    double brightness;
  };
  std::optional<Meeting> meet(const Vec3& origin, const Vec3& direction) const {
    const double way = dot(corner - origin, normal) / dot(direction, normal);
    if (!(way > 0)) return std::nullopt;
    const Vec3 at = origin + direction * way - corner;
    const double x = dot(at, right) / dot(right, right) * kCells;
    const double y = dot(at, down) / dot(down, down) * kCells;
    if (!(x > -1 && y > -1 && x < kCells + 1 && y < kCells + 1)) return std::nullopt;
    const bool is_margin = x < 0 || y < 0 || x >= kCells || y >= kCells;
    const bool white = is_margin || cells[std::size_t(y)][std::size_t(x)];
    return Meeting{way, white ? 200.0 : 25.0};
  }

  Cells cells;
  Vec3 corner, right, down, normal;
};

double room(const Vec3& direction) {
  return 110 + 40 * std::sin(3 * direction.x + 1) * std::cos(4 * direction.y) + 30 * direction.z;
}

double brightness(const MirroredRig& rig, const std::vector<Sheet>& sheets, const Vec3& eye,
                  const Vec3& ray) {
  const Vec3 from = (eye - rig.centre) * (1 / rig.radius);
  const double along = dot(from, ray), root = along * along - dot(from, from) + 1;
  if (!(root >= 0 && along < 0)) return 60 + 20 * ray.x;
  const Vec3 normal = from + ray * (-along - std::sqrt(root));
  const Vec3 out = ray - normal * (2 * dot(ray, normal));
  const Vec3 origin = rig.centre + normal * rig.radius;
  double nearest = std::numeric_limits<double>::infinity(), light = room(out);
  for (const Sheet& sheet : sheets) {
    const auto met = sheet.meet(origin, out);
    if (!met || !(met->way < nearest)) continue;
    nearest = met->way;
    light = met->brightness;
  }
  return light;
}

}  // namespace

PrintedTag tag_around(const MirroredRig& rig, const Vec3& direction, double distance, double side,
                      double tilt, double turn, int id) {
  // The printed side, seen from the ball, has its right on the right and its bottom below.
  const Vec3 any = std::abs(direction.z) < 0.8 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 level = normalized(cross(direction, any)), below = cross(direction, level);
  const Vec3 right = level * std::cos(turn) + below * std::sin(turn);
  const Vec3 down = below * std::cos(turn) - level * std::sin(turn);
  const Vec3 tilted = normalized(right * std::cos(tilt) + direction * std::sin(tilt));
  const Vec3 middle = rig.centre + direction * (distance * rig.radius);
  const Vec3 x = tilted * (side / 2), y = down * (side / 2);
  return {id, {middle - x - y, middle + x - y, middle + x + y, middle - x + y}};
}

TagScene random_tag_scene(std::mt19937_64& random, double least, double most, int side) {
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  TagScene scene;
  scene.rig = random_rig(random, {});
  scene.rig.radius = 50;
  RigCamera& camera = scene.rig.cameras[0];
  camera.width = camera.height = side;
  const Vec3 towards = normalized(scene.rig.centre - camera.pose.position);
  const double distance = in(6, 16);
  camera.pose.position = scene.rig.centre - towards * (distance * scene.rig.radius);
  camera.focal = in(least, most) * std::sqrt(distance * distance - 1);
  // The camera faces the ball, except for a small offset.
  const Vec3 forward = normalized(towards + camera.pose.rotation.row0 * in(0, 60 / camera.focal));
  const Vec3 right = normalized(cross(camera.pose.rotation.row1, forward));
  camera.pose.rotation = {right, cross(forward, right), forward};
  // Tags are in four directions well apart, which the ball shows.
  std::vector<Vec3> ways;
  while (ways.size() < 4) {
    std::normal_distribution<double> normal;
    const Vec3 way = normalized(Vec3{normal(random), normal(random), normal(random)});
    const bool shown = dot(way, -towards) > std::cos(optics::radians(115));
    const auto is_near = [&](const Vec3& other) { return dot(way, other) > std::cos(0.8); };
    if (shown && std::ranges::none_of(ways, is_near)) ways.push_back(way);
  }
  for (const Vec3& way : ways) {
    const int id = int(in(0, 580));
    scene.tags.push_back(tag_around(scene.rig, way, in(6, 10), 120, in(-0.4, 0.4), in(-3, 3), id));
  }
  return scene;
}

cv::Mat picture_of_tags(const MirroredRig& rig, const RigCamera& camera,
                        const std::vector<PrintedTag>& tags, double noise,
                        std::mt19937_64& random) {
  const std::vector<Sheet> sheets(tags.begin(), tags.end());
  const optics::Mat3& axes = camera.pose.rotation;
  cv::Mat picture(camera.height, camera.width, CV_8U);
  std::normal_distribution<double> normal;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      double sum = 0;
      for (int ray = 0; ray < 9; ++ray) {
        const double u = column + (ray % 3 - 1) / 3.0, v = row + (ray / 3 - 1) / 3.0;
        const Vec3 way =
            normalized(axes.row0 * ((u - camera.middle().u) / camera.focal) +
                       axes.row1 * ((v - camera.middle().v) / camera.focal) + axes.row2);
        sum += brightness(rig, sheets, camera.pose.position, way);
      }
      picture.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(sum / 9 + noise * normal(random));
    }
  }
  return picture;
}

}  // namespace orbwatch::tests
