#include "proc/align/detect/polar_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbwatch::align {
namespace {

/// Neighbouring slopes say the same: so many pixels count as one, and so many along an edge.
constexpr double kCorrelated = 9, kCorrelatedEdge = 3;
/// The annulus outside of a limb, shares of its radius.
constexpr double kOutside = 1.04, kFar = 1.2;
constexpr std::size_t kOutsideRing = ReflectionLaw::kRings - 2;
/// What an edge on the limb is worth, nats.
constexpr double kEdge = 0.3;
/// The most that a sector may deny, nats per correlated area: a mount may hide the ball there.
constexpr double kDenial = 0.2, kOutsideDenial = 0.05;

}  // namespace

void PolarEvidence::Sums::operator+=(const Sums& other) {
  for (std::size_t n = 0; n < rings.size(); ++n) rings[n] += other.rings[n];
  area += other.area;
}

std::array<PolarEvidence::Direction, PolarEvidence::kAngles> PolarEvidence::directions() {
  std::array<Direction, kAngles> all;
  for (std::size_t a = 0; a < kAngles; ++a) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(a) / kAngles;
    all[a] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  }
  return all;
}

PolarEvidence::PolarEvidence(const Slopes& slopes, const ReflectionLaw& law, optics::Vec2 centre,
                             double nearest, double farthest)
    : first_(std::max(1, static_cast<int>(ReflectionLaw::kBounds[0] * nearest) - 1)),
      count_(static_cast<std::size_t>(std::max(static_cast<int>(kFar * farthest) + 3 - first_, 2))),
      sums_(kSectors * count_),
      contours_(kSectors * count_) {
  std::vector<float> edges;
  for (std::size_t angle = 0; angle < kAngles; ++angle) {
    sum_up(slopes, law, centre, angle, edges);
    add_edges(edges, angle / kAnglesPerSector, slopes.floor2);
  }
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    Sums* sums = &sums_[sector * count_];
    for (std::size_t i = 1; i < count_; ++i) sums[i] += sums[i - 1];
  }
}

/// `edges`: gets the energy along the radius, as far as the picture goes.
void PolarEvidence::sum_up(const Slopes& slopes, const ReflectionLaw& law, optics::Vec2 centre,
                           std::size_t angle, std::vector<float>& edges) {
  static const auto kDirections = directions();
  constexpr auto kArea = static_cast<float>(2 * std::numbers::pi / kAngles / kCorrelated);
  const auto [c, s] = kDirections[angle];
  const auto cu = static_cast<float>(centre.u) + 0.5F, cv = static_cast<float>(centre.v) + 0.5F;
  Sums* sums = &sums_[angle / kAnglesPerSector * count_];
  edges.assign(1, 0);
  for (std::size_t i = 1; i < count_; ++i) {
    const auto r = static_cast<float>(first_ + static_cast<int>(i));
    const float x = cu + c * r, y = cv + s * r;
    if (!(x >= 1 && y >= 1)) return;
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    if (u >= slopes.width() - 1 || v >= slopes.height() - 1) return;
    sums[i].area += r * kArea;
    edges.push_back(0);
    const float gu = slopes.along_u.at<float>(v, u), gv = slopes.along_v.at<float>(v, u);
    const float energy = gu * gu + gv * gv;
    if (energy < slopes.floor2 * 0.05F) continue;
    const float along = gu * c + gv * s;
    edges.back() = along * along;
    const float weight = r * kArea * energy / (energy + slopes.floor2);
    const auto& ratios = law.at(std::min(along * along / energy, 1.F));
    for (std::size_t n = 0; n < ratios.size(); ++n) sums[i].rings[n] += weight * ratios[n];
  }
}

void PolarEvidence::add_edges(const std::vector<float>& edges, std::size_t sector, float floor2) {
  constexpr double kWorth = kEdge * 2 * std::numbers::pi / kAngles / kCorrelatedEdge;
  float* contours = &contours_[sector * count_];
  for (std::size_t i = 2; i + 1 < edges.size(); ++i) {
    if (edges[i] < floor2 || edges[i] < edges[i - 1] || edges[i] < edges[i + 1]) continue;
    const double r = first_ + static_cast<double>(i);
    const auto worth = static_cast<float>(kWorth * r) * edges[i] / (edges[i] + 3 * floor2);
    contours[i - 1] += worth / 2;
    contours[i] += worth;
    contours[i + 1] += worth / 2;
  }
}

double PolarEvidence::operator()(double radius) const {
  double sum = 0;
  for (std::size_t sector = 0; sector < kSectors; ++sector) sum += of(sector, radius);
  return sum;
}

double PolarEvidence::of(std::size_t sector, double radius) const {
  double inside = 0;
  for (std::size_t n = 0; n < ReflectionLaw::kRings; ++n) {
    inside +=
        ring(sector, n, radius * ReflectionLaw::kBounds[n], radius * ReflectionLaw::kBounds[n + 1]);
  }
  const double outside = ring(sector, kOutsideRing, kOutside * radius, kFar * radius);
  const double all = area(sector, ReflectionLaw::kBounds[0] * radius, kOutside * radius);
  const auto [i, share] = place(radius);
  const float* contours = &contours_[sector * count_];
  return std::lerp(contours[i], contours[i + 1], share) +
         std::max(inside - std::max(outside, -kOutsideDenial * all), -kDenial * all);
}

double PolarEvidence::ring(std::size_t sector, std::size_t n, double from, double to) const {
  const auto at = [&](double radius) {
    const auto [i, share] = place(radius);
    const Sums* sums = &sums_[sector * count_ + i];
    return std::lerp(sums[0].rings[n], sums[1].rings[n], share);
  };
  return at(to) - at(from);
}

double PolarEvidence::area(std::size_t sector, double from, double to) const {
  const auto at = [&](double radius) {
    const auto [i, share] = place(radius);
    const Sums* sums = &sums_[sector * count_ + i];
    return std::lerp(sums[0].area, sums[1].area, share);
  };
  return at(to) - at(from);
}

PolarEvidence::Place PolarEvidence::place(double radius) const {
  const double at = std::clamp(radius - first_, 0.0, static_cast<double>(count_) - 1.001);
  const auto index = static_cast<std::size_t>(at);
  return {index, at - static_cast<double>(index)};
}

}  // namespace orbwatch::align
