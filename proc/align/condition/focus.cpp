// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/focus.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "proc/align/condition/ball_crop.h"
#include "proc/align/condition/step_edge.h"

namespace orbwatch::align {
namespace {

constexpr double kInner = 0.85;  // rho up to which the reflection is wide enough
constexpr int kEdgeCell = 8;     // px; side of a cell, each searched for one edge
constexpr int kMostBands = 64;   // rows of cells, about, that are searched
constexpr std::size_t kMostEdges = 200;
constexpr int kBandMargin = 1;            // rows above and below, needed by the filter
constexpr int kRays = 150;                // rays through the limb
constexpr std::size_t kFewestEdges = 10;  // edges that a figure needs
constexpr double kSmallestBall = 40;      // px; radius of the ball in the smallest picture used
constexpr double kWide = 2;               // px of blur from which on a smaller picture fits better
constexpr double kClipped = 0.97;         // share of full scale
// Share of sigma by which edges of one picture differ anyway.
constexpr double kLeastEdgeSpread = 0.1;
// Quantile of the edges' sigma that counts as the blur. Things may be blurred in themselves, but
// none is sharper than the picture.
constexpr double kSharper = 0.35;

struct EdgeCandidate {
  cv::Point pixel;
  double normal;
  float slope2;
};

/// Slopes of a slightly smoothed picture; brightness per pixel.
struct SmoothSlopes {
  cv::Mat u, v;

