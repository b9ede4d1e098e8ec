// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <vector>

#include "proc/align/condition/dirt_watch.h"
#include "proc/align/condition/focus.h"
#include "tests/proc/align/condition/soiled_ball.h"
#include "tests/support/error_distribution.h"
#include "tests/support/mirror_room.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/share.h"

/// Accuracy of focus and dirt: simulated rooms with a process, rendered machines.
namespace orbwatch::tests {
namespace {

using align::DirtWatch;
using optics::Outline;

/// Largest number of `cases` that is plausible for events of that probability.
int at_most(double probability, int cases) {
  const double sigma = std::sqrt(probability * (1 - probability) * cases);
  return static_cast<int>(std::ceil(probability * cases + 3 * sigma));
}

TEST(FocusGate, SimulatedRooms) {
  const int cases = share_of(100);
  ErrorDistribution reflection("blur of the reflection, relative"),
      limb("blur of the limb, relative");
  int off = 0, none = 0;
  for (int n = 0; n < cases; ++n) {
    std::mt19937_64 random(static_cast<std::uint64_t>(120'000 + n));
    const auto in = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    MirrorRoomSettings s;
    s.seed = static_cast<std::uint64_t>(120'000 + n);
    s.width = s.height = 640;
    s.radius = in(130, 290);
    s.blur = std::exp(in(std::log(0.5), std::log(4)));
    s.noise = in(0.5, 5);
    s.exposure = in(-1.5, 1.5);
    s.distance = in(4, 30);
    s.limb_hidden = in(0, 0.2);
    const MirrorRoomPicture room = mirror_room(s);
    const Outline outline{room.limb.centre, room.limb.rx, room.limb.ry, 0};
    const auto focus = align::measure_focus(picture_of_mat(room.pixels), outline);
    ASSERT_TRUE(focus) << focus.error().message;
    if (focus->limb) limb.add(focus->limb->sigma / s.blur - 1);
    if (!focus->reflection) {
      ++none;
      continue;
    }
    const double error = focus->reflection->sigma - s.blur;
    reflection.add(error / s.blur);
    if (std::abs(error) <= std::max(0.15, 0.15 * s.blur)) continue;
    ++off;
    std::printf("room %d: %.2f px instead of %.2f\n", n, focus->reflection->sigma, s.blur);
  }
  reflection.report();
  limb.report();
  RecordProperty("off", off);
  RecordProperty("not_measured", none);
  std::printf("%d of %d off, %d not measured\n", off, cases, none);
  EXPECT_LE(off, at_most(0.02, cases));
  EXPECT_LE(none, at_most(0.08, cases));
  EXPECT_LT(reflection.p50(), 0.08);
  EXPECT_LT(limb.p50(), 0.2);
}

constexpr double kLimit = 0.02;  // limit of contamination that a clean ball must not reach

/// A watch and its ball: nine pictures in a window of a quarter of an hour.
struct Process {
  SoiledBall ball;
  DirtWatch watch;
  double now = 0;

  explicit Process(std::uint64_t seed)
      : ball(seed),
        watch(DirtWatch::make(ball.size().width, ball.size().height, ball.limb(), {900, 0.15})
                  .value()) {}

  /// The highest contamination in the next `pictures` pictures.
  double worst_of(int pictures) {
    double worst = 0;
    for (; pictures > 0; --pictures, now += 100) {
      watch.observe(picture_of_mat(ball.picture()), now);
      worst = std::max(worst, watch.dirt() ? watch.dirt()->contamination : 0);
    }
    return worst;
  }
};

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t n) { return values[n]; });
  std::vector<double> rank(values.size());
  for (std::size_t n = 0; n < order.size(); ++n) rank[order[n]] = static_cast<double>(n);
  return rank;
}

/// Spearman's rank correlation, without ties.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const auto n = static_cast<double>(x.size());
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
  return 1 - 6 * sum / (n * (n * n - 1));
}

TEST(DirtGate, SimulatedProcess) {
  const int cases = share_of(60);
  ErrorDistribution clean("index in a clean hour"), moved("index after rearrangement"),
      ratio("index at 2 to 10 %, of the truth"), off("error of the index at 2 to 10 %");
  int falls = 0, moved_much = 0, clean_above = 0;
  std::vector<double> truth, index;
  for (int n = 0; n < cases; ++n) {
    Process process(static_cast<std::uint64_t>(130'000 + n));
    process.worst_of(static_cast<int>(DirtWatch::kLooks));
    const auto learnt = process.watch.learnt();
    ASSERT_TRUE(learnt) << n << ": " << learnt.error().message;
    ASSERT_TRUE(process.watch.use(*learnt));
    const double hour = process.worst_of(36);
    ASSERT_TRUE(process.watch.dirt()) << n << ": " << process.watch.dirt().error().message;
    clean.add(hour);
    EXPECT_LT(hour, kLimit) << n;
    clean_above += hour > 0.005 ? 1 : 0;
    Process rearranged = process;
    rearranged.ball.rearrange();
    moved.add(rearranged.worst_of(18));
    moved_much +=
        rearranged.watch.dirt() && rearranged.watch.dirt()->contamination > kLimit ? 1 : 0;
    double before = 0;
    for (const double share : {0.005, 0.02, 0.05, 0.1}) {
      process.ball.soil(share);
      process.worst_of(static_cast<int>(DirtWatch::kLooks));
      ASSERT_TRUE(process.watch.dirt()) << n;
      const double now = process.watch.dirt()->contamination;
      falls += now < before ? 1 : 0;
      before = now;
      truth.push_back(process.ball.soiled());
      index.push_back(now);
      if (share < 0.02) continue;
      ratio.add(now / truth.back());
      off.add(now - truth.back());
    }
  }
  for (const ErrorDistribution* figure : {&clean, &moved, &ratio, &off}) figure->report();
  const double correlation = rank_correlation(truth, index);
  std::printf("rank correlation %.3f, %d falls, %d of %d above 2 %% after rearrangement\n",
              correlation, falls, moved_much, cases);
  RecordProperty("rank_correlation", std::to_string(correlation));
  RecordProperty("above_after_rearrangement", moved_much);
  EXPECT_LE(clean_above, at_most(0.02, cases));
  EXPECT_GT(correlation, 0.9);
  EXPECT_LE(falls, at_most(0.01, 4 * cases));
  EXPECT_LE(moved_much, at_most(0.05, cases));
  EXPECT_GT(ratio.quantile(0.05), 0.3);
  EXPECT_LT(off.p95(), 0.06);
}

/// Expects a rendered sequence to be clean against a reference from its first frames.
void expect_clean(const std::string& sequence, const std::string& camera) {
  const cv::FileStorage scene = open_rendered_scene();
  const cv::FileNode limb = scene["scenes"]["near"]["cameras"][camera]["outline"];
  const cv::FileNode seen = scene["sequences"][sequence];
  const double scale =
      seen["camera"]["fx"].real() / scene["scenes"]["near"]["cameras"][camera]["fx"].real();
  const Outline outline{{limb["cx"].real() * scale - 0.5, limb["cy"].real() * scale - 0.5},
                        limb["semi_major"].real() * scale,
                        limb["semi_minor"].real() * scale,
                        limb["major_axis_angle_deg"].real()};
  const int width = static_cast<int>(seen["camera"]["width"].real());
  const int height = static_cast<int>(seen["camera"]["height"].real());
  DirtWatch watch = DirtWatch::make(width, height, outline, {9, 0.15}).value();
  int frame = 0;
  double worst = 0;
  for (const cv::FileNode& n : seen["frames"]) {
    const std::string file = (rendered_pictures() / n["file"].string()).string();
    const cv::Mat pixels = cv::imread(file, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    ASSERT_FALSE(pixels.empty()) << file;
    watch.observe(picture_of_mat(pixels), frame);
    if (++frame == static_cast<int>(DirtWatch::kLooks)) {
      ASSERT_TRUE(watch.use(watch.learnt().value()));
    }
    if (watch.dirt()) worst = std::max(worst, watch.dirt()->contamination);
  }
  ASSERT_TRUE(watch.dirt()) << watch.dirt().error().message;
  std::printf("%s: contamination at most %.4f, %.2f judged\n", sequence.c_str(), worst,
              watch.dirt()->judged);
  EXPECT_LT(worst, 0.002);
}

TEST(DirtGate, RenderedSequencesAreClean) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  expect_clean("seq_spark", "A");
  expect_clean("seq_thermal", "C");
}

}  // namespace
}  // namespace orbwatch::tests
