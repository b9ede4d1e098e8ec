// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "app/model/sink/view.h"

namespace orbwatch::app::tests {

/// A view whose pixels differ from each other and between frame sets, 8 bits and 16 bits; `padding`
/// samples follow each row.
inline std::shared_ptr<View> make_view(std::size_t index, std::string_view name,
                                       std::uint64_t frame_set, int width, int height,
                                       bool radiometric = false, int padding = 0) {
  auto view = std::make_shared<View>();
  view->index = index;
  view->name = name;
  view->frame_set = frame_set;
  view->stamp = hal::Clock::now();
  const int stride = width * 3 + padding;
  view->bytes.assign(static_cast<std::size_t>(stride) * height, 0xEE);
  const ImageView<std::uint8_t> colour{view->bytes.data(), width, height, 3, stride};
  view->picture = picture_of(PixelFormat::Rgb, colour);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * 3; ++x) {
      colour.row(y)[x] = static_cast<std::uint8_t>(x * 7 + y * 13 + frame_set * 29 + index);
    }
  }
  if (!radiometric) return view;
  const int word_stride = width + padding;
  view->words.assign(static_cast<std::size_t>(word_stride) * height, 0xEEEE);
  view->radiometric = {view->words.data(), width, height, 1, word_stride};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      view->radiometric.row(y)[x] =
          static_cast<std::uint16_t>(x * 257 + y * 4099 + frame_set * 3 + 0x1234);
    }
  }
  return view;
}

}  // namespace orbwatch::app::tests
