// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/hal/recording/picture_file.h"

namespace orbwatch::tests {

/// Picture of a camera in the frame set of that number, 30 a second.
struct RecordedPictureOf {
  std::string camera;
  std::uint64_t set = 0;
  Picture picture;
};

/// Writes whole pictures as a recording; those of a camera have one size and format.
inline void write_recorded_pictures(const std::string& path,
                                    const std::vector<RecordedPictureOf>& pictures) {
  PictureFile file(path);
  std::map<std::string, CameraTopics> topics;
  for (const auto& [camera, set, picture] : pictures) {
    const hal::StreamFormat format{picture.format, {}, picture.width, picture.height, 30};
    CameraTopics& own = topics.try_emplace(camera, file, camera, format).first->second;
    const std::uint64_t time = 1'700'000'000'000'000'000 + set * 1'000'000'000 / 30;
    own.write(picture, {0, 0, picture.width, picture.height}, time, time,
              static_cast<std::uint32_t>(set));
  }
  file.finish();
}

}  // namespace orbwatch::tests