  explicit SmoothSlopes(const cv::Mat& brightness) {
    cv::Mat smooth;
    cv::GaussianBlur(brightness, smooth, {}, 1);
    cv::Sobel(smooth, u, CV_32F, 1, 0, 3, 1 / 8.0);
    cv::Sobel(smooth, v, CV_32F, 0, 1, 3, 1 / 8.0);
  }
  float squared(const cv::Point& p) const {
    const float a = u.at<float>(p), b = v.at<float>(p);
    return a * a + b * b;
  }
  double angle(const cv::Point& p) const {
    return std::atan2(static_cast<double>(v.at<float>(p)), static_cast<double>(u.at<float>(p)));
  }
};

bool is_clipped(const BallCrop& crop, const cv::Point& pixel) {
  const cv::Rect around(pixel.x - kEdgeReach, pixel.y - kEdgeReach, 2 * kEdgeReach + 1,
                        2 * kEdgeReach + 1);
  double high = 0;
  cv::minMaxLoc(crop.brightness(around & cv::Rect({}, crop.brightness.size())), nullptr, &high);
  return high >= kClipped * crop.full_scale;
}

/// The steepest place of the cell that begins at column `left` of a band; `top` is the band's row
/// in the picture. nullopt if it may be noise or is overexposed.
std::optional<EdgeCandidate> steepest(const BallCrop& crop, const SmoothSlopes& band, int left,
                                      int top) {
  const float noise = static_cast<float>(crop.noise * crop.noise);
  EdgeCandidate best{{}, 0, noise};
  for (int v = 0; v < kEdgeCell; ++v) {
    for (int u = left; u < left + kEdgeCell; ++u) {
      const float slope2 = band.squared({u, v + kBandMargin});
      if (slope2 > best.slope2) best = {{u, v + top}, band.angle({u, v + kBandMargin}), slope2};
    }
  }
  if (best.slope2 <= noise || is_clipped(crop, best.pixel)) return std::nullopt;
  return best;
}

/// The steepest place of each cell on the inner ball; the steepest ones of all.
std::vector<EdgeCandidate> reflected_edges(const BallCrop& crop) {
  const int rows = crop.brightness.rows,
            pause = kEdgeCell * std::max(1, rows / kEdgeCell / kMostBands);
  std::vector<EdgeCandidate> found;
  for (int top = kBandMargin; top + kEdgeCell + kBandMargin <= rows; top += pause) {
    const SmoothSlopes band(
        crop.brightness.rowRange(top - kBandMargin, top + kEdgeCell + kBandMargin));
    for (int left = 0; left + kEdgeCell <= crop.brightness.cols; left += kEdgeCell) {
      if (crop.rho(left + kEdgeCell / 2.0, top + kEdgeCell / 2.0) > kInner) continue;
      const auto candidate = steepest(crop, band, left, top);
      if (candidate) found.push_back(*candidate);
    }
  }
  const std::size_t kept = std::min(kMostEdges, found.size());
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end(),
                    [](const auto& a, const auto& b) { return a.slope2 > b.slope2; });
  found.resize(kept);
  return found;
}

/// Places all along the limb.
std::vector<EdgeCandidate> limb_edges(const BallCrop& crop) {
  const optics::Outline& limb = crop.outline;
  const double turn = optics::radians(limb.angle), ct = std::cos(turn), st = std::sin(turn);
  std::vector<EdgeCandidate> places;
  for (int ray = 0; ray < kRays; ++ray) {
    const double angle = 2 * std::numbers::pi * ray / kRays, c = std::cos(angle),
                 s = std::sin(angle);
    const double x = limb.rx * c, y = limb.ry * s;
    places.push_back(
        {{cvRound(limb.centre.u + x * ct - y * st), cvRound(limb.centre.v + x * st + y * ct)},
         std::atan2(limb.rx * s, limb.ry * c) + turn,
         0});
  }
  return places;
}

std::vector<StepEdge> fitted(const BallCrop& crop, const std::vector<EdgeCandidate>& candidates) {
  std::vector<StepEdge> edges;
  for (const EdgeCandidate& candidate : candidates) {
    const auto edge = fit_step_edge(crop.brightness, candidate.pixel, candidate.normal, crop.noise);
    if (edge && edge->sigma_error < 0.25 * edge->sigma) edges.push_back(*edge);
  }
  return edges;
}

/// The weighted quantile of the edges' sigma, in px of the fitted picture. Needs at least one edge.
Blur quantile(std::vector<StepEdge> edges) {
  std::ranges::sort(edges, {}, &StepEdge::sigma);
  const auto weight = [](const StepEdge& edge) {
    const double spread = kLeastEdgeSpread * edge.sigma;
    return edge.sigma * edge.sigma / (edge.sigma_error * edge.sigma_error + spread * spread);
  };
  double total = 0, information = 0;
  for (const StepEdge& edge : edges) {
    total += weight(edge);
    information += weight(edge) / (edge.sigma * edge.sigma);
  }
  double left = kSharper * total;
  std::size_t n = 0;
  for (; n + 1 < edges.size() && left > weight(edges[n]); ++n) left -= weight(edges[n]);
  return {edges[n].sigma, 1 / std::sqrt(information), static_cast<int>(edges.size())};
}

/// Blur in pixels of a picture 2^halvings as large, less the blur of halving.
Blur in_full_size(const Blur& blur, int halvings) {
  const double scale = std::ldexp(1.0, halvings), halving = (scale * scale - 1) / 12;
  const double sigma2 = blur.sigma * blur.sigma * scale * scale - halving;
  return {std::sqrt(std::max(sigma2, 0.0)), blur.error * scale, blur.edges};
}

using Candidates = std::function<std::vector<EdgeCandidate>(const BallCrop&)>;

/// Blur from the finest picture in which it is narrow enough to be fitted.
Result<Blur> blur_of(BallCrop crop, const Candidates& candidates) {
  std::optional<Blur> widest;
  for (int halvings = 0;; ++halvings) {
    const std::vector<StepEdge> edges = fitted(crop, candidates(crop));
    if (edges.size() >= kFewestEdges) {
      const Blur blur = quantile(edges);
      widest = in_full_size(blur, halvings);
      if (blur.sigma < kWide) break;
    }
    if (std::min(crop.outline.rx, crop.outline.ry) < 2 * kSmallestBall) break;
    crop = halved(crop);
  }
  if (widest) return *widest;
  return fail("too few clear edges; more light or a richer scene is needed");
}

}  // namespace

Result<double> Focus::focused_on_ball() const {
  if (!reflection) return tl::unexpected(reflection.error());
  if (!limb) return tl::unexpected(limb.error());
  const double excess = reflection->sigma * reflection->sigma - limb->sigma * limb->sigma;
  return std::sqrt(std::max(excess, 0.0));
}

Result<Focus> measure_focus(const Picture& picture, const optics::Outline& outline) {
  const auto checked = optics::check_ellipse(outline).and_then(
      [&] { return optics::check_outline(outline, picture.width, picture.height); });
  if (!checked) return tl::unexpected(checked.error());
  const Result<BallCrop> crop = crop_ball(picture, outline);
  if (!crop) return Focus{tl::unexpected(crop.error()), tl::unexpected(crop.error())};
  return Focus{blur_of(*crop, reflected_edges), blur_of(*crop, limb_edges)};
}

}  // namespace orbwatch::align
