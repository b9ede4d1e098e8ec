// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <optional>
#include <ostream>
#include <string>

#include "tests/proc/align/place/mirrored_rig.h"
#include "tests/support/error_distribution.h"
#include "tests/support/share.h"

/// Accuracy of placement against the best possible one (Cramer and Rao), over random rigs that are
/// simulated by plain vectors.
namespace orbwatch::tests {
namespace {

using align::BallCentre;

struct Case {
  std::string name;
  RigWishes wishes;
  BallCentre::Knowledge knowledge = BallCentre::Knowledge::Known;
  bool focal_unknown = false;
  Noise noise;
  std::uint64_t seed = 0;
  std::optional<double> most;  ///< degrees, limit of the rigs' median
  double most_refused = 0.04;  ///< share of the rigs
};

/// Expects `seen` of `cases` to be plausible for events of that probability.
void expect_share(int seen, int cases, double probability, const std::string& what) {
  const double sigma = std::sqrt(probability * (1 - probability) * cases);
  EXPECT_NEAR(seen, probability * cases, 3.5 * sigma + 0.5) << what;
}

double normalised_square(const Eigen::Matrix<double, 6, 1>& error, const cv::Matx66d& covariance) {
  Eigen::Matrix<double, 6, 6> matrix;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) matrix(r, c) = covariance(r, c);
  }
  // Radians and millimetres are scaled to units of their sigmas.
  const Eigen::Matrix<double, 6, 1> scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 6, 6> scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::Matrix<double, 6, 1> e = scale.asDiagonal() * error;
  return e.dot(scaled.ldlt().solve(e));
}

/// Counts the truths within the region that should hold them with a given probability.
struct Coverage {
  int half = 0, most = 0, count = 0;

  void add(double square, double half_limit, double most_limit) {
    half += square < half_limit ? 1 : 0;
    most += square < most_limit ? 1 : 0;
    ++count;
  }
  /// Tests the placed pose, by chi-square with 6 degrees of freedom; the focal length, with 1, when
  /// it was unknown: the pose then varies by more than its first order.
  void add(const RigCamera& truth, const align::PlacedCamera& placed) {
    if (placed.focal_sigma) {
      const double off = (placed.lens.fx - truth.focal) / *placed.focal_sigma;
      add(off * off, 0.4549, 3.841);
    } else {
      add(normalised_square(pose_error(truth, placed.pose), placed.covariance), 5.348, 12.592);
    }
  }
  void report() const {
    std::printf("within 50 %%: %d, within 95 %%: %d of %d\n", half, most, count);
    testing::Test::RecordProperty("within_half", half);
    testing::Test::RecordProperty("within_95", most);
    expect_share(half, count, 0.5, "inside the 50 % region");
    expect_share(most, count, 0.95, "inside the 95 % region");
  }
};

/// Printer for GoogleTest's messages.
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class PlacementGate : public testing::TestWithParam<Case> {};

TEST_P(PlacementGate, ReachesTheBoundAndKnowsItsErrors) {
  const Case& c = GetParam();
  const int rigs = share_of(200);
  ErrorDistribution error(c.name + ", deg"), ratio(c.name + ", error / bound");
  ErrorDistribution claimed(c.name + ", claimed / bound");
  Coverage coverage;
  int refused = 0;
  double squares = 0;
  for (int n = 0; n < rigs; ++n) {
    std::mt19937_64 random(c.seed + std::uint64_t(n));
    const MirroredRig rig = random_rig(random, c.wishes);
    const auto found = align::place(request_of(rig, c.noise, c.knowledge, c.focal_unknown, random));
    if (!found) {
      ++refused;
      std::printf("rig %d refused: %s\n", n, found.error().message.c_str());
      continue;
    }
    for (std::size_t k = 0; k < rig.cameras.size(); ++k) {
      const double off = direction_error(rig, k, *found);
      const double bound = least_direction_error(rig, c.noise, c.knowledge, c.focal_unknown, k);
      error.add(off);
      ratio.add(off / bound);
      claimed.add(found->cameras[k].direction_sigma / bound);
      squares += std::pow(off / bound, 2);
      coverage.add(rig.cameras[k], found->cameras[k]);
    }
  }
  error.report();
  ratio.report();
  claimed.report();
  const double rms = std::sqrt(squares / double(error.size()));
  std::printf("rms error / bound %.3f, refused %d of %d\n", rms, refused, rigs);
  coverage.report();
  EXPECT_LE(refused, std::max(1.0, c.most_refused * rigs));
  EXPECT_LE(ratio.p50(), 1.2);
  EXPECT_LE(rms, 1.2);
  // The median of few cases scatters.
  const double slack = rigs < 100 ? 1.3 : 1;
  EXPECT_LE(error.p50(), slack * c.most.value_or(HUGE_VAL));
}

constexpr auto kKnown = BallCentre::Knowledge::Known;
constexpr auto kMeasured = BallCentre::Knowledge::Measured;
constexpr auto kUnknown = BallCentre::Knowledge::Unknown;

INSTANTIATE_TEST_SUITE_P(
    , PlacementGate,
    testing::Values(
        Case{"6 points", {1, 6}, kKnown, false, {}, 41'000, {}},
        Case{"12 points", {1, 12}, kKnown, false, {}, 42'000, {}},
        Case{"6 points, centre unknown", {1, 6}, kUnknown, false, {}, 43'000, {}},
        Case{"12 points, centre unknown", {1, 12}, kUnknown, false, {}, 44'000, {}},
        Case{"6 points, large", {1, 6, 600, 900}, kKnown, false, {}, 45'000, 0.2},
        Case{"12 points, large", {1, 12, 600, 900}, kKnown, false, {}, 46'000, 0.1},
        Case{"6 points, centre unknown, large", {1, 6, 600, 900}, kUnknown, false, {}, 47'000, 0.2},
        Case{"12 points, centre unknown, large",
             {1, 12, 600, 900},
             kUnknown,
             false,
             {},
             48'000,
             0.1},
        Case{"8 points, all measured", {1, 8}, kMeasured, false, {0.5, 0.5, 1, 2}, 49'000, {}},
        Case{"3 cameras", {3, 5}, kUnknown, false, {0.5, 0.5, 0.5, 0}, 50'000, {}},
        Case{"focal length unknown", {1, 10}, kKnown, true, {}, 51'000, {}, 0.4}),
    [](const auto& p) {
      std::string name = p.param.name;
      std::erase_if(name, [](char ch) { return ch == ',' || ch == ' '; });
      return name;
    });

}  // namespace
}  // namespace orbwatch::tests
