// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/consensus/rotation_consensus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "proc/align/register/consensus/sightings.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;

constexpr int kLeastTrials = 200;           // also finds a rival
constexpr double kMissed = 1e-4;            // probability that no trial was right
constexpr std::size_t kMostCandidates = 8;  // candidates that are fitted before they are compared
constexpr int kFitsOfEach = 8;              // rounds for each candidate

/// Trial rotations; keeps the best of those that are altogether different.
class ConsensusSearch {
 public:
  explicit ConsensusSearch(Sightings& sightings) : sightings_(sightings) {}

  Result<RotationConsensus> run() {
    if (sightings_.size() < 2) return fail("the pictures have nothing in common that can be told");
    std::uniform_int_distribution<std::size_t> any(0, sightings_.size() - 1);
    for (int trial = 0; trial < trials(); ++trial) {
      const std::array chosen{any(random_), any(random_)};
      const auto rotation = sightings_.hypothesis(chosen);
      if (rotation) note({*rotation, agreeing(*rotation, kAgreement).size()});
    }
    return decided();
  }

 private:
  struct Found {
    Mat3 rotation;
    std::size_t inliers = 0;
  };

  /// Number of trials for which one uses two inliers with near certainty.
  int trials() const {
    const std::size_t most = found_.empty() ? 0 : found_.front().inliers;
    const double share = static_cast<double>(most) / static_cast<double>(sightings_.size());
    const double needed = std::log(kMissed) / std::log1p(-std::min(0.99, share * share) - 1e-9);
    return std::clamp(static_cast<int>(std::min(needed, 1e6)), kLeastTrials,
                      sightings_.most_trials());
  }

  std::vector<std::size_t> agreeing(const Mat3& rotation, double within) const {
    const auto pairs = sightings_.pairs(rotation);
    std::vector<std::size_t> inliers;
    const double cosine = std::cos(within);
    for (std::size_t n = 0; n < pairs.size(); ++n) {
      if (pairs[n] && dot(rotation * pairs[n]->camera, pairs[n]->reference) > cosine) {
        inliers.push_back(n);
      }
    }
    return inliers;
  }

  static bool is_better(const Found& a, const Found& b) { return a.inliers > b.inliers; }

  void note(const Found& found) {
    if (found_.size() == kMostCandidates && found.inliers <= found_.back().inliers) return;
    const auto is_like = [&](const Found& other) {
      return angle_between(found.rotation, other.rotation) <= kDifferent;
    };
    if (std::ranges::any_of(found_, [&](const Found& other) {
          return is_like(other) && !is_better(found, other);
        })) {
      return;
    }
    std::erase_if(found_, is_like);
    found_.insert(std::ranges::upper_bound(found_, found, is_better), found);
    if (found_.size() > kMostCandidates) found_.pop_back();
  }

  /// Fits a rotation to all matches that agree with it.
  Mat3 fitted(Mat3 rotation) const {
    for (int round = 0; round < kFitsOfEach; ++round) {
      rotation = sightings_.fitted(rotation, agreeing(rotation, kAgreement));
    }
    return rotation;
  }

  /// Fits the best candidate, and counts the matches that agree with the best of the others.
  Result<RotationConsensus> decided() {
    if (found_.empty()) return fail("no rotation agrees with any two features");
    std::vector<Found> fits;
    for (const Found& one : found_) {
      const Mat3 rotation = fitted(one.rotation);
      fits.push_back({rotation, agreeing(rotation, sightings_.exactness()).size()});
    }
    std::ranges::stable_sort(fits, is_better);
    const Found& best = fits.front();
    const auto rival = std::ranges::find_if(fits, [&](const Found& other) {
      return angle_between(other.rotation, best.rotation) > kDifferent;
    });
    const std::vector<std::size_t> inliers = agreeing(best.rotation, kAgreement);
    RotationConsensus result{best.rotation,
                             {},
                             best.inliers,
                             rival == fits.end() ? 0 : rival->inliers,
                             sightings_.room(best.rotation, inliers)};
    for (const std::size_t n : inliers) result.inliers.push_back(sightings_.match(n));
    return result;
  }

  Sightings& sightings_;
  std::mt19937_64 random_{1};
  std::vector<Found> found_;  ///< best first, altogether different from one another
};

}  // namespace

Result<RotationConsensus> agree_on_rotation(const std::vector<Match>& matches,
                                            const BallProjection& reference,
                                            const SoughtCamera& sought) {
  const auto sightings = make_sightings(matches, reference, sought);
  if (!sightings) return tl::unexpected(sightings.error());
  return ConsensusSearch(**sightings).run();
}

}  // namespace orbwatch::align
