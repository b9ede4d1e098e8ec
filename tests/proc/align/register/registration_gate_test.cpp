// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "app/files/rig/rig_file.h"
#include "proc/align/detect/ball_detector.h"
#include "proc/align/matrix3.h"
#include "proc/align/register/camera_registration.h"
#include "proc/align/register/features/feature_registration.h"
#include "proc/align/register/gradients/gradient_registration.h"
#include "proc/align/register/light/light_registration.h"
#include "proc/align/rotation_fit.h"
#include "tests/proc/align/register/camera_pair.h"
#include "tests/support/error_distribution.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/share.h"

/// Accuracy of registration: simulated pairs and rendered machines.
namespace orbwatch::tests {
namespace {

using align::Registration;
using optics::degrees;
using optics::Mat3;
using optics::radians;

constexpr double kWrong = 2;  // degrees

/// `truth` turned by `angle` degrees about a random axis.
Mat3 turned_away(const Mat3& truth, double angle, std::mt19937_64& random) {
  std::normal_distribution<double> any;
  const optics::Vec3 axis = optics::normalized({any(random), any(random), any(random)});
  return align::rotation_about(axis * radians(angle)) * truth;
}

/// Results of many registrations.
struct Tally {
  explicit Tally(const std::string& name) : errors(name) {}

  void add(const Result<Registration>& found, const Mat3& truth) {
    if (!found) {
      ++refused;
      std::printf("refused: %s\n", found.error().message.c_str());
      return;
    }
    const double error = degrees(align::angle_between(found->rotation, truth));
    errors.add(error);
    wrong += error > kWrong ? 1 : 0;
  }
  void report() const {
    errors.report();
    std::printf("%d refused, %d wrong\n", refused, wrong);
    testing::Test::RecordProperty("refused", refused);
    testing::Test::RecordProperty("wrong", wrong);
  }
  /// Expects the median and the 95th percentile of `cases` within limits in degrees, hardly one
  /// refused, none wrong.
  void expect(int cases, double median, double most) const {
    report();
    EXPECT_LE(errors.p50(), median);
    EXPECT_LE(errors.p95(), most);
    EXPECT_LE(refused, cases / 20);
    EXPECT_EQ(wrong, 0);
  }

