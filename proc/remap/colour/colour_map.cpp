// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/colour_map.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "proc/remap/colour/chroma.h"
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
    entries.yuv.set(
        i, {luma(table[entry].data()), chroma_of(kWeightsOfU, 4 * red, 4 * green, 4 * blue),
            chroma_of(kWeightsOfV, 4 * red, 4 * green, 4 * blue)});
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
  if (channels == 1) return entries.yuv;
  return order == PixelFormat::Bgr ? entries.bgr : entries.rgb;
}

/// Finds the indices of a tile's values.
[[gnu::always_inline]] inline void ColourMap::find(const ImageView<const std::uint16_t>& values,
                                                   Indices& indices, const Kernel& kernel) const {
  std::uint8_t* entries = indices.entries.data();
  const bool is_within = low_ >= 0 && high_ <= UINT16_MAX;
  if (values.width < kRun || !is_within) {
    for (int y = 0; y < values.height; ++y, entries += kRun) {
      const std::uint16_t* const row = values.row(y);
      for (int x = 0; x < values.width; ++x) {
        entries[x] = static_cast<std::uint8_t>(entry_of(row[x]));
      }
    }
    return;
  }
  const ValueScale scale{static_cast<std::uint16_t>(low_), static_cast<std::uint16_t>(high_),
                         static_cast<std::uint16_t>(1U << shift_), scale_};
  if (kKernelsConvert && kernel.find_entries) return kernel.find_entries(scale, values, entries);
  const ImageView<const std::uint16_t> from = values;  // which `entries` cannot overlap
  for (int y = 0; y < from.height; ++y) find_entries(scale, from.row(y), entries + kRun * y);
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
  const ColourTable& table = ColourMap::table(entries_, out.channels, order);
  Indices indices;
  find(values, indices, kernel);
  const std::uint8_t* const first = indices.entries.data();
  if (values.width == kRun) return kernel.look_up(table, {first, kRun, values.height}, out);
  for (int y = 0; y < values.height; ++y) {
    table.look_up(first + kRun * y, values.width, out.row(y));
  }
}

void ColourMap::apply(const ImageView<const std::uint8_t>& values, PlanarTile& out,
                      const Kernel& kernel, PixelFormat order) const {
  assert(values.width == kRun && values.height == kTile);
  const ColourTable& table = ColourMap::table(of_bytes_, 3, order);
  if (values.stride == kRun) return kernel.look_up_planes(table, values.data, out);
  Indices indices;
  for (int y = 0; y < kTile; ++y) std::copy_n(values.row(y), kRun, &indices.entries[kRun * y]);
  kernel.look_up_planes(table, indices.entries.data(), out);
}

void ColourMap::apply(const ImageView<const std::uint16_t>& values, PlanarTile& out,
                      const Kernel& kernel, PixelFormat order) const {
  assert(values.width == kRun && values.height == kTile);
  Indices indices;
  find(values, indices, kernel);
  kernel.look_up_planes(ColourMap::table(entries_, 3, order), indices.entries.data(), out);
}

void ColourMap::apply(const ImageView<const std::uint8_t>& values, const Yuv420Planes& out,
                      const Kernel& kernel) const {
  if (values.width == kRun && values.height == kTile) {
    return kernel.look_up_yuv420(of_bytes_.yuv, {values.data, values.stride, kTile}, out);
  }
  Indices indices{};
  for (int y = 0; y < values.height; ++y) {
    std::copy_n(values.row(y), values.width, &indices.entries[kRun * y]);
  }
  kernel.look_up_yuv420(of_bytes_.yuv, indices.runs(), out);
}

void ColourMap::apply(const ImageView<const std::uint16_t>& values, const Yuv420Planes& out,
                      const Kernel& kernel) const {
  Indices indices;
  if (values.width < kRun || values.height < kTile) indices = {};
  find(values, indices, kernel);
  kernel.look_up_yuv420(entries_.yuv, indices.runs(), out);
}

}  // namespace orbwatch::remap
