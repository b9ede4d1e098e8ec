// The specification of the kernels: one pixel at a time, no assumption about the machine.

#include "proc/remap/remap_scalar.h"

#include <algorithm>
#include <cstddef>

#include "proc/remap/block_walk.h"
#include "proc/remap/interpolation.h"

namespace orbwatch::remap {
namespace {

constexpr int kRowShift = kFractionBits - kRowFractionBits;

struct Scalar {
  /// See LaneShape.
  class Shape {
   public:
    explicit Shape(const BlockMap& map) : shape_(map.lanes) {}
    void next_block() { ++x_; }
    void next_row() {
      x_ = 0;
      ++y_;
    }

    /// Of pixel (i, j), Q13, from its window on.
    Coordinate at(std::uint16_t place_u, std::uint16_t place_v, int i, int j) const {
      const Lane u = lane<&AxisPair<std::int16_t>::u>(shape_.offset.u, i, j);
      const Lane v = lane<&AxisPair<std::int16_t>::v>(shape_.offset.v, i, j);
      const auto lane_u =
          static_cast<std::uint16_t>(place_u + u.start + x_ * u.along_x + y_ * u.along_y);
      const auto lane_v = static_cast<std::uint16_t>(
          place_v + in_rows(v.start) + x_ * in_rows(v.along_x) + y_ * in_rows(v.along_y));
      return {lane_u, (lane_v - kRowCentre) << kRowShift};
    }

   private:
    struct Lane {
      std::int32_t along_x, along_y, start;
    };
    template <std::int16_t AxisPair<std::int16_t>::*axis>
    Lane lane(int offset, int i, int j) const {
      const int xy = shape_.xy.*axis;
      const int along_x = (i * shape_.twice_xx.*axis + j * xy + 4) >> 3;
      const int along_y = (i * xy + j * shape_.twice_yy.*axis + 4) >> 3;
      const int slopes = i * shape_.slope_x.*axis + j * shape_.slope_y.*axis;
      return {along_x, along_y, slopes + ((i * along_x + j * along_y + 4) >> 3) + offset};
    }
    static std::int32_t in_rows(std::int32_t value) {
      return (value + (1 << (kRowShift - 1))) >> kRowShift;
    }

    const LaneShape& shape_;
    int x_ = 0;
    int y_ = 0;
  };

  template <Layout layout>
  static void sample(const Shape& shape, std::uint16_t place_u, std::uint16_t place_v,
                     const std::uint8_t* window, std::ptrdiff_t stride, std::uint8_t* out,
                     std::ptrdiff_t out_stride) {
    constexpr LayoutInfo kInfo = info(layout);
    for (int j = 0; j < kBlock; ++j) {
      for (int i = 0; i < kBlock; ++i) {
        const Coordinate c = shape.at(place_u, place_v, i, j);
        const std::uint8_t* pixel =
            window + (c.v >> kFractionBits) * stride + (c.u >> kFractionBits) * kInfo.pixel_bytes;
        interpolate_pixel<layout>(
            {pixel, pixel + kInfo.pixel_bytes, pixel + stride, pixel + stride + kInfo.pixel_bytes},
            c, out + j * out_stride + i * kInfo.out_bytes());
      }
    }
  }
};

std::int32_t place(const PointAxis& axis, std::uint32_t i, std::uint32_t j) {
  const std::uint32_t offset =
      axis.start + i * axis.x + j * axis.y + i * j * axis.xy + i * i * axis.xx + j * j * axis.yy;
  return axis.base + (static_cast<std::int32_t>(offset) >> PointAxis::kExtraBits);
}

void locate(const PointMap& map, int columns, int rows, Places& places) {
  // A whole run, if there are fewer pixels.
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

constexpr Kernel kScalarKernel{
    "scalar",
    kBlockWalks<Scalar>,
    locate,
    {sample_points<Layout::One8>, sample_points<Layout::Two8>, sample_points<Layout::Three8>,
     sample_points<Layout::Four8>, sample_points<Layout::FirstOfTwo8>,
     sample_points<Layout::OddOfFour8>, sample_points<Layout::One16>,
     sample_points<Layout::Three16>}};

}  // namespace orbwatch::remap
