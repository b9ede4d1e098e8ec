// SPDX-License-Identifier: Apache-2.0
// The specification of the kernels: one pixel at a time, no assumption about the machine.

#include <algorithm>
#include <cstddef>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/look_up.h"
#include "proc/remap/kernel/tile_mix.h"
#include "proc/remap/kernel/yuv420_mix.h"

namespace orbwatch::remap::scalar {
namespace {

constexpr int kRowShift = kFractionBits - kRowFractionBits;

/// One axis of the windows of a row of blocks, by differences from block to block.
class AxisWalk {
 public:
  /// Axis 0 or 1, u or v.
  AxisWalk(const WindowWalk& walk, int axis, int row)
      : value_(walk.value[axis] + row * walk.step_y[axis] + row * (row - 1) / 2 * walk.yy[axis]),
        step_(walk.step_x[axis] + row * walk.xy[axis]),
        growth_(walk.xx[axis]) {}

  /// Start of the current block's window, source pixels.
  std::ptrdiff_t window() const { return value_ >> 32; }
  /// The block's place in its window, with `bits` bits.
  template <int bits>
  std::uint16_t place() const {
    return static_cast<std::uint16_t>(static_cast<std::uint32_t>(value_) >> (32 - bits));
  }
  void next() {
    value_ += step_;
    step_ += growth_;
  }

 private:
  std::int64_t value_;
  std::int64_t step_;
  std::int64_t growth_;
};

/// One axis of the pixels of a block, see LaneShape.
struct Lane {
  std::int32_t along_x, along_y, start;

  template <std::int16_t AxisPair<std::int16_t>::*axis>
  static Lane of(const LaneShape& shape, int offset, int i, int j) {
    const int xy = shape.xy.*axis;
    const int along_x = (i * shape.twice_xx.*axis + j * xy + 4) >> 3;
    const int along_y = (i * xy + j * shape.twice_yy.*axis + 4) >> 3;
    const int slopes = i * shape.slope_x.*axis + j * shape.slope_y.*axis;
    return {along_x, along_y, slopes + ((i * along_x + j * along_y + 4) >> 3) + offset};
  }
};

/// The block (x, y) of a tile and its place in its window.
struct Block {
  const LaneShape& shape;
  int x, y;
  std::uint16_t place_u, place_v;

  /// Coordinate of pixel (i, j), Q13, relative to its window.
  Coordinate at(int i, int j) const {
    const Lane u = Lane::of<&AxisPair<std::int16_t>::u>(shape, shape.offset.u, i, j);
    const Lane v = Lane::of<&AxisPair<std::int16_t>::v>(shape, shape.offset.v, i, j);
    const auto lane_u =
        static_cast<std::uint16_t>(place_u + u.start + x * u.along_x + y * u.along_y);
    const auto lane_v = static_cast<std::uint16_t>(place_v + in_rows(v.start) +
                                                   x * in_rows(v.along_x) + y * in_rows(v.along_y));
    return {lane_u, (lane_v - kRowCentre) << kRowShift};
  }

 private:
  static std::int32_t in_rows(std::int32_t value) {
    return (value + (1 << (kRowShift - 1))) >> kRowShift;
  }
};

/// Samples one block from its window into `out`.
template <Layout layout>
void sample_block(const Block& block, const std::uint8_t* window, std::ptrdiff_t stride,
                  std::uint8_t* out, std::ptrdiff_t out_stride) {
  constexpr LayoutInfo kInfo = info(layout);
  for (int j = 0; j < kBlock; ++j) {
    for (int i = 0; i < kBlock; ++i) {
      const Coordinate c = block.at(i, j);
      const std::uint8_t* pixel =
          window + (c.v >> kFractionBits) * stride + (c.u >> kFractionBits) * kInfo.pixel_bytes;
      interpolate_pixel<layout>(
          {pixel, pixel + kInfo.pixel_bytes, pixel + stride, pixel + stride + kInfo.pixel_bytes}, c,
          out + j * out_stride + i * kInfo.out_bytes());
    }
  }
}

template <Layout layout>
void sample_tile(const TileJob& job) {
  const auto& [map, source, target] = job;
  for (int y = 0; y < map.blocks_y; ++y) {
    AxisWalk u(map.windows, 0, y), v(map.windows, 1, y);
    std::uint8_t* out = target.data + y * kBlock * target.stride;
    for (int x = 0; x < map.blocks_x; ++x) {
      const std::uint8_t* window =
          source.data + v.window() * source.stride + u.window() * info(layout).pixel_bytes;
      const Block block{map.lanes, x, y, u.place<kFractionBits>(), v.place<kRowFractionBits>()};
      sample_block<layout>(block, window, source.stride, out, target.stride);
      u.next();
      v.next();
      out += kBlock * info(layout).out_bytes();
    }
  }
}

std::int32_t place(const PointAxis& axis, std::uint32_t i, std::uint32_t j) {
  const std::uint32_t offset =
      axis.start + i * axis.x + j * axis.y + i * j * axis.xy + i * i * axis.xx + j * j * axis.yy;
  return axis.base + (static_cast<std::int32_t>(offset) >> PointAxis::kExtraBits);
}

void locate(const PointMap& map, int columns, int rows, Places& places) {
  // Covers at least a whole run, even if there are fewer pixels.
  const int count = std::max(columns * rows, kPointRun);
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::uint32_t>(k % columns),
               j = static_cast<std::uint32_t>(k / columns);
    places.u[static_cast<std::size_t>(k)] = place(map.u, i, j);
    places.v[static_cast<std::size_t>(k)] = place(map.v, i, j);
  }
}

template <Layout layout>
void sample_points(const PointJob& job) {
  const auto& [places, source, target] = job;
  constexpr LayoutInfo kInfo = info(layout);
  const std::int32_t last_u = (source.width - 1) << kFractionBits;
  const std::int32_t last_v =
      std::max(((source.height - 1) << kFractionBits) - kShortOfLastRow<layout>, 0);
  const auto pixel = [&source = source](int u, int v) {
    return source.data + std::min(v, source.height - 1) * source.stride +
           std::ptrdiff_t{std::min(u, source.width - 1)} * kInfo.pixel_bytes;
  };
  for (int y = 0; y < target.rows; ++y) {
    for (int x = 0; x < target.columns; ++x) {
      const auto at = static_cast<std::size_t>(y * target.columns + x);
      const Coordinate c{std::clamp(places.u[at] + added_u(layout), 0, last_u),
                         std::clamp(places.v[at] + added_v(layout), 0, last_v)};
      const int u = c.u >> kFractionBits, v = c.v >> kFractionBits;
      interpolate_pixel<layout>(
          {pixel(u, v), pixel(u + 1, v), pixel(u, v + 1), pixel(u + 1, v + 1)}, c,
          target.data + y * target.stride + x * kInfo.out_bytes());
    }
  }
}

}  // namespace

extern const Kernel kKernel;
constexpr Kernel kKernel{
    .name = "scalar",
    .tiles = by_layout<kKernelLayouts>(
        []<Layout layout>() -> Kernel::Tile { return sample_tile<layout>; }),
    .locate = locate,
    .points = by_layout<kLayouts>(
        []<Layout layout>() -> Kernel::Points { return sample_points<layout>; }),
    .mix = mix_tiles,
    .mix_yuv420 = mix_yuv420_tiles,
    .look_up = look_up_words,
    .look_up_yuv420 = look_up_yuv420_planes,
};

}  // namespace orbwatch::remap::scalar
