#pragma once

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap {

/// One channel: 256 bytes, which fill half of the registers that there are while runs are looked
/// up.
class GreyTable {
 public:
  void set(std::size_t entry, std::uint8_t grey) { greys_[entry] = grey; }

  /// Writes 1 to kRun pixels, `step` apart.
  [[gnu::always_inline]] void look_up(const std::uint8_t* indices, int columns, std::uint8_t* out,
                                      int step = 1) const {
    for (int x = 0; x < columns; ++x) out[x * step] = greys_[indices[x]];
  }

  /// Writes `rows` whole runs, `index_stride` and `out_stride` apart.
  [[gnu::always_inline]] void look_up_runs(const std::uint8_t* indices, std::ptrdiff_t index_stride,
                                           int rows, std::uint8_t* out,
                                           std::ptrdiff_t out_stride) const {
    const uint8x16x4_t first = vld1q_u8_x4(&greys_[0]), second = vld1q_u8_x4(&greys_[64]),
                       third = vld1q_u8_x4(&greys_[128]), fourth = vld1q_u8_x4(&greys_[192]);
#pragma GCC unroll 4
    for (; rows > 0; --rows, indices += index_stride, out += out_stride) {
      const uint8x16_t index = vld1q_u8(indices);
      // An index beyond its part of the table leaves what was found.
      uint8x16_t found = vqtbl4q_u8(first, index);
      found = vqtbx4q_u8(found, second, vsubq_u8(index, vdupq_n_u8(64)));
      found = vqtbx4q_u8(found, third, vsubq_u8(index, vdupq_n_u8(128)));
      found = vqtbx4q_u8(found, fourth, vsubq_u8(index, vdupq_n_u8(192)));
      vst1q_u8(out, found);
    }
  }

 private:
  alignas(64) std::array<std::uint8_t, 256> greys_{};
};

/// Three channels, looked up one after the other: the registers do not hold the tables of all.
class ColourTable {
 public:
  void set(std::size_t entry, const std::array<std::uint8_t, 3>& colour) {
    for (std::size_t k = 0; k < kChannels; ++k) channels_[k].set(entry, colour[k]);
  }

  [[gnu::always_inline]] void look_up(const std::uint8_t* indices, int columns,
                                      std::uint8_t* out) const {
    for (std::size_t k = 0; k < kChannels; ++k) {
      channels_[k].look_up(indices, columns, out + k, kChannels);
    }
  }

  /// At most kTile rows.
  [[gnu::always_inline]] void look_up_runs(const std::uint8_t* indices, std::ptrdiff_t index_stride,
                                           int rows, std::uint8_t* out,
                                           std::ptrdiff_t out_stride) const {
    alignas(kRun) std::uint8_t found[kChannels][kTile * kRun];
    for (std::size_t k = 0; k < kChannels; ++k) {
      channels_[k].look_up_runs(indices, index_stride, rows, found[k], kRun);
    }
#pragma GCC unroll 4
    for (int at = 0; at < rows * kRun; at += kRun, out += out_stride) {
      vst3q_u8(out, {vld1q_u8(found[0] + at), vld1q_u8(found[1] + at), vld1q_u8(found[2] + at)});
    }
  }

 private:
  static constexpr int kChannels = 3;
  std::array<GreyTable, kChannels> channels_;
};

}  // namespace orbwatch::remap
