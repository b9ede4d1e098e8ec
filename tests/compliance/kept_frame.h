// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "hal/frame/frame.h"

namespace orbwatch::tests {

/// Held frame and a copy of its samples at arrival.
class KeptFrame {
 public:
  explicit KeptFrame(hal::Frame frame) : frame_(std::move(frame)), samples_(samples(*frame_)) {}

  bool is_unchanged() const { return samples(*frame_) == samples_; }
  const hal::FrameMetadata& metadata() const { return frame_->metadata; }

 private:
  static std::vector<std::byte> samples(const hal::FrameBuffer& frame) {
    const Picture& picture = frame.picture;
    const PixelFormatInfo& facts = info(picture.format);
    std::vector<std::byte> bytes;
    for (std::size_t n = 0; n < facts.plane_count(); ++n) {
      const auto& plane = picture.planes[n];
      // A row of a plane has this share of the first plane's bytes, as in Picture::contiguous().
      const auto row = static_cast<std::ptrdiff_t>(
          (row_bytes(picture.format, picture.width) * facts.planes[n].samples >>
           facts.planes[n].shift_x) /
          facts.channels());
      for (int y = 0; y < picture.height >> facts.planes[n].shift_y; ++y) {
        const std::byte* const first = plane.data + y * plane.stride;
        bytes.insert(bytes.end(), first, first + row);
      }
    }
    return bytes;
  }

  hal::Frame frame_;
  std::vector<std::byte> samples_;
};

}  // namespace orbwatch::tests
