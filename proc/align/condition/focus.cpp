// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/focus.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "proc/align/condition/ball_crop.h"
#include "proc/align/condition/step_edge.h"
#include "proc/align/limb_distance.h"

namespace orbwatch::align {
namespace {

constexpr double kInner = 0.85;  // rho up to which the reflection is wide enough
constexpr int kEdgeCell = 8;     // px; side of a cell, each searched for one edge
constexpr int kMostBands = 64;   // rows of cells, about, that are searched
constexpr std::size_t kMostEdges = 200;
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

/// Slopes of a part of a slightly smoothed picture; brightness per pixel.
struct SmoothSlopes {
  cv::Mat u, v;

  SmoothSlopes(const cv::Mat& brightness, const cv::Rect& part) {
    constexpr int kMargin = 1;  // px around that Sobel's filter needs
    const cv::Rect wider(part.x - kMargin, part.y - kMargin, part.width + 2 * kMargin,
                         part.height + 2 * kMargin);
    const cv::Rect seen = wider & cv::Rect({}, brightness.size());
    const cv::Rect own(part.tl() - seen.tl(), part.size());
    cv::Mat smooth, slope;
    cv::GaussianBlur(brightness(seen), smooth, {}, 1);
    cv::Sobel(smooth, slope, CV_32F, 1, 0, 3, 1 / 8.0);
    u = slope(own).clone();
    cv::Sobel(smooth, slope, CV_32F, 0, 1, 3, 1 / 8.0);
    v = slope(own);
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

/// The steepest place of the cell that begins at column `left` of a band. nullopt if it may be
/// noise, whose standard deviation is `noise`.
std::optional<EdgeCandidate> steepest(const SmoothSlopes& band, int left, double noise) {
  const float least = static_cast<float>(noise * noise);
  EdgeCandidate best{{}, 0, least};
  for (int v = 0; v < kEdgeCell; ++v) {
    const float* const along_u = band.u.ptr<float>(v);
    const float* const along_v = band.v.ptr<float>(v);
    for (int u = left; u < left + kEdgeCell; ++u) {
      const float slope2 = along_u[u] * along_u[u] + along_v[u] * along_v[u];
      if (slope2 > best.slope2) best = {{u, v}, 0, slope2};
    }
  }
  if (best.slope2 <= least) return std::nullopt;
  best.normal = band.angle(best.pixel);
  return best;
}

/// The columns of the cells in the band from row `top` on whose middles are on the inner ball.
cv::Range inner_columns(const BallCrop& crop, int top) {
  const LimbDistance distance(crop.outline);
  const double middle = kEdgeCell / 2.0, v = top + middle - crop.outline.centre.v;
  cv::Range columns(0, 0);
  for (int left = 0; left + kEdgeCell <= crop.brightness.cols; left += kEdgeCell) {
    if (distance.of({left + middle - crop.outline.centre.u, v}) > kInner) continue;
    if (columns.empty()) columns.start = left;
    columns.end = left + kEdgeCell;
  }
  return columns;
}

/// The steepest ones that are not overexposed.
std::vector<EdgeCandidate> steepest_of(std::vector<EdgeCandidate> found, const BallCrop& crop) {
  std::vector<EdgeCandidate> kept;
  std::ranges::make_heap(found, {}, &EdgeCandidate::slope2);
  while (!found.empty() && kept.size() < kMostEdges) {
    std::ranges::pop_heap(found, {}, &EdgeCandidate::slope2);
    if (!is_clipped(crop, found.back().pixel)) kept.push_back(found.back());
    found.pop_back();
  }
  return kept;
}

/// The steepest place of each cell on the inner ball; the steepest ones of all.
std::vector<EdgeCandidate> reflected_edges(const BallCrop& crop) {
  const int rows = crop.brightness.rows,
            pause = kEdgeCell * std::max(1, rows / kEdgeCell / kMostBands);
  std::vector<EdgeCandidate> found;
  for (int top = 1; top + kEdgeCell < rows; top += pause) {
    const cv::Range columns = inner_columns(crop, top);
    if (columns.empty()) continue;
    const SmoothSlopes band(crop.brightness, {columns.start, top, columns.size(), kEdgeCell});
    for (int left = 0; left < columns.size(); left += kEdgeCell) {
      auto candidate = steepest(band, left, crop.noise);
      if (!candidate) continue;
      candidate->pixel += cv::Point(columns.start, top);
      found.push_back(*candidate);
    }
  }
  return steepest_of(std::move(found), crop);
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

/// Blur from the finest picture in which it is narrow enough to be fitted. `halvings`: those by
/// which the crop is smaller than the picture.
Result<Blur> blur_of(BallCrop crop, const Candidates& candidates, int halvings = 0) {
  std::optional<Blur> widest;
  for (;; ++halvings) {
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

/// Halvings after which a blur of `least` px is still so wide that a smaller picture fits better.
int halvings_for(double least, const optics::Outline& outline) {
  double radius = std::min(outline.rx, outline.ry);
  int halvings = 0;
  for (; least >= 2 * kWide && radius >= 2 * kSmallestBall; least /= 2, radius /= 2) ++halvings;
  return halvings;
}

Result<> check_limb(const Picture& picture, const optics::Outline& outline) {
  return optics::check_ellipse(outline).and_then(
      [&] { return optics::check_outline(outline, picture.width, picture.height); });
}

}  // namespace

Result<double> Focus::focused_on_ball() const {
  if (!reflection) return tl::unexpected(reflection.error());
  if (!limb) return tl::unexpected(limb.error());
  const double excess = reflection->sigma * reflection->sigma - limb->sigma * limb->sigma;
  return std::sqrt(std::max(excess, 0.0));
}

Result<Blur> reflection_blur(const Picture& picture, const optics::Outline& outline, double least) {
  const int halvings = halvings_for(least, outline);
  return check_limb(picture, outline)
      .and_then([&] { return crop_ball(picture, outline, halvings); })
      .and_then([&](const BallCrop& crop) { return blur_of(crop, reflected_edges, halvings); });
}

Result<Focus> measure_focus(const Picture& picture, const optics::Outline& outline) {
  const auto checked = check_limb(picture, outline);
  if (!checked) return tl::unexpected(checked.error());
  const Result<BallCrop> crop = crop_ball(picture, outline);
  if (!crop) return Focus{tl::unexpected(crop.error()), tl::unexpected(crop.error())};
  return Focus{blur_of(*crop, reflected_edges), blur_of(*crop, limb_edges)};
}

}  // namespace orbwatch::align
