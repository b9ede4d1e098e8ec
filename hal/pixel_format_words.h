// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "proc/image/pixel_format.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Names of all pixel formats in files.
inline constexpr auto kPixelFormatWords = [] {
  std::array<Word<PixelFormat>, kPixelFormats.size()> words{};
  for (std::size_t k = 0; k < words.size(); ++k) {
    words[k] = {kPixelFormats[k].name, kPixelFormats[k].format};
  }
  return words;
}();

}  // namespace orbwatch::hal
