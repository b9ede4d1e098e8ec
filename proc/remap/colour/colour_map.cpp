#include "proc/remap/colour/colour_map.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "proc/remap/colour/luma.h"
#include "proc/remap/colour/run_vector.h"

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

using Colours = std::array<std::uint32_t, 256>;
using Greys = std::array<std::uint8_t, 256>;

/// Writes whole words, each over the unused byte of the one before; the last one by bytes.
[[gnu::always_inline]] inline void write_entries(const Colours& colours,
                                                 const std::uint8_t* indices, int columns,
                                                 std::uint8_t* out) {
  for (int x = 0; x < columns - 1; ++x) std::memcpy(out + 3 * x, &colours[indices[x]], 4);
  std::memcpy(out + 3 * (columns - 1), &colours[indices[columns - 1]], 3);
}

[[gnu::always_inline]] inline void write_entries(const Greys& greys, const std::uint8_t* indices,
                                                 int columns, std::uint8_t* out) {
  for (int x = 0; x < columns; ++x) out[x] = greys[indices[x]];
}

/// A run before others that follow without a gap: the last word's unused byte is theirs.
[[gnu::always_inline]] inline void write_run_before(const Colours& colours,
                                                    const std::uint8_t* indices,
                                                    std::uint8_t* out) {
  for (int x = 0; x < kRun; ++x) std::memcpy(out + 3 * x, &colours[indices[x]], 4);
}
[[gnu::always_inline]] inline void write_run_before(const Greys& greys, const std::uint8_t* indices,
                                                    std::uint8_t* out) {
  write_entries(greys, indices, kRun, out);
}

/// Rows of whole runs, `index_stride` and `out_stride` apart.
template <class Table>
[[gnu::always_inline]] inline void write_runs(const Table& table, const std::uint8_t* indices,
                                              std::ptrdiff_t index_stride, int rows,
                                              std::uint8_t* out, std::ptrdiff_t out_stride) {
  if (out_stride == 3 * kRun) {
    for (; rows > 1; --rows, indices += index_stride, out += out_stride) {
      write_run_before(table, indices, out);
    }
  }
  for (; rows > 0; --rows, indices += index_stride, out += out_stride) {
    write_entries(table, indices, kRun, out);
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

std::uint32_t word_of(std::uint8_t first, std::uint8_t second, std::uint8_t third) {
  return std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{first, second, third, 0});
}

}  // namespace

ColourMap::ColourMap(const Table& table, double low, double high)
    : low_(static_cast<std::int32_t>(std::lround(low))),
      high_(std::max(low_ + 1, static_cast<std::int32_t>(std::lround(high)))),
      scale_((std::int64_t{255} << 32) / (high_ - low_)) {
  assert(low < high);
  const auto set = [&table](Entries& entries, std::size_t i, std::size_t entry) {
    const auto& [red, green, blue] = table[entry];
    entries.rgb[i] = word_of(red, green, blue);
    entries.bgr[i] = word_of(blue, green, red);
    entries.grey[i] = luma(table[entry].data());
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    set(entries_, i, i);
    set(of_bytes_, i, entry_of(static_cast<std::int32_t>(i)));
  }
}

std::size_t ColourMap::entry_of(std::int32_t value) const {
  const std::int64_t above = std::clamp(value, low_, high_) - low_;
  return static_cast<std::size_t>((above * scale_ + (std::int64_t{1} << 31)) >> 32);
}

void ColourMap::apply(const ImageView<const std::uint8_t>& values,
                      const ImageView<std::uint8_t>& out, TileRows rows, PixelFormat order) const {
  with_table(of_bytes_, out, order, [&](const auto& table) {
    for_each_block(out, rows, [&](int x, int y, int columns, int height) {
      if (columns == kRun) {
        return write_runs(table, values.at(x, y), values.stride, height, out.at(x, y), out.stride);
      }
      for (int row = y; row < y + height; ++row) {
        write_entries(table, values.at(x, row), columns, out.at(x, row));
      }
    });
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
                      const ImageView<std::uint8_t>& out, TileRows rows, PixelFormat order) const {
  const bool is_simple = scale_ <= UINT32_MAX && low_ >= 0 && low_ < UINT16_MAX;
  const auto low = static_cast<std::uint16_t>(low_);
  const auto high = static_cast<std::uint16_t>(std::min<std::int32_t>(high_, UINT16_MAX));
  const auto scale = static_cast<std::uint32_t>(scale_);
  with_table(entries_, out, order, [&](const auto& table) {
    for_each_block(out, rows, [&](int x, int y, int columns, int height) {
      alignas(kRun) std::array<std::uint8_t, kRun * kTile> entries;
      if (columns == kRun && is_simple) {
        for (int row = 0; row < height; ++row) {
          const auto run = load<Words>(values.at(x, y + row));
          store(entries_of(run, low, high, scale), &entries[kRun * row]);
        }
        return write_runs(table, entries.data(), kRun, height, out.at(x, y), out.stride);
      }
      for (int row = y; row < y + height; ++row) {
        const std::uint16_t* const from = values.at(x, row);
        for (int i = 0; i < columns; ++i) entries[i] = static_cast<std::uint8_t>(entry_of(from[i]));
        write_entries(table, entries.data(), columns, out.at(x, row));
      }
    });
  });
}

}  // namespace orbwatch::remap
