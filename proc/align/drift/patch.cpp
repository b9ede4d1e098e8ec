// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/patch.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::align {
namespace {

using optics::Vec2;

constexpr int kIterations = 8;
/// Step that ends the search, px.
constexpr double kStill = 0.003;
/// Largest shift across the strongest edges by noise alone, px.
constexpr double kLargestNoise = 0.15;
/// Share of the slopes' energy that keeps a patch with a single edge from sliding along it.
constexpr double kHold = 0.002;
/// Share of the brightness' variance that the patch must explain to be found again.
constexpr double kExplained = 0.6;
/// Largest factor by which light may become weaker or stronger.
constexpr double kGainRange = 8;
/// Smoothed pixels per independent one.
constexpr double kCorrelated = 4;

constexpr int kPatchSide = Patch::kSide;
constexpr std::size_t kPatchPixels = Patch::kPixels;
using Pixels = std::array<float, kPatchPixels>;
/// Sums of columns, so that vector instructions compute them.
using ColumnSums = std::array<float, kPatchSide>;

double total(const ColumnSums& columns) {
  double sum = 0;
  for (const float column : columns) sum += column;
  return sum;
}

/// Interpolates the window at a shift. False: the shift leaves the window.
bool sample(const PatchWindow& window, const Vec2& shift, Pixels& seen) {
  const double u = shift.u + PatchWindow::kReach, v = shift.v + PatchWindow::kReach;
  if (!(u >= 0 && v >= 0 && u < 2 * PatchWindow::kReach && v < 2 * PatchWindow::kReach)) {
    return false;
  }
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const auto fu = static_cast<float>(u - u0), fv = static_cast<float>(v - v0);
  const float a = (1 - fu) * (1 - fv), b = fu * (1 - fv), c = (1 - fu) * fv, d = fu * fv;
  for (int y = 0; y < kPatchSide; ++y) {
    const float* const top = window.row(v0 + y) + u0;
    const float* const bottom = top + PatchWindow::kSide;
    float* const out = seen.data() + y * kPatchSide;
    for (int x = 0; x < kPatchSide; ++x) {
      out[x] = a * top[x] + b * top[x + 1] + c * bottom[x] + d * bottom[x + 1];
    }
  }
  return true;
}

double product(const Pixels& basis, const Pixels& seen) {
  ColumnSums sums{};
  for (std::size_t n = 0; n < kPatchPixels; n += kPatchSide) {
    for (std::size_t x = 0; x < kPatchSide; ++x) sums[x] += basis[n + x] * seen[n + x];
  }
  return total(sums);
}

/// Sum of the squared differences from the mean within the mask.
double variation(const Pixels& seen, const Pixels& mask, float mean) {
  ColumnSums sums{};
  for (std::size_t n = 0; n < kPatchPixels; n += kPatchSide) {
    for (std::size_t x = 0; x < kPatchSide; ++x) {
      const float offset = mask[n + x] * (seen[n + x] - mean);
      sums[x] += offset * offset;
    }
  }
  return total(sums);
}

}  // namespace

std::optional<Patch> Patch::make(const cv::Mat& picture, cv::Point corner, const Mask& mask,
                                 double noise) {
  Patch patch;
  patch.mask_ = mask;
  double sum = 0;
  for (int i = 0; i < kPixels; ++i) {
    const int v = corner.y + i / kSide, u = corner.x + i % kSide;
    const auto n = static_cast<std::size_t>(i);
    const float w = mask[n];
    patch.bases_[0][n] = w * (picture.at<float>(v, u + 1) - picture.at<float>(v, u - 1)) / 2;
    patch.bases_[1][n] = w * (picture.at<float>(v + 1, u) - picture.at<float>(v - 1, u)) / 2;
    patch.bases_[2][n] = w * picture.at<float>(v, u);
    patch.bases_[3][n] = w;
    sum += patch.bases_[2][n];
    patch.pixels_ += w;
  }
  if (patch.pixels_ < kPixels / 3.0) return std::nullopt;
  const auto mean = static_cast<float>(sum / patch.pixels_);
  for (std::size_t n = 0; n < kPixels; ++n) patch.bases_[2][n] -= mean * mask[n];
  cv::Matx44d normal;
  for (std::size_t i = 0; i < kBases; ++i) {
    for (std::size_t j = 0; j < kBases; ++j) {
      double product = 0;
      for (std::size_t n = 0; n < kPixels; ++n) product += patch.bases_[i][n] * patch.bases_[j][n];
      normal(static_cast<int>(i), static_cast<int>(j)) = product;
    }
  }
  patch.contrast_ = std::sqrt(normal(2, 2) / patch.pixels_);
  const double energy = normal(0, 0) + normal(1, 1);
  if (energy < noise * noise * kCorrelated / (kLargestNoise * kLargestNoise)) return std::nullopt;
  if (normal(2, 2) <= 0) return std::nullopt;
  normal(0, 0) += kHold * energy;
  normal(1, 1) += kHold * energy;
  bool solved = false;
  patch.inverse_ = normal.inv(cv::DECOMP_CHOLESKY, &solved);
  if (!solved) return std::nullopt;
  const cv::Matx22d covariance(patch.inverse_(0, 0), patch.inverse_(0, 1), patch.inverse_(1, 0),
                               patch.inverse_(1, 1));
  patch.slopes_ = covariance.inv() - cv::Matx22d::eye() * (kHold * energy);
  return patch;
}

std::optional<PatchShift> Patch::find(const PatchWindow& window, const Vec2& start) const {
  Vec2 shift = start;
  Pixels seen;
  for (int iteration = 1; iteration <= kIterations; ++iteration) {
    if (!sample(window, shift, seen)) return std::nullopt;
    cv::Vec4d right;
    for (int k = 0; k < kBases; ++k) right[k] = product(bases_[static_cast<std::size_t>(k)], seen);
    const cv::Vec4d found = inverse_ * right;
    const double gain = found[2];
    if (!(gain > 1 / kGainRange && gain < kGainRange)) return std::nullopt;
    const Vec2 step{found[0] / gain, found[1] / gain};
    shift = {shift.u - step.u, shift.v - step.v};
    if (std::hypot(step.u, step.v) > kStill && iteration < kIterations) continue;
    const auto variance = residual_variance(seen, right, found);
    if (!variance) return std::nullopt;
    return PatchShift{shift, slopes_ * (gain * gain / *variance)};
  }
  return std::nullopt;
}

/// Variance of the brightness `seen` that the bases with the factors `found` leave; nullopt: the
/// patch does not explain enough of it.
std::optional<double> Patch::residual_variance(const Pixels& seen, const cv::Vec4d& right,
                                               const cv::Vec4d& found) const {
  const double mean = right[3] / pixels_;
  const double all = variation(seen, mask_, static_cast<float>(mean));
  // Squares that the bases do not explain; without the offset's share, for precision.
  const double explained = found[0] * right[0] + found[1] * right[1] + found[2] * right[2] +
                           (found[3] - mean) * right[3];
  const double left = std::max(all - explained, 1e-6 * all);
  if (!(all > 0 && left < (1 - kExplained) * all)) return std::nullopt;
  return left / pixels_ * kCorrelated;
}

}  // namespace orbwatch::align
