#include "proc/remap/colour/colour_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "proc/remap/colour/run_vector.h"

namespace orbwatch::remap {
namespace {

constexpr int kRun = kRunPixels;

/// Calls `block(x, y, columns, rows)` for each block of up to a tile's size in the tile rows
/// `rows`.
template <class Block>
void for_each_block(const ImageView<std::uint8_t>& rgb, TileRows rows, const Block& block) {
  const int last = std::min(rows.last * kTile, rgb.height);
  for (int y = rows.first * kTile; y < last; y += kTile) {
    for (int x = 0; x < rgb.width; x += kRun) {
      block(x, y, std::min(kRun, rgb.width - x), std::min(kTile, last - y));
    }
  }
}

/// Writes whole words, each over the unused byte of the one before; the last one by bytes.
template <class Table, class Index>
[[gnu::always_inline]] inline void write_colours(const Table& table, const Index* indices,
                                                 int columns, std::uint8_t* out) {
  for (int x = 0; x < columns - 1; ++x) std::memcpy(out + 3 * x, &table[indices[x]], 4);
  std::memcpy(out + 3 * (columns - 1), &table[indices[columns - 1]], 3);
}

}  // namespace

ColourMap::ColourMap(const Table& table, double low, double high)
    : low_(static_cast<std::int32_t>(std::lround(low))),
      high_(std::max(low_ + 1, static_cast<std::int32_t>(std::lround(high)))),
      scale_((std::int64_t{255} << 32) / (high_ - low_)) {
  assert(low < high);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const std::array<std::uint8_t, 4> bytes{table[i][0], table[i][1], table[i][2], 0};
    std::memcpy(&entries_[i], bytes.data(), sizeof(Entry));
  }
  for (std::size_t i = 0; i < of_bytes_.size(); ++i) {
    of_bytes_[i] = entries_[entry_of(static_cast<std::int32_t>(i))];
  }
}

std::size_t ColourMap::entry_of(std::int32_t value) const {
  const std::int64_t above = std::clamp(value, low_, high_) - low_;
  return static_cast<std::size_t>((above * scale_ + (std::int64_t{1} << 31)) >> 32);
}

void ColourMap::apply(const ImageView<const std::uint8_t>& values,
                      const ImageView<std::uint8_t>& rgb, TileRows rows) const {
  for_each_block(rgb, rows, [&](int x, int y, int columns, int height) {
    for (int row = y; row < y + height; ++row) {
      const std::uint8_t* const from = values.row(row) + x;
      std::uint8_t* const to = rgb.row(row) + 3 * x;
      columns == kRun ? write_colours(of_bytes_, from, kRun, to)
                      : write_colours(of_bytes_, from, columns, to);
    }
  });
}

/// The entries of a run of 16 bit values, as entry_of(): `scale` has 32 bits, [low, high] 16. The
/// product is made of halves: nothing is lost by cutting the lower one.
[[gnu::always_inline]] inline Bytes entries_of(const Words& values, std::uint16_t low,
                                               std::uint16_t high, std::uint32_t scale) {
  const Longs above = widened(clamped(values, low, high) - low);
  const Longs upper = above * widened(Words{} + static_cast<std::uint16_t>(scale >> 16));
  const Longs lower = above * widened(Words{} + static_cast<std::uint16_t>(scale & 0xffff));
  return narrowed(narrowed((upper + (lower >> 16) + (1U << 15)) >> 16));
}

void ColourMap::apply(const ImageView<const std::uint16_t>& values,
                      const ImageView<std::uint8_t>& rgb, TileRows rows) const {
  const bool is_simple = scale_ <= UINT32_MAX && low_ >= 0 && low_ < UINT16_MAX;
  const auto low = static_cast<std::uint16_t>(low_);
  const auto high = static_cast<std::uint16_t>(std::min<std::int32_t>(high_, UINT16_MAX));
  const auto scale = static_cast<std::uint32_t>(scale_);
  for_each_block(rgb, rows, [&](int x, int y, int columns, int height) {
    alignas(kRun) std::array<std::uint8_t, kRun * kTile> entries;
    if (columns == kRun && is_simple) {
      for (int row = 0; row < height; ++row) {
        const auto run = load<Words>(values.row(y + row) + x);
        store(entries_of(run, low, high, scale), &entries[kRun * row]);
      }
      for (int row = 0; row < height; ++row) {
        write_colours(entries_, &entries[kRun * row], kRun, rgb.row(y + row) + 3 * x);
      }
      return;
    }
    for (int row = y; row < y + height; ++row) {
      const std::uint16_t* const from = values.row(row) + x;
      for (int i = 0; i < columns; ++i) entries[i] = static_cast<std::uint8_t>(entry_of(from[i]));
      write_colours(entries_, entries.data(), columns, rgb.row(row) + 3 * x);
    }
  });
}

}  // namespace orbwatch::remap
