#include "proc/align/detect/limb_likelihood.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "proc/align/detect/limb_profile.h"
#include "proc/align/detect/reflection_law.h"

namespace orbwatch::align {
namespace {

/// Neighbouring slopes say the same: so many count as one.
constexpr double kCorrelated = 24;
/// What an edge on one ray is worth, nats, and at 0 to 3 columns from it.
constexpr double kEdge = 0.5;
constexpr std::array kBlurred{1.0, 0.8, 0.45, 0.15};
/// The compression within the strip.
constexpr double kCompression = 8;
/// Share of the sectors that say nothing.
constexpr double kStray = 0.3, kProfileStray = 0.1;
/// What an axis costs that differs from what perspective makes of a sphere, nats per share of the
/// radius. Not by the square: some lenses and pixels do stretch balls.
constexpr double kShape = 3000;
/// The shortest focal length to be expected, in long sides of the picture.
constexpr double kShortestFocalLength = 0.55;

/// To `logarithms` those of the probabilities of the columns, if `nats` speak for them and a
/// `stray` share of the sectors is wrong.
template <class Number>
void add_logarithms(const Number* nats, std::size_t columns, double stray, double* logarithms) {
  const double most = *std::max_element(nats, nats + columns);
  double total = 0;
  for (std::size_t k = 0; k < columns; ++k) total += std::exp(nats[k] - most);
  for (std::size_t k = 0; k < columns; ++k) {
    const double p = std::exp(nats[k] - most) / total;
    logarithms[k] += std::log(stray / static_cast<double>(columns) + (1 - stray) * p);
  }
}

}  // namespace

LimbLikelihood::LimbLikelihood(const LimbStrip& strip, const optics::Outline& outline,
                               const cv::Size& picture)
    : columns_(static_cast<std::size_t>(strip.columns())),
      limb_(strip.limb()),
      sectors_(kSectors * columns_),
      radius_((outline.rx + outline.ry) / 2),
      half_((outline.rx - outline.ry) / 2) {
  std::vector<double> steps(sectors_.size());
  // Profiles reach beyond both ends.
  const std::size_t wide = columns_ + limb_profile::kColumns - 1;
  std::vector<float> profiles(kSectors * wide);
  for (int ray = 0; ray < strip.rays(); ++ray) {
    const std::size_t sector = strip.sector(ray, kSectors);
    add_slopes(strip, ray, &steps[sector * columns_]);
    add_edges(strip, ray, &steps[sector * columns_]);
    add_profile(strip, ray, &profiles[sector * wide]);
  }
  for (std::size_t s = 0; s < kSectors; ++s) {
    double* logarithms = &sectors_[s * columns_];
    add_logarithms(&steps[s * columns_], columns_, kStray, logarithms);
    add_logarithms(&profiles[s * wide + limb_profile::kFarthest], columns_, kProfileStray,
                   logarithms);
    const double a = 2 * std::numbers::pi * (static_cast<double>(s) + 0.5) / kSectors;
    basis_[s] = {1, std::cos(a), std::sin(a), std::cos(2 * a), std::sin(2 * a)};
  }
  const double u = outline.centre.u - (picture.width - 1) / 2.0;
  const double v = outline.centre.v - (picture.height - 1) / 2.0;
  const double way = 2 * (std::atan2(v, u) - optics::radians(outline.angle));
  cos_middle_ = std::cos(way);
  sin_middle_ = std::sin(way);
  // A sphere at the angle b from the axis is longer by about 1 / cos b.
  const double tan_b =
      std::hypot(u, v) / (kShortestFocalLength * std::max(picture.width, picture.height));
  longest_ = std::min(tan_b * tan_b, 1.0) / 4;
}

/// The evidence of slopes for a limb at each column: for a ball from the inside up to there.
void LimbLikelihood::add_slopes(const LimbStrip& strip, int ray, double* sums) const {
  double sum = 0;
  for (std::size_t k = 0; k < columns_; ++k) {
    if (const auto here = strip.slope(ray, static_cast<int>(k))) {
      const double weight = here->energy() / (here->energy() + strip.floor2());
      sum += weight * log_ratio(kCompression, here->share()) / kCorrelated;
    }
    sums[k] += sum;
  }
}

void LimbLikelihood::add_edges(const LimbStrip& strip, int ray, double* sums) const {
  const auto energy = [&](int k) {
    const auto here = strip.slope(ray, k);
    return here ? here->along * here->along : 0;
  };
  const int columns = static_cast<int>(columns_);
  for (int k = 1; k + 1 < columns; ++k) {
    const auto here = strip.slope(ray, k);
    const float e = energy(k);
    if (e < 4 * strip.floor2() || e < energy(k - 1) || e < energy(k + 1) || !here ||
        here->share() < 2.0 / 3) {
      continue;
    }
    const double worth = kEdge * e / (e + 12 * strip.floor2());
    for (int d = -3; d <= 3; ++d) {
      if (k + d >= 0 && k + d < columns) {
        sums[k + d] += worth * kBlurred[static_cast<std::size_t>(std::abs(d))];
      }
    }
  }
}

/// A slope speaks for limbs on both sides of it.
void LimbLikelihood::add_profile(const LimbStrip& strip, int ray, float* sums) const {
  for (std::size_t k = 0; k < columns_; ++k) {
    const auto here = strip.slope(ray, static_cast<int>(k));
    if (!here) continue;
    const auto& profile = limb_profile::at(limb_profile::kind(*here, strip.floor2()));
    constexpr auto kShare = static_cast<float>(1 / kCorrelated);
    for (std::size_t j = 0; j < limb_profile::kColumns; ++j) {
      sums[k + j] += kShare * profile[limb_profile::kColumns - 1 - j];
    }
  }
}

double LimbLikelihood::shape(const Offset& offset) const {
  const double p = (half_ + offset[3]) / radius_, q = offset[4] / radius_;
  const double along = p * cos_middle_ + q * sin_middle_;
  const double across = q * cos_middle_ - p * sin_middle_;
  const double beyond = std::max({0.0, -along, along - longest_});
  return -kShape * std::hypot(beyond, across);
}

double LimbLikelihood::operator()(const Offset& offset) const {
  double sum = shape(offset);
  for (std::size_t s = 0; s < kSectors; ++s) {
    double t = 0;
    for (std::size_t i = 0; i < offset.size(); ++i) t += basis_[s][i] * offset[i];
    const double place =
        std::clamp(limb_ + t * LimbStrip::kPerPixel, 0.0, static_cast<double>(columns_) - 1.001);
    const auto k = static_cast<std::size_t>(place);
    const double* row = &sectors_[s * columns_];
    sum += std::lerp(row[k], row[k + 1], place - static_cast<double>(k));
  }
  return sum;
}

double LimbLikelihood::above_random(const Offset& offset) const {
  constexpr int kTerms = 2;  // steps and profiles
  return (*this)(offset) / kSectors + kTerms * std::log(static_cast<double>(columns_));
}

}  // namespace orbwatch::align
