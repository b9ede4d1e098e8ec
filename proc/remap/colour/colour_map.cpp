#include "proc/remap/colour/colour_map.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "proc/remap/colour/luma.h"

namespace orbwatch::remap {
namespace {

/// Calls `block(x, y, columns, rows)` for each block of up to a tile's size in the tile rows
/// `rows`.
template <class Block>
[[gnu::always_inline]] inline void for_each_block(const ImageView<std::uint8_t>& out, TileRows rows,
                                                  const Block& block) {
  const int last = std::min(rows.last * kTile, out.height);
  for (int y = rows.first * kTile; y < last; y += kTile) {
    for (int x = 0; x < out.width; x += kRun) {
      block(x, y, std::min(kRun, out.width - x), std::min(kTile, last - y));
    }
  }
}

/// Calls `write` with the table for the target.
template <class Entries, class Write>
void with_table(const Entries& entries, const ImageView<std::uint8_t>& out, PixelFormat order,
                const Write& write) {
  assert(out.channels == 1 || order == PixelFormat::Rgb || order == PixelFormat::Bgr);
  if (out.channels == 1) return write(entries.grey);
  order == PixelFormat::Bgr ? write(entries.bgr) : write(entries.rgb);
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
    entries.grey.set(i, luma(table[entry].data()));
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

void ColourMap::apply(const ImageView<const std::uint8_t>& values,
                      const ImageView<std::uint8_t>& out, TileRows rows, PixelFormat order) const {
  with_table(of_bytes_, out, order, [&](const auto& table) {
    for_each_block(out, rows, [&](int x, int y, int columns, int height) {
      if (columns == kRun) {
        return table.look_up_runs(values.at(x, y), values.stride, height, out.at(x, y), out.stride);
      }
      for (int row = y; row < y + height; ++row) {
        table.look_up(values.at(x, row), columns, out.at(x, row));
      }
    });
  });
}

/// entry_of() for a run, where the range lies within 16 bits.
[[gnu::always_inline]] inline void ColourMap::find_entries(const std::uint16_t* values,
                                                           std::uint8_t* entries) const {
  const auto low = static_cast<std::uint16_t>(low_), high = static_cast<std::uint16_t>(high_);
  const std::uint16_t scale = scale_;
  // Compilers find the narrow multiplication, but not the narrow shift.
  const auto unit = static_cast<std::uint16_t>(1U << shift_);
  SampleRun run;
  for (std::size_t x = 0; x < kRun; ++x) {
    const auto above = static_cast<std::uint16_t>(std::clamp(values[x], low, high) - low);
    const auto upper = static_cast<std::uint16_t>(above * unit);
    const auto entry = static_cast<std::uint16_t>(std::uint32_t{upper} * scale >> 16);
    run[x] = static_cast<std::uint8_t>((entry + kHalfEntry) >> kEntryBits);
  }
  std::memcpy(entries, run.data(), kRun);
}

void ColourMap::apply(const ImageView<const std::uint16_t>& values,
                      const ImageView<std::uint8_t>& out, TileRows rows, PixelFormat order) const {
  const bool is_within = low_ >= 0 && high_ <= UINT16_MAX;
  with_table(entries_, out, order, [&](const auto& table) {
    for_each_block(out, rows, [&](int x, int y, int columns, int height) {
      alignas(kRun) std::array<std::uint8_t, kRun * kTile> entries;
      if (columns == kRun && is_within) {
        for (int row = 0; row < height; ++row) {
          find_entries(values.at(x, y + row), &entries[kRun * row]);
        }
        return table.look_up_runs(entries.data(), kRun, height, out.at(x, y), out.stride);
      }
      for (int row = y; row < y + height; ++row) {
        const std::uint16_t* const from = values.at(x, row);
        for (int i = 0; i < columns; ++i) entries[i] = static_cast<std::uint8_t>(entry_of(from[i]));
        table.look_up(entries.data(), columns, out.at(x, row));
      }
    });
  });
}

}  // namespace orbwatch::remap
