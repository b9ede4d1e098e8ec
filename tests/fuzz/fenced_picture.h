// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sanitizer/asan_interface.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "proc/image/picture.h"

namespace orbwatch::fuzz {

/// A picture whose planes are separate memory blocks that end with their last pixel, so that
/// AddressSanitizer detects accesses beyond it.
class FencedPicture {
 public:
  /// Rows are `padding` bytes longer than their pixels; if that is even, slightly more, so that
  /// they begin at a multiple of 8: AddressSanitizer's marks before them are exact only then.
  FencedPicture(PixelFormat format, int width, int height, int padding) {
    const PixelFormatInfo& facts = info(format);
    picture = {format, {}, width, height, {}};
    for (std::size_t n = 0; n < facts.plane_count(); ++n) {
      const PlaneInfo& plane = facts.planes[n];
      Rows& rows = rows_[n];
      rows.pixels = (width >> plane.shift_x) * plane.samples * facts.bytes_per_sample();
      rows.stride = rows.pixels + padding;
      if (padding % 2 == 0) rows.stride = (rows.stride + 7) / 8 * 8;
      rows.count = height >> plane.shift_y;
      const std::ptrdiff_t bytes = (rows.count - 1) * rows.stride + rows.pixels;
      rows.memory.reset(new std::byte[static_cast<std::size_t>(bytes)]);
      picture.planes[n] = {rows.memory.get(), rows.stride};
    }
  }

  /// Fills every byte, pixels and padding.
  void fill(std::byte value) {
    for_each_row([&](std::span<std::byte> pixels, std::span<std::byte> padding) {
      std::fill(pixels.begin(), pixels.end(), value);
      std::fill(padding.begin(), padding.end(), value);
    });
  }

  /// Fills the pixels of all rows, one after another, from `samples`, which has enough of them.
  void fill(std::span<const std::byte> samples) {
    for_each_row([&](std::span<std::byte> pixels, std::span<std::byte>) {
      std::copy_n(samples.begin(), pixels.size(), pixels.begin());
      samples = samples.subspan(pixels.size());
    });
  }

  /// Forbids access to the memory between the rows from now on.
  void forbid_padding() {
    for_each_row([](std::span<std::byte>, std::span<std::byte> padding) {
      ASAN_POISON_MEMORY_REGION(padding.data(), padding.size());
    });
  }

  /// Calls `look(pixels, padding)` for every row of every plane; the last one has no padding.
  template <class Look>
  void for_each_row(const Look& look) const {
    for (const Rows& rows : rows_) {
      for (std::ptrdiff_t y = 0; y < rows.count; ++y) {
        std::byte* const row = rows.memory.get() + y * rows.stride;
        const auto gap = y + 1 < rows.count ? rows.stride - rows.pixels : 0;
        look(std::span(row, static_cast<std::size_t>(rows.pixels)),
             std::span(row + rows.pixels, static_cast<std::size_t>(gap)));
      }
    }
  }

  MutablePicture picture;

 private:
  struct Rows {
    std::unique_ptr<std::byte[]> memory;
    std::ptrdiff_t pixels = 0;  ///< bytes of a row's pixels
    std::ptrdiff_t stride = 0;
    std::ptrdiff_t count = 0;
  };
  std::array<Rows, kMaxPlanes> rows_;
};

}  // namespace orbwatch::fuzz
