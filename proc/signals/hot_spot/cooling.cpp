// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/cooling.h"

#include <algorithm>

#include "proc/signals/signals.h"

namespace orbwatch::signals {

CoolingMeter::CoolingMeter(const RegionMask& mask, double threshold)
    : threshold_(threshold),
      before_(mask),
      stride_(mask.right()),
      height_(mask.bottom()),
      values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_)),
      validity_(values_.size()) {}

template <class T>
double CoolingMeter::update(double now, const ImageView<const T>& values,
                            const ImageView<const std::uint8_t>& validity, const BlobPixels& pixels,
                            const RegionGeometry& geometry, const Radiometry& radiometry) {
  constexpr double kLongest = 0.25;  // s; the rate over a longer gap is not the present one
  const double passed = now - time_;
  const double rate = passed > 0 && passed <= kLongest
                          ? fall(values, validity, geometry, radiometry) / passed
                          : kNotValid;
  time_ = now;
  remember(values, validity, pixels);
  return rate;
}

/// Fall of temperature, K; NaN when no pixel has left.
template <class T>
double CoolingMeter::fall(const ImageView<const T>& values,
                          const ImageView<const std::uint8_t>& validity,
                          const RegionGeometry& geometry, const Radiometry& radiometry) const {
  double sum = 0, weight = 0;
  const auto visit = [&](const Piece& was, const Corners& corners) {
    if (!corners.square) return;
    std::array<double, 4> now{}, stayed{};
    for (std::size_t i = 0; i < 4; ++i) {
      const int u = corners.x + kCornerOffsets[i][0], v = corners.y + kCornerOffsets[i][1];
      if (!is_seen(validity, u, v)) return;
      now[i] = *values.at(u, v);
      stayed[i] = std::min(corners.counts[i], now[i]) - threshold_;
    }
    if (std::ranges::min(now) >= threshold_) return;
    const bool some_stayed = std::ranges::max(stayed) >= 0;
    const Piece still = some_stayed ? piece_above(stayed) : Piece{.area = 0};
    const double left = was.area - still.area;
    constexpr double kNothing = 1e-9;
    if (!(left > kNothing)) return;
    const auto weights = corner_weights((was.area * was.u - still.area * still.u) / left,
                                        (was.area * was.v - still.area * still.v) / left);
    const double omega = left * corners.geometry[0]->solid_angle;
    sum += omega * (radiometry.celsius(mean_of(weights, corners.counts)) -
                    radiometry.celsius(mean_of(weights, now)));
    weight += omega;
  };
  const ImageView<const std::uint16_t> was_values{values_.data(), stride_, height_, 1, stride_};
  const ImageView<const std::uint8_t> was_seen{validity_.data(), stride_, height_, 1, stride_};
  before_.for_each_piece(was_values, was_seen, threshold_, geometry, visit);
  return weight > 0 ? sum / weight : kNotValid;
}

template <class T>
void CoolingMeter::remember(const ImageView<const T>& values,
                            const ImageView<const std::uint8_t>& validity,
                            const BlobPixels& pixels) {
  before_.assign(pixels);
  if (pixels.empty()) return;
  for (int y = pixels.top(); y < pixels.bottom(); ++y) {
    const std::ptrdiff_t place = std::ptrdiff_t{stride_} * y + pixels.left();
    const int count = pixels.right() - pixels.left();
    std::copy_n(values.at(pixels.left(), y), count, values_.begin() + place);
    std::copy_n(validity.at(pixels.left(), y), count, validity_.begin() + place);
  }
}

template double CoolingMeter::update(double, const ImageView<const std::uint8_t>&,
                                     const ImageView<const std::uint8_t>&, const BlobPixels&,
                                     const RegionGeometry&, const Radiometry&);
template double CoolingMeter::update(double, const ImageView<const std::uint16_t>&,
                                     const ImageView<const std::uint8_t>&, const BlobPixels&,
                                     const RegionGeometry&, const Radiometry&);

}  // namespace orbwatch::signals
