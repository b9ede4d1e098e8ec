// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/reference_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "proc/align/limb_distance.h"

namespace orbwatch::align {
namespace {

using optics::Outline;
using optics::Vec2;

/// Rings of the ball, shares of its radius: one patch for each sector of each. The centre is left
/// out: its content moves least with the limb when the ball itself moves.
constexpr std::array kPatchRings{0.4, 0.62, 0.8, 0.92, 1.0};
/// Limits of the ball and of its surroundings, shares of the radius.
constexpr double kInside = 1.01, kOutside = 1.04;
/// Cells along each side of the picture; each has at most one patch of the surroundings.
constexpr int kCells = 6;
constexpr std::size_t kMostAround = 24;
/// Distance between candidates, share of the patches' side.
constexpr int kPatchStep = Patch::kSide / 3;
/// Most saturated pixels of a patch, a tenth.
constexpr int kMostSaturatedPixels = Patch::kPixels / 10;

/// Share of a patch's contrast in the reference below which it is flat: dark, foggy, or another
/// gain.
constexpr double kFlat = 0.15;
/// Least noise assumed for the brightness of quantised samples.
constexpr double kQuantised = 0.3;

/// Standard deviation of a window's brightness.
double contrast(const PatchWindow& window) {
  double sum = 0, squares = 0;
  for (const float value : window.values) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const auto count = static_cast<double>(window.values.size());
  return std::sqrt(std::max(0.0, squares / count - sum / count * sum / count));
}

/// Standard deviation of the noise of a smoothed picture, from differences of neighbours
/// (Immerkaer, 1996, with a median instead of the mean, as most of a picture has no edge).
double smoothed_noise(const cv::Mat& picture) {
  std::vector<float> differences;
  const int step = std::max(1, picture.cols * picture.rows / 20'000);
  for (int i = 0; i < picture.cols * picture.rows; i += step) {
    const int u = i % picture.cols, v = i / picture.cols;
    if (u < 2 || v < 2 || u + 2 >= picture.cols || v + 2 >= picture.rows) continue;
    const auto at = [&](int du, int dv) { return picture.at<float>(v + dv, u + du); };
    differences.push_back(std::abs(at(-2, -2) + at(2, -2) + at(-2, 2) + at(2, 2) -
                                   2 * (at(0, -2) + at(-2, 0) + at(2, 0) + at(0, 2)) +
                                   4 * at(0, 0)));
  }
  if (differences.empty()) return kQuantised;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return std::max(kQuantised, *middle / 0.6745 / 6);
}

/// A candidate place for a patch.
struct PatchCandidate {
  cv::Point corner;
  Vec2 arm;
  double texture = 0;
};

class Choice {
 public:
  Choice(const cv::Mat& picture, const Outline& outline, float saturated, int sectors)
      : picture_(picture),
        outline_(outline),
        distance_(outline),
        saturated_(saturated),
        sectors_(sectors),
        noise_(smoothed_noise(picture)) {}

  ReferenceScale run() const {
    std::vector<std::optional<PatchCandidate>> ball((kPatchRings.size() - 1) *
                                                    static_cast<std::size_t>(sectors_));
    std::array<std::optional<PatchCandidate>, kCells * kCells> around;
    // Windows around patches are within the picture, so that none is lost without motion.
    constexpr int kMargin = PatchWindow::kReach + 2;
    for (int v = kMargin; v + Patch::kSide + kMargin < picture_.rows; v += kPatchStep) {
      for (int u = kMargin; u + Patch::kSide + kMargin < picture_.cols; u += kPatchStep) {
        const PatchCandidate candidate = at({u, v});
        if (candidate.texture <= 0) continue;
        const double share = distance_.of(candidate.arm);
        if (share > kPatchRings.back()) {
          const auto cell = static_cast<std::size_t>(v * kCells / picture_.rows * kCells +
                                                     u * kCells / picture_.cols);
          keep_better(candidate, around[cell]);
        } else if (share > kPatchRings.front()) {
          const auto ring = static_cast<std::size_t>(
              std::upper_bound(kPatchRings.begin(), kPatchRings.end() - 1, share) -
              kPatchRings.begin() - 1);
          keep_better(candidate,
                      ball[ring * static_cast<std::size_t>(sectors_) + sector(candidate.arm)]);
        }
      }
    }
    ReferenceScale scale{outline_, {}, {}};
    for (const auto& candidate : ball) add(candidate, true, scale.ball);
    std::ranges::sort(around, std::greater<>(), [](const auto& c) { return c ? c->texture : 0.0; });
    for (const auto& candidate : around) {
      if (scale.surroundings.size() < kMostAround) add(candidate, false, scale.surroundings);
    }
    return scale;
  }

 private:
  std::size_t sector(const Vec2& arm) const {
    const double turn = (std::atan2(arm.v, arm.u) / std::numbers::pi + 1) / 2;
    return static_cast<std::size_t>(std::clamp(static_cast<int>(turn * sectors_), 0, sectors_ - 1));
  }

  static void keep_better(const PatchCandidate& candidate, std::optional<PatchCandidate>& best) {
    if (!best || best->texture < candidate.texture) best = candidate;
  }

  /// Texture along the poorer direction counts most, but a limb without other texture is a patch,
  /// too.
  PatchCandidate at(cv::Point corner) const {
    constexpr double kMiddle = (Patch::kSide - 1) / 2.0;
    PatchCandidate candidate{
        corner, {corner.x + kMiddle - outline_.centre.u, corner.y + kMiddle - outline_.centre.v}};
    const bool is_ball = distance_.of(candidate.arm) <= kPatchRings.back();
    double uu = 0, uv = 0, vv = 0;
    int saturated = 0;
    for (int y = 0; y < Patch::kSide; y += 2) {
      const float* const above = picture_.ptr<float>(corner.y + y - 1) + corner.x;
      const float* const row = picture_.ptr<float>(corner.y + y) + corner.x;
      const float* const below = picture_.ptr<float>(corner.y + y + 1) + corner.x;
      for (int x = 0; x < Patch::kSide; x += 2) {
        saturated += row[x] >= saturated_ ? 4 : 0;
        if (!counts(is_ball, {candidate.arm.u + x - kMiddle, candidate.arm.v + y - kMiddle})) {
          continue;
        }
        const double gu = row[x + 1] - row[x - 1], gv = below[x] - above[x];
        uu += gu * gu;
        uv += gu * gv;
        vv += gv * gv;
      }
    }
    if (saturated > kMostSaturatedPixels) return candidate;
    const double mean = (uu + vv) / 2, half = std::hypot((uu - vv) / 2, uv);
    candidate.texture = mean - half + 0.1 * (mean + half);
    return candidate;
  }

  bool counts(bool is_ball, const Vec2& arm) const {
    const double squared = distance_.squared(arm);
    return is_ball ? squared < kInside * kInside : squared > kOutside * kOutside;
  }

  void add(const std::optional<PatchCandidate>& candidate, bool is_ball, PatchGroup& group) const {
    if (!candidate) return;
    constexpr double kMiddle = (Patch::kSide - 1) / 2.0;
    Patch::Mask mask{};
    for (int i = 0; i < Patch::kPixels; ++i) {
      const int column = i % Patch::kSide, row = i / Patch::kSide;
      const Vec2 arm{candidate->arm.u + column - kMiddle, candidate->arm.v + row - kMiddle};
      mask[static_cast<std::size_t>(i)] = counts(is_ball, arm) ? 1 : 0;
    }
    if (auto patch = Patch::make(picture_, candidate->corner, mask, noise_)) {
      group.push_back({*patch, candidate->corner, candidate->arm});
    }
  }

  const cv::Mat& picture_;
  Outline outline_;
  LimbDistance distance_;
  float saturated_;
  int sectors_;
  double noise_;
};

}  // namespace

ReferenceScale reference_scale(const cv::Mat& picture, const Outline& outline, float saturated,
                               int sectors) {
  return Choice(picture, outline, saturated, sectors).run();
}

void find_patches(const PatchGroup& group, const PictureMotion& guess, const ReadWindow& read,
                  Sighting& sighting) {
  sighting.found.clear();
  sighting.expected = sighting.saturated = sighting.flat = 0;
  PatchWindow window;
  for (const PlacedPatch& placed : group) {
    const Vec2 way = guess.at(placed.arm);
    const cv::Point whole(cvRound(way.u), cvRound(way.v));
    const cv::Point reach(PatchWindow::kReach, PatchWindow::kReach);
    if (!read(placed.corner + whole - reach, window)) continue;
    ++sighting.expected;
    if (window.is_saturated) {
      ++sighting.saturated;
      continue;
    }
    if (auto shift = placed.patch.find(window, {way.u - whole.x, way.v - whole.y})) {
      shift->shift = {shift->shift.u + whole.x, shift->shift.v + whole.y};
      sighting.found.push_back({placed.arm, *shift});
    } else if (contrast(window) < kFlat * placed.patch.contrast()) {
      ++sighting.flat;
    }
  }
}

}  // namespace orbwatch::align
