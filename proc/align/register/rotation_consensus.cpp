#include "proc/align/register/rotation_consensus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "proc/align/register/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;
using optics::Vec3;

constexpr int kLeastTrials = 200;  // so that a rival is met, too
constexpr int kMostTrials = 1500;
constexpr double kMissed = 1e-4;  // probability that no trial was right
constexpr int kRounds = 2;        // of looking up what the turned camera sees, and turning it again
const double kAgreement = optics::radians(1.5);
const double kDifferent = optics::radians(8);

class Search {
 public:
  Search(const std::vector<Match>& matches, const BallProjection& reference,
         const SoughtCamera& sought)
      : sought_(sought) {
    for (const Match& match : matches) {
      if (const auto seen = reference.direction(match.reference)) {
        matches_.push_back(match);
        seen_.push_back(*seen);
      }
    }
  }

  Result<RotationConsensus> run() {
    if (matches_.size() < 2) return fail("the pictures have nothing in common that can be told");
    for (int trial = 0; trial < trials(); ++trial) {
      const auto rotation = hypothesis();
      if (!rotation) return tl::unexpected(rotation.error());
      if (!*rotation) continue;
      const auto inliers = agreeing(**rotation);
      if (!inliers) return tl::unexpected(inliers.error());
      note(**rotation, inliers->size());
    }
    return polished();
  }

 private:
  /// Enough that one was of two inliers.
  int trials() const {
    const double share = static_cast<double>(best_.inliers) / static_cast<double>(matches_.size());
    const double needed = std::log(kMissed) / std::log1p(-std::min(0.99, share * share) - 1e-9);
    return std::clamp(static_cast<int>(std::min(needed, 1e6)), kLeastTrials, kMostTrials);
  }

  struct Found {
    Mat3 rotation;
    std::size_t inliers = 0;
  };

  /// From two random matches; nullopt when they contradict each other.
  Result<std::optional<Mat3>> hypothesis() {
    std::uniform_int_distribution<std::size_t> any(0, matches_.size() - 1);
    const std::array chosen{any(random_), any(random_)};
    const double apart = angle_between(seen_[chosen[0]], seen_[chosen[1]]);
    if (apart < kDifferent || apart > optics::radians(180) - kDifferent) return std::nullopt;
    // Far away and in its own frame at first.
    Mat3 rotation;
    for (int round = 0; round <= kRounds; ++round) {
      const auto ball = turned(sought_, rotation, *sought_.camera.outline);
      if (!ball) return tl::unexpected(ball.error());
      std::array<DirectionPair, 2> pairs;
      for (std::size_t n = 0; n < 2; ++n) {
        const auto direction = towards(*ball, matches_[chosen[n]], round > 0);
        if (!direction) return std::nullopt;
        pairs[n] = {seen_[chosen[n]], transposed(rotation) * *direction};
      }
      const double differs = angle_between(pairs[0].camera, pairs[1].camera) - apart;
      if (round == kRounds && std::abs(differs) > 2 * kAgreement) return std::nullopt;
      rotation = fit_rotation(pairs);
    }
    return rotation;
  }

  static std::optional<Vec3> towards(const BallProjection& ball, const Match& match, bool in_room) {
    if (in_room) return ball.direction(match.camera);
    const auto ray = ball.ray(match.camera);
    return ray ? std::optional(ray->direction) : std::nullopt;
  }

  Result<std::vector<std::size_t>> agreeing(const Mat3& rotation) const {
    const auto ball = turned(sought_, rotation, *sought_.camera.outline);
    if (!ball) return tl::unexpected(ball.error());
    std::vector<std::size_t> inliers;
    const double cosine = std::cos(kAgreement);
    for (std::size_t n = 0; n < matches_.size(); ++n) {
      const auto direction = ball->direction(matches_[n].camera);
      if (direction && dot(*direction, seen_[n]) > cosine) inliers.push_back(n);
    }
    return inliers;
  }

  void note(const Mat3& rotation, std::size_t inliers) {
    if (inliers > best_.inliers) {
      if (angle_between(rotation, best_.rotation) > kDifferent) rival_ = best_.inliers;
      best_ = {rotation, inliers};
    } else if (angle_between(rotation, best_.rotation) > kDifferent) {
      rival_ = std::max(rival_, inliers);
    }
  }

  /// The best one, fitted to all that agree with it.
  Result<RotationConsensus> polished() {
    for (int round = 0; round < 5; ++round) {
      const auto inliers = agreeing(best_.rotation);
      const auto ball = turned(sought_, best_.rotation, *sought_.camera.outline);
      if (!inliers || !ball) return fail("the best rotation has no projection");
      std::vector<DirectionPair> pairs;
      for (const std::size_t n : *inliers) {
        const auto direction = ball->direction(matches_[n].camera);
        pairs.push_back({seen_[n], transposed(best_.rotation) * *direction});
      }
      if (pairs.size() >= 2) best_.rotation = fit_rotation(pairs);
    }
    RotationConsensus result{best_.rotation, {}, rival_};
    const auto inliers = agreeing(best_.rotation);
    if (!inliers) return tl::unexpected(inliers.error());
    for (const std::size_t n : *inliers) result.inliers.push_back(matches_[n]);
    return result;
  }

  const SoughtCamera& sought_;
  std::vector<Match> matches_;
  std::vector<Vec3> seen_;  ///< by the reference camera, per match
  std::mt19937_64 random_{1};
  Found best_;
  std::size_t rival_ = 0;
};

}  // namespace

Result<RotationConsensus> agree_on_rotation(const std::vector<Match>& matches,
                                            const BallProjection& reference,
                                            const SoughtCamera& sought) {
  return Search(matches, reference, sought).run();
}

}  // namespace orbwatch::align