  ErrorDistribution errors;
  int refused = 0;
  int wrong = 0;
};

TEST(RegistrationGate, ColourOnColour) {
  const int cases = share_of(100);
  Tally tally("colour on colour, deg");
  for (int n = 0; n < cases; ++n) {
    const CameraPair pair = camera_pair(70'000 + static_cast<std::uint64_t>(n), false);
    tally.add(align::register_by_features(pair.reference(), pair.unknown()), pair.truth);
  }
  tally.expect(cases, 0.1, 0.3);
}

TEST(RegistrationGate, ColourOnColourWithoutAStatedScene) {
  const int cases = share_of(100);
  Tally tally("colour on colour, no scene, deg");
  for (int n = 0; n < cases; ++n) {
    CameraPair pair = camera_pair(70'000 + static_cast<std::uint64_t>(n), false);
    pair.rig.scene = {};
    tally.add(align::register_by_features(pair.reference(), pair.unknown()), pair.truth);
  }
  tally.expect(cases, 0.1, 0.3);
}

/// A thermal camera on a colour camera in simulated room `n`, started up to 8 degrees off.
struct ThermalCase {
  explicit ThermalCase(int n)
      : pair(camera_pair(75'000 + static_cast<std::uint64_t>(n), true)), sought(pair.unknown()) {
    std::mt19937_64 random(75'000 + static_cast<std::uint64_t>(n));
    sought.camera.registration = turned_away(pair.truth, 8.0 * (n % 9) / 8, random);
  }

  CameraPair pair;
  align::SoughtCamera sought;
};

/// Squared error in units of the stated covariance: about 3 if it is right.
double chi_square(const Registration& found, const Mat3& truth) {
  const Mat3 off = found.rotation * transposed(truth);
  const optics::Vec3 turn{(off.row2.y - off.row1.z) / 2, (off.row0.z - off.row2.x) / 2,
                          (off.row1.x - off.row0.y) / 2};
  return dot(turn, align::inverse(found.covariance) * turn);
}

/// Chi-squares of rooms: their mean is within 3 standard errors of 3, half of it allowed for.
void expect_honest(const std::vector<double>& squares) {
  ASSERT_FALSE(squares.empty());
  double sum = 0;
  for (const double one : squares) sum += one;
  const auto count = static_cast<double>(squares.size());
  const double mean = sum / count, error = std::sqrt(6 / count);
  std::printf("chi-square %.2f, 3 expected\n", mean);
  testing::Test::RecordProperty("chi-square", std::to_string(mean));
  EXPECT_LT(mean, 3 + 3 * error);
  EXPECT_GT(mean, 1) << "sigma is exaggerated";
}

TEST(RegistrationGate, ThermalOnColour) {
  const int cases = share_of(100);
  Tally tally("thermal on colour, deg");
  std::vector<double> squares;
  for (int n = 0; n < cases; ++n) {
    const ThermalCase room(n);
    const auto found = align::register_by_gradients(room.pair.reference(), room.sought);
    tally.add(found, room.pair.truth);
    if (found) squares.push_back(chi_square(*found, room.pair.truth));
  }
  tally.expect(cases, 0.3, 0.8);
  expect_honest(squares);
}

TEST(RegistrationGate, ThermalOnColourWithAnOutlineThatIsOff) {
  const int cases = share_of(100);
  Tally tally("thermal on colour, outline off by 0.3 px, deg");
  std::vector<double> squares;
  ErrorDistribution outlines("outline, px");
  for (int n = 0; n < cases; ++n) {
    ThermalCase room(n);
    std::mt19937_64 random(76'000 + static_cast<std::uint64_t>(n));
    std::normal_distribution<double> off(0, 0.3);
    optics::Outline& outline = *room.sought.camera.outline;
    const optics::Outline truth = outline;
    outline.centre.u += off(random);
    outline.centre.v += off(random);
    const double wider = off(random);
    outline.rx += wider;
    outline.ry += wider;
    const auto found = align::register_by_gradients(room.pair.reference(), room.sought);
    tally.add(found, room.pair.truth);
    if (!found) continue;
    squares.push_back(chi_square(*found, room.pair.truth));
    outlines.add(std::hypot(found->outline.centre.u - truth.centre.u,
                            found->outline.centre.v - truth.centre.v));
  }
  tally.expect(cases, 0.3, 0.8);
  outlines.report();
  EXPECT_LE(outlines.p50(), 0.25) << "0.35 px as given";
  expect_honest(squares);
}

TEST(RegistrationGate, WrongStartsAndOtherRoomsAreRefusedOrFoundAllTheSame) {
  const int cases = share_of(40);
  Tally far_off("thermal, start 20 to 60 degrees off"), elsewhere("colour, two rooms");
  Tally unstated("colour, two rooms, no scene");
  for (int n = 0; n < cases; ++n) {
    const auto seed = 78'000 + static_cast<std::uint64_t>(n);
    const CameraPair pair = camera_pair(seed, true);
    CameraPair colour = camera_pair(seed, false);
    std::mt19937_64 random(seed);
    align::SoughtCamera sought = pair.unknown();
    sought.camera.registration = turned_away(pair.truth, 20 + n % 41, random);
    far_off.add(align::register_by_gradients(pair.reference(), sought), pair.truth);
    CameraPair other = camera_pair(seed + 500, false);
    elsewhere.add(align::register_by_features(other.reference(), colour.unknown()), colour.truth);
    other.rig.scene = colour.rig.scene = {};
    unstated.add(align::register_by_features(other.reference(), colour.unknown()), colour.truth);
  }
  far_off.report();
  elsewhere.report();
  unstated.report();
  EXPECT_EQ(far_off.wrong, 0);
  EXPECT_EQ(elsewhere.refused, cases);
  EXPECT_EQ(unstated.refused, cases);
}

/// Two cameras of a rendered machine; A is known.
struct RenderedPair {
  cv::Mat reference, picture;
  std::optional<optics::BallProjection> known;
  align::SoughtCamera sought;
  Mat3 truth;

  Result<Registration> by(Result<Registration> (*method)(const align::ReferenceCamera&,
                                                         const align::SoughtCamera&,
                                                         const align::WorkProgress&)) const {
    return method({picture_of_mat(reference), *known}, sought, {});
  }
};

RenderedPair rendered_pair(const std::string& name, const std::string& camera,
                           RenderedScene::Known known = RenderedScene::Known::BoxAndTable) {
  const RenderedScene scene(name);
  RenderedPair pair;
  pair.sought.rig = app::files::parse_rig(scene.rig(known), "rig.toml", "").value();
  for (std::size_t n = 0; n < scene.cameras().size(); ++n) {
    const RenderedCamera& seen = scene.cameras()[n];
    const cv::Mat pixels =
        cv::imread(seen.picture.string(), cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    const optics::RigCamera& stated = pair.sought.rig.cameras[n];
    if (seen.name == "A") {
      pair.reference = pixels;
      pair.known = optics::ball_projection(pair.sought.rig, stated).value();
    } else if (seen.name == camera) {
      pair.picture = pixels;
      pair.sought.camera = align::by_outline(pair.sought.rig, stated).value();
      pair.truth = registration_of_axes(stated.pose->rotation);
    }
  }
  pair.sought.picture = picture_of_mat(pair.picture);
  pair.sought.camera.registration = {};
  return pair;
}

void expect_within(const Result<Registration>& found, const Mat3& truth, double limit,
                   const std::string& what) {
  ASSERT_TRUE(found) << what << ": " << found.error().message;
  const double error = degrees(align::angle_between(found->rotation, truth));
  std::printf("%s: %.3f deg\n", what.c_str(), error);
  testing::Test::RecordProperty(what, std::to_string(error));
  EXPECT_LE(error, limit) << what;
}

TEST(RegistrationGate, RenderedMachinesOfTwoColourCameras) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  for (const std::string scene : {"near", "far"}) {
    RenderedPair pair = rendered_pair(scene, "B");
    expect_within(pair.by(align::register_by_features), pair.truth, scene == "near" ? 0.2 : 0.12,
                  scene + " B on A, true outline");
    const auto found = align::detect_ball(pair.sought.picture);
    ASSERT_TRUE(found) << found.error().message;
    pair.sought.camera.outline = found->outline;
    pair.sought.outline_sigma = 0.02;
    expect_within(pair.by(align::register_by_features), pair.truth, 0.3,
                  scene + " B on A, detected outline");
  }
}

TEST(RegistrationGate, RenderedMachinesWithoutAStatedScene) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  for (const std::string scene : {"near", "far"}) {
    RenderedPair pair = rendered_pair(scene, "B", RenderedScene::Known::Nothing);
    expect_within(pair.by(align::register_by_features), pair.truth, 0.12,
                  scene + " B on A, no scene, true outline");
    const auto found = align::detect_ball(pair.sought.picture);
    ASSERT_TRUE(found) << found.error().message;
    pair.sought.camera.outline = found->outline;
    pair.sought.outline_sigma = 0.02;
    expect_within(pair.by(align::register_by_features), pair.truth, 0.3,
                  scene + " B on A, no scene, detected outline");
  }
}

TEST(RegistrationGate, RenderedMachinesOfAColourAndAThermalCamera) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  std::mt19937_64 random(79'000);
  for (const std::string scene : {"near", "far"}) {
    RenderedPair pair = rendered_pair(scene, "C");
    for (const double angle : {3.0, 5.5, 8.0}) {
      pair.sought.camera.registration = turned_away(pair.truth, angle, random);
      expect_within(pair.by(align::register_by_gradients), pair.truth, 0.4,
                    scene + " C on A, start off by " + std::to_string(angle));
    }
  }
}

/// The pictures of a sequence, kept in memory.
struct Sequence {
  explicit Sequence(const std::string& name) {
    const cv::FileStorage scene = open_rendered_scene();
    for (const cv::FileNode& frame : scene["sequences"][name]["frames"]) {
      const std::string file = (rendered_pictures() / frame["file"].string()).string();
      pixels.push_back(cv::imread(file, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR));
      pictures.push_back(picture_of_mat(pixels.back()));
    }
  }
  std::vector<cv::Mat> pixels;
  std::vector<Picture> pictures;
};

TEST(RegistrationGate, ProcessLightNeedsNoStart) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  RenderedPair pair = rendered_pair("near", "C");
  const cv::FileStorage file = open_rendered_scene();
  const cv::FileNode seen = file["sequences"]["seq_spark"]["camera"];
  optics::RigCamera known = pair.sought.rig.cameras.front();
  ASSERT_EQ(known.name, "A");
  known.width = known.height = known.intrinsics->width = known.intrinsics->height = seen["width"];
  known.intrinsics->fx = known.intrinsics->fy = seen["fx"].real();
  known.intrinsics->cx = known.intrinsics->cy = seen["cx"].real() - 0.5;
  const Sequence colour("seq_spark"), thermal("seq_thermal");
  const optics::BallProjection ball = optics::ball_projection(pair.sought.rig, known).value();
  const auto rough =
      align::register_by_light({colour.pictures, thermal.pictures}, ball, pair.sought);
  ASSERT_TRUE(rough) << rough.error().message;
  expect_within(rough->front(), pair.truth, 4, "near C on A, from light");
  pair.sought.camera.registration = rough->front().rotation;
  pair.sought.picture = thermal.pictures.front();
  const auto fine = align::register_by_gradients({colour.pictures.front(), ball}, pair.sought);
  expect_within(fine, pair.truth, 0.6, "near C on A, from light, refined");
}

/// The first `count` pictures in a folder.
std::vector<cv::Mat> first_pictures(const std::filesystem::path& folder, std::size_t count) {
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator{folder}, {});
  std::ranges::sort(files);
  std::vector<cv::Mat> pixels;
  for (const auto& file : files) {
    if (pixels.size() == count) break;
    pixels.push_back(cv::imread(file.string(), cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR));
  }
  return pixels;
}

TEST(RegistrationGate, ProcessLightIsNoWorseByMorePictures) {
  const auto folder = reference_data() / "cases" / "light_refused";
  ORBWATCH_REQUIRE_FILE(folder);
  const auto rig = app::files::load_rig(folder / "rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  const optics::RigCamera &known = rig->cameras.at(0), &camera = rig->cameras.at(1);
  const optics::BallProjection ball = optics::ball_projection(*rig, known).value();
  const Mat3 truth{{0.9638975166260523, 0.24765890269068236, -0.09780922942226265},
                   {-0.2657562901118074, 0.9176558332131217, -0.29543419916445035},
                   {0.016588300339051523, 0.3107617088509753, 0.9503430899437757}};
  for (const std::size_t count : {6, 8, 10, 12}) {
    const auto colour = first_pictures(folder / "A", count);
    const auto thermal = first_pictures(folder / "C", count);
    const align::SoughtCamera sought{picture_of_mat(thermal.front()), *rig, camera, 0};
    const auto found = align::register_camera({pictures_of_mats(colour), pictures_of_mats(thermal)},
                                              ball, sought, align::RegistrationMethod::Auto, {});
    ASSERT_TRUE(found) << count << " pictures: " << found.error().message;
    const double error = degrees(align::angle_between(found->registration.rotation, truth));
    std::printf("from %zu pictures: %.2f deg\n", count, error);
    EXPECT_LE(error, 0.4) << count << " pictures";
  }
}

}  // namespace
}  // namespace orbwatch::tests
