// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/ring_size.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

namespace orbwatch::app::recorder {
namespace {

constexpr double kBytesPerMebibyte = 1 << 20;
/// A chunk of a recording has room for one.
constexpr std::size_t kMostPictureBytes = std::size_t{31} << 20;

}  // namespace

bool is_recorded(const EventSettings& settings, std::string_view camera) {
  return settings.cameras.empty() ||
         std::ranges::find(settings.cameras, camera) != settings.cameras.end();
}

std::size_t picture_bytes_of(const RecordedCamera& camera) {
  constexpr std::size_t kLeastCompression = 4;
  const PixelFormat format = camera.format.format;
  if (camera.format.has_jpeg) {
    const int row = row_bytes(format, camera.format.width);
    return picture_bytes(format, static_cast<std::size_t>(row), camera.format.height) /
           kLeastCompression;
  }
  const auto part = hal::recording::widened(camera.ball, format);
  return picture_bytes(format, static_cast<std::size_t>(row_bytes(format, part.width)),
                       part.height);
}

Result<> check_ring(const EventSettings& settings, const std::vector<RecordedCamera>& cameras) {
  for (const std::string& name : settings.cameras) {
    if (std::ranges::find(cameras, name, &RecordedCamera::name) == cameras.end()) {
      return fail("recorder.events.cameras: there is no camera " + name);
    }
  }
  double bytes_per_second = 0;
  for (const RecordedCamera& camera : cameras) {
    if (!is_recorded(settings, camera.name)) continue;
    if (picture_bytes_of(camera) > kMostPictureBytes) {
      return fail("recorder.events.cameras: a picture of " + camera.name +
                  " is larger than 31 MiB, the limit of recordings; name other cameras");
    }
    bytes_per_second += camera.format.frame_rate * static_cast<double>(picture_bytes_of(camera));
  }
  const double seconds = std::chrono::duration<double>(settings.before + settings.after).count();
  const auto needed = static_cast<int>(std::ceil(seconds * bytes_per_second / kBytesPerMebibyte));
  if (needed <= settings.ring_mib) return {};
  return fail("recorder.events.ring_mib is " + std::to_string(settings.ring_mib) +
              "; before_s and after_s together need " + std::to_string(needed) +
              " at these sizes and rates: set more, or shorter times");
}

}  // namespace orbwatch::app::recorder
