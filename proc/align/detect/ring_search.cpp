#include "proc/align/detect/ring_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "proc/align/detect/limb_network.h"
#include "proc/align/detect/ring_strip.h"

namespace orbwatch::align {
namespace {

/// Of the centre from the place, shares of the radius; a limb that is off crosses columns by as
/// much as they have beside them.
constexpr double kFarthestOff = 0.25, kStep = 0.04;
static_assert(kFarthestOff < (RingStrip::kBeside + 0.5) * RingStrip::kGrowth);

/// What a strip says of circles, by column.
class Rings {
 public:
  explicit Rings(const RingStrip& strip) : limb_(limb_columns(strip)), nats_(limb_.above_random()) {
    for (int n = 0; n < limb_.parts; ++n) cosines_.push_back(std::cos(limb_.angle(n)));
    for (int n = 0; n < limb_.parts; ++n) sines_.push_back(std::sin(limb_.angle(n)));
    sums_.resize(static_cast<std::size_t>(limb_.columns));
  }

  struct Best {
    int column = 0;
    float likeness = 0;
  };
  /// With a centre off by (u, v) radii.
  Best best(double u, double v) {
    std::ranges::fill(sums_, 0.F);
    const int end = limb_.columns - RingStrip::kBeside;
    for (std::size_t n = 0; n < cosines_.size(); ++n) {
      const auto shift =
          static_cast<int>(std::lround((u * cosines_[n] + v * sines_[n]) / RingStrip::kGrowth));
      const float* row = &nats_[n * sums_.size()];
      for (int k = RingStrip::kBeside; k < end; ++k)
        sums_[static_cast<std::size_t>(k)] += row[k + shift];
    }
    const auto first = sums_.begin() + RingStrip::kBeside;
    const auto most = std::max_element(first, sums_.begin() + end);
    return {static_cast<int>(most - sums_.begin()), *most / static_cast<float>(limb_.parts)};
  }

 private:
  LimbColumns limb_;
  std::vector<float> nats_;
  std::vector<double> cosines_, sines_;
  std::vector<float> sums_;
};

}  // namespace

Ring likeliest_ring(const cv::Mat& luminance, optics::Vec2 place) {
  Rings rings(RingStrip(luminance, place));
  Ring best{place, RingStrip::kNearest, std::numeric_limits<double>::lowest()};
  constexpr int kSteps = static_cast<int>(kFarthestOff / kStep);
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      if (i * i + j * j > kSteps * kSteps) continue;
      const Rings::Best here = rings.best(i * kStep, j * kStep);
      if (!(here.likeness > best.likeness)) continue;
      const double r = RingStrip::radius(here.column);
      best = {{place.u + i * kStep * r, place.v + j * kStep * r}, r, here.likeness};
    }
  }
  return best;
}

}  // namespace orbwatch::align
