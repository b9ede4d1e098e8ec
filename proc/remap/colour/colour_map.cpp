#include "proc/remap/colour/colour_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace orbwatch::remap {

ColourMap::ColourMap(const Table& table, double low, double high)
    : table_(table),
      low_(static_cast<std::int32_t>(std::lround(low))),
      high_(std::max(low_ + 1, static_cast<std::int32_t>(std::lround(high)))),
      scale_((std::int64_t{255} << 32) / (high_ - low_)) {
  assert(low < high);
}

template <class T>
void ColourMap::apply_rows(const ImageView<const T>& values, const ImageView<std::uint8_t>& rgb,
                           TileRows rows) const {
  const int last = std::min(rows.last * kTile, values.height);
  for (int y = rows.first * kTile; y < last; ++y) {
    const T* value = values.row(y);
    std::uint8_t* out = rgb.row(y);
    for (int x = 0; x < values.width; ++x, out += 3) {
      const std::int64_t above = std::clamp<std::int32_t>(value[x], low_, high_) - low_;
      const auto entry = static_cast<std::size_t>((above * scale_ + (std::int64_t{1} << 31)) >> 32);
      std::copy_n(table_[entry].begin(), 3, out);
    }
  }
}

void ColourMap::apply(const ImageView<const std::uint8_t>& values,
                      const ImageView<std::uint8_t>& rgb, TileRows rows) const {
  apply_rows(values, rgb, rows);
}

void ColourMap::apply(const ImageView<const std::uint16_t>& values,
                      const ImageView<std::uint8_t>& rgb, TileRows rows) const {
  apply_rows(values, rgb, rows);
}

}  // namespace orbwatch::remap
