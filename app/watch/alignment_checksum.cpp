// SPDX-License-Identifier: Apache-2.0
#include "app/watch/alignment_checksum.h"

#include <zlib.h>

#include <string_view>
#include <type_traits>

namespace orbwatch::app {
namespace {

class Checksum {
 public:
  /// -0 counts as 0.
  void add(double value) {
    const double number = value == 0 ? 0 : value;
    add(&number, sizeof number);
  }
  void add(std::string_view text) { add(text.data(), text.size()); }
  void add(const optics::Vec3& v) {
    for (const double value : {v.x, v.y, v.z}) add(value);
  }
  void add(const optics::Mat3& m) {
    for (const optics::Vec3& row : {m.row0, m.row1, m.row2}) add(row);
  }
  void add(const optics::Outline& o) {
    for (const double value : {o.centre.u, o.centre.v, o.rx, o.ry, o.angle}) add(value);
  }
  void add(const optics::Pose& pose) {
    add(pose.rotation);
    add(pose.position);
  }
  void add(const optics::Window& window) {
    add(window.normal);
    add(window.thickness);
    add(window.index);
  }
  void add(const optics::Intrinsics& lens) {
    for (const double value : {lens.fx, lens.fy, lens.cx, lens.cy}) add(value);
    add(static_cast<double>(lens.distortion));
    for (const double value : lens.coefficients) add(value);
  }
  /// A member that is absent differs from each that is there.
  template <class Member>
  void add_if_stated(const std::optional<Member>& member) {
    add(member ? 1.0 : 0.0);
    if (member) add(*member);
  }

  std::uint32_t value() const { return static_cast<std::uint32_t>(crc_); }

 private:
  void add(const void* bytes, std::size_t count) {
    crc_ = crc32_z(crc_, static_cast<const Bytef*>(bytes), count);
  }

  uLong crc_ = 0;
};

}  // namespace

std::uint32_t alignment_checksum(const AlignedSite& site, std::size_t camera) {
  const optics::RigCamera& own = site.rig_camera(camera);
  Checksum sum;
  sum.add(site.cameras[camera].name);
  sum.add(static_cast<double>(own.model));
  sum.add_if_stated(own.intrinsics);
  sum.add_if_stated(own.pose);
  sum.add_if_stated(own.outline);
  sum.add_if_stated(own.alpha);
  sum.add_if_stated(own.distance);
  sum.add(own.registration);
  sum.add(own.is_registered ? 1.0 : 0.0);
  sum.add_if_stated(own.window);
  sum.add(site.rig.ball.centre);
  sum.add(site.rig.ball.radius);
  for (const CalibrationEntry& entry : site.alignments) {
    if (camera_of(entry).camera != own.name) continue;
    sum.add(static_cast<double>(entry.number));
    sum.add(entry.time);
  }
  return sum.value();
}

}  // namespace orbwatch::app
