// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/colour_map.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "proc/remap/colour/luma.h"
#include "proc/remap/colour/run.h"

namespace orbwatch::remap {
namespace {

/// ColourMap::entry_of() for a run.
[[gnu::always_inline]] inline void find_entries(const ValueScale& scale,
                                                const std::uint16_t* values,
                                                std::uint8_t* entries) {
  const ValueScale s = scale;
  SampleRun run;
  for (std::size_t x = 0; x < kRun; ++x) {
    const auto above = static_cast<std::uint16_t>(std::clamp(values[x], s.low, s.high) - s.low);
    const auto upper = static_cast<std::uint16_t>(above * s.unit);
    const auto entry = static_cast<std::uint16_t>(std::uint32_t{upper} * s.scale >> 16);
    run[x] = static_cast<std::uint8_t>((entry + kHalfEntry) >> kEntryBits);
  }
  std::memcpy(entries, run.data(), kRun);
}

}  // namespace

ColourMap::ColourMap(const Table& table, double low, double high)
    : low_(static_cast<std::int32_t>(std::lround(low))),
      high_(std::max(low_ + 1, static_cast<std::int32_t>(std::lround(high)))),
      shift_(16 - std::bit_width(static_cast<std::uint32_t>(high_ - low_))),
      scale_(static_cast<std::uint16_t>(
          std::lround(255 * std::ldexp(1, 16 + kEntryBits - shift_) / (high_ - low_)))) {
  assert(low < high);
  const auto set = [&table](Entries& entries, std::size_t i, std::size_t entry) {
    const auto& [red, green, blue] = table[entry];
    entries.rgb.set(i, {red, green, blue});
    entries.bgr.set(i, {blue, green, red});
    const std::uint8_t grey = luma(table[entry].data());
    entries.grey.set(i, {grey, grey, grey});
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    set(entries_, i, i);
    set(of_bytes_, i, entry_of(static_cast<std::int32_t>(i)));
  }
}

std::size_t ColourMap::entry_of(std::int32_t value) const {
  const auto above = static_cast<std::uint32_t>(std::clamp(value, low_, high_) - low_);
  const std::uint32_t upper = shift_ < 0 ? above >> -shift_ : above << shift_;
  return ((upper * scale_ >> 16) + kHalfEntry) >> kEntryBits;
}

const ColourTable& ColourMap::table(const Entries& entries, int channels, PixelFormat order) {
  assert(channels == 1 || order == PixelFormat::Rgb || order == PixelFormat::Bgr);
  if (channels == 1) return entries.grey;
  return order == PixelFormat::Bgr ? entries.bgr : entries.rgb;
}

void ColourMap::apply(const ImageView<const std::uint8_t>& values,
                      const ImageView<std::uint8_t>& out, const Kernel& kernel,
                      PixelFormat order) const {
  const ColourTable& table = ColourMap::table(of_bytes_, out.channels, order);
  if (values.width == kRun) {
    return kernel.look_up(table, {values.data, values.stride, values.height}, out);
  }
  for (int y = 0; y < values.height; ++y) table.look_up(values.row(y), values.width, out.row(y));
}

void ColourMap::apply(const ImageView<const std::uint16_t>& values,
                      const ImageView<std::uint8_t>& out, const Kernel& kernel,
                      PixelFormat order) const {
  const bool is_within = low_ >= 0 && high_ <= UINT16_MAX;
  const ColourTable& table = ColourMap::table(entries_, out.channels, order);
  alignas(64) std::array<std::uint8_t, kRun * kTile> entries;
  if (values.width == kRun && is_within) {
    const ValueScale scale{static_cast<std::uint16_t>(low_), static_cast<std::uint16_t>(high_),
                           static_cast<std::uint16_t>(1U << shift_), scale_};
    if (kKernelsConvert && kernel.find_entries) {
      kernel.find_entries(scale, values, entries.data());
    } else {
      for (int y = 0; y < values.height; ++y) {
        find_entries(scale, values.row(y), &entries[kRun * y]);
      }
    }
    return kernel.look_up(table, {entries.data(), kRun, values.height}, out);
  }
  for (int y = 0; y < values.height; ++y) {
    const std::uint16_t* const row = values.row(y);
    for (int x = 0; x < values.width; ++x) entries[x] = static_cast<std::uint8_t>(entry_of(row[x]));
    table.look_up(entries.data(), values.width, out.row(y));
  }
}

}  // namespace orbwatch::remap
