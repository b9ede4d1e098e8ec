#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap {

/// Three channels as bytes in memory, and 0: written as whole words, each over the unused byte of
/// the one before.
class ColourTable {
 public:
  void set(std::size_t entry, const std::array<std::uint8_t, 3>& colour) {
    words_[entry] =
        std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{colour[0], colour[1], colour[2]});
  }

  /// Writes 1 to kRun pixels.
  [[gnu::always_inline]] void look_up(const std::uint8_t* indices, int columns,
                                      std::uint8_t* out) const {
    for (int x = 0; x < columns - 1; ++x) std::memcpy(out + 3 * x, &words_[indices[x]], 4);
    std::memcpy(out + 3 * (columns - 1), &words_[indices[columns - 1]], 3);
  }

  /// Writes `rows` whole runs, `index_stride` and `out_stride` apart.
  [[gnu::always_inline]] void look_up_runs(const std::uint8_t* indices, std::ptrdiff_t index_stride,
                                           int rows, std::uint8_t* out,
                                           std::ptrdiff_t out_stride) const {
    if (out_stride == 3 * kRun) {
      // The last word's unused byte belongs to the next run.
      for (; rows > 1; --rows, indices += index_stride, out += out_stride) {
        for (int x = 0; x < kRun; ++x) std::memcpy(out + 3 * x, &words_[indices[x]], 4);
      }
    }
    for (; rows > 0; --rows, indices += index_stride, out += out_stride) {
      look_up(indices, kRun, out);
    }
  }

 private:
  std::array<std::uint32_t, 256> words_{};
};

/// One channel.
class GreyTable {
 public:
  void set(std::size_t entry, std::uint8_t grey) { greys_[entry] = grey; }

  [[gnu::always_inline]] void look_up(const std::uint8_t* indices, int columns,
                                      std::uint8_t* out) const {
    for (int x = 0; x < columns; ++x) out[x] = greys_[indices[x]];
  }
  [[gnu::always_inline]] void look_up_runs(const std::uint8_t* indices, std::ptrdiff_t index_stride,
                                           int rows, std::uint8_t* out,
                                           std::ptrdiff_t out_stride) const {
    for (; rows > 0; --rows, indices += index_stride, out += out_stride) {
      look_up(indices, kRun, out);
    }
  }

 private:
  std::array<std::uint8_t, 256> greys_{};
};

}  // namespace orbwatch::remap
