// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "proc/align/drift/drift_monitor.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/process_sequence.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/rendered_sequence.h"

/// Drift in the rendered process: one camera is bumped, the others do not move.
namespace orbwatch::tests {
namespace {

using align::DriftLevel;
using align::DriftMonitor;
using align::DriftState;
using optics::Vec3;

/// The monitor's state for each frame, with the first one as reference.
std::vector<DriftState> watched(const std::string& name, bool with_lens) {
  const RenderedSequence sequence(name);
  const auto read = [](const RenderedSequence::Frame& frame) {
    return cv::imread(frame.picture.string(), cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
  };
  const cv::Mat first = read(sequence.frames().front());
  align::DriftSubject subject{first.cols, first.rows, sequence.camera().outline().value(),
                              sequence.camera(), std::nullopt};
  if (with_lens) {
    const cv::FileStorage file = open_rendered_scene();
    const cv::FileNode n = file["sequences"][name]["camera"];
    subject.lens = optics::Lens::make({first.cols, first.rows, n["fx"].real(), n["fy"].real(),
                                       n["cx"].real() - 0.5, n["cy"].real() - 0.5})
                       .value();
  }
  auto monitor = DriftMonitor::make(subject, {0.3, 0.6}).value();
  EXPECT_TRUE(monitor.refer_to(picture_of_mat(first)));
  std::vector<DriftState> states;
  for (const auto& frame : sequence.frames()) {
    const std::chrono::duration<double> time(static_cast<double>(states.size()) /
                                             sequence.frame_rate());
    states.push_back(monitor
                         .observe(picture_of_mat(read(frame)),
                                  std::chrono::duration_cast<DriftMonitor::Time>(time))
                         .value());
  }
  return states;
}

TEST(RenderedDrift, StandingCamerasRaiseNothing) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  for (const std::string name : {"seq_spark", "seq_thermal"}) {
    for (const DriftState& state : watched(name, false)) {
      EXPECT_EQ(state.level, DriftLevel::Good) << name << ": " << state.reason;
      EXPECT_LT(state.direction_error, 0.03) << name;
    }
  }
}

TEST(RenderedDrift, ABumpIsRaisedAndMeasuredInItsFrame) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  const cv::FileStorage file = open_rendered_scene();
  const cv::FileNode sequence = file["sequences"]["seq_bump"], frames = sequence["frames"];
  const auto bump = static_cast<std::size_t>(static_cast<int>(sequence["bump_frame"]));
  const auto states = watched("seq_bump", true);
  const auto matrix = [&](std::size_t n) {
    const cv::FileNode m = frames[static_cast<int>(n)]["R_wc"];
    return optics::Mat3{scene_vector(m[0]), scene_vector(m[1]), scene_vector(m[2])};
  };
  const Vec3 stands = scene_vector(sequence["camera"]["C"]);
  const Vec3 ball = matrix(0) * ((scene_vector(file["ball"]["centre"]) - stands) *
                                 (1 / file["ball"]["radius"].real()));
  const double truth = true_view_error(sequence["camera"]["fx"].real(), ball, ball,
                                       optics::normalized(scene_vector(sequence["bump_axis_cam"])) *
                                           optics::radians(sequence["bump_deg"].real()));
  std::printf("bump: %.2f deg rms, truth %.2f\n", states.back().direction_error, truth);
  for (std::size_t n = 0; n < bump; ++n) EXPECT_EQ(states[n].level, DriftLevel::Good) << n;
  for (std::size_t n = bump; n < states.size(); ++n) {
    const DriftState& state = states[n];
    EXPECT_EQ(state.level, DriftLevel::Alarm) << n;
    EXPECT_NEAR(state.direction_error, truth, std::max(0.1, 0.03 * truth)) << n;
    EXPECT_EQ(state.cause, align::DriftCause::CameraTurned) << n;
    const cv::FileNode limb = frames[static_cast<int>(n)]["outline"];
    EXPECT_NEAR(state.outline.centre.u, limb["cx"].real() - 0.5, 0.1);
    EXPECT_NEAR(state.outline.centre.v, limb["cy"].real() - 0.5, 0.1);
    EXPECT_NEAR(state.outline.rx, limb["semi_major"].real(), 0.1);
    ASSERT_TRUE(state.turn) << n;
    const optics::Mat3 turn = matrix(n) * optics::transposed(matrix(0));
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      EXPECT_LT(optics::degrees(angle_between(*state.turn * axis, turn * axis)), 0.01) << n;
    }
  }
}

}  // namespace
}  // namespace orbwatch::tests
