// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Topics of a camera in recordings:
///   /<prefix>/<camera>/image_raw             lossless pictures
///   /<prefix>/<camera>/image_raw/compressed  the same as JPEG
///   /<prefix>/<camera>/camera_info           place of the pictures in the camera's whole picture
namespace orbwatch::hal::recording {

inline std::string image_topic(std::string_view prefix, std::string_view camera) {
  return std::string("/").append(prefix).append("/").append(camera).append("/image_raw");
}
inline std::string compressed_topic(std::string_view prefix, std::string_view camera) {
  return image_topic(prefix, camera) + "/compressed";
}
inline std::string camera_info_topic(std::string_view prefix, std::string_view camera) {
  return std::string("/").append(prefix).append("/").append(camera).append("/camera_info");
}

/// Camera of one of these topics, whatever their prefix; nullopt: another topic.
inline std::optional<std::string_view> camera_of(std::string_view topic) {
  for (const std::string_view end : {"/image_raw", "/image_raw/compressed", "/camera_info"}) {
    if (!topic.ends_with(end)) continue;
    const std::string_view camera = topic.substr(0, topic.size() - end.size());
    const std::size_t slash = camera.rfind('/');
    if (slash == std::string_view::npos || slash + 1 == camera.size()) return std::nullopt;
    return camera.substr(slash + 1);
  }
  return std::nullopt;
}

}  // namespace orbwatch::hal::recording
