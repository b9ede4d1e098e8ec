// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <string>

#include "app/files/resolve.h"
#include "app/files/runtime/calibration_file.h"
#include "app/files/runtime/trial.h"
#include "app/model/command/command.h"
#include "app/model/status/status.h"
#include "hal/replay/picture_folder.h"
#include "proc/optics/rotation.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/proc/align/detect/painted_ball.h"
#include "tests/proc/align/place/mirrored_rig.h"

/// Alignments commanded by a PLC, on a recording of a ball.
namespace orbwatch::tests {
namespace {

using app::CommandCode;
using app::CommandResult;
using app::OutlineState;
using app::ProposalState;
using app::WatchLevel;

/// Rig with one camera; its outline is 2 px beside the ball, which passes for aligned.
const std::string kRecordingRig = R"(
[[camera]]
name = "colour"
width = 400
height = 320
[camera.outline]
centre = [204.3, 161.7]
radius = 115
distance = 12
)";

const std::string kRecordingRecipe = R"(
name = "front"
[[view]]
name = "front"
measured = "colour"
width = 64
height = 48
[[view.source]]
camera = "colour"
[[region]]
name = "front"
view = "front"
hot_spot_threshold = 95
)";

class AlignmentCommands : public Daemon {
 protected:
  std::string site(const std::string& watch = "") {
    std::filesystem::create_directory(folder / "pictures");
    show({{202.3, 161.7}, 115, 115, 0});
    return write_config(
        "[[camera]]\nname = \"colour\"\nback_end = \"replay\"\nframe_rate = 10\n"
        "[camera.replay]\nsource = \"pictures\"\n[camera.watch]\n" +
            watch,
        kRecordingRig, kRecordingRecipe);
  }
  void show(const optics::Outline& limb) {
    cv::imwrite((folder / "pictures" / "0.png").string(), align::painted_ball({400, 320}, limb));
  }
  bool proposes(Subprocess& daemon, ProposalState state) {
    return eventually(daemon, [&] { return read("camera_0_proposal") == static_cast<int>(state); });
  }
};

TEST_F(AlignmentCommands, AFoundBallIsAcceptedAndCountsAfterARestart) {
  Subprocess daemon = start(site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::DetectBall, {1}), CommandResult::ArgumentOutOfRange);
  ASSERT_EQ(command(daemon, CommandCode::DetectBall, {0}), CommandResult::Done);
  ASSERT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
  EXPECT_TRUE(proposes(daemon, ProposalState::None)) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] {
    return read("camera_0_alignment") == static_cast<int>(WatchLevel::Good);
  })) << daemon.output();
}

TEST_F(AlignmentCommands, AProposalCanBeDiscarded) {
  Subprocess daemon = start(site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::DiscardAlignment, {0}), CommandResult::NotPossible);
  ASSERT_EQ(command(daemon, CommandCode::DetectBall, {0}), CommandResult::Done);
  ASSERT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::DiscardAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(proposes(daemon, ProposalState::None)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::NotPossible);
}

/// The result Done would be wrong: the restart that applies the alignment is refused.
TEST_F(AlignmentCommands, IsNotAcceptedWhileTheFilesAreWrong) {
  Subprocess daemon = start(site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::MoveOutline, {0, 20225, 16175}), CommandResult::Done);
  std::ofstream(folder / "recipe.toml") << "is no TOML";
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::NotPossible);
  EXPECT_TRUE(says(daemon, "not accepted: ")) << daemon.output();
  EXPECT_TRUE(proposes(daemon, ProposalState::Ready)) << "it is not lost";
  EXPECT_FALSE(std::filesystem::exists(app::files::calibration_file(folder / state_folder)));
  std::ofstream(folder / "recipe.toml") << kRecordingRecipe;
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
}

TEST_F(AlignmentCommands, AnOutlineIsStatedByHandTakenBackAndReverted) {
  Subprocess daemon = start(site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::UndoAlignment, {0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::RevertAlignment, {0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::MoveOutline, {1, 20000, 16000}),
            CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(command(daemon, CommandCode::MoveOutline, {0, 90000, 16000}),
            CommandResult::ArgumentOutOfRange)
      << "outside of the picture";
  ASSERT_EQ(command(daemon, CommandCode::MoveOutline, {0, 20225, 16175}), CommandResult::Done);
  ASSERT_EQ(command(daemon, CommandCode::ShapeOutline, {0, 11450, 11350, 3000}),
            CommandResult::Done);
  ASSERT_EQ(command(daemon, CommandCode::TurnCamera, {0, 50, 0, 0}), CommandResult::Done);
  ASSERT_EQ(command(daemon, CommandCode::TurnCamera, {0, 0, 5000, 0}), CommandResult::Done);
  ASSERT_EQ(command(daemon, CommandCode::UndoAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
  const auto accepted = app::files::resolve((folder / "site.toml").string());
  ASSERT_TRUE(accepted) << accepted.error().message;
  const optics::RigCamera& camera = accepted->rig.cameras.front();
  EXPECT_NEAR(camera.outline->centre.u, 202.25, 1e-9);
  EXPECT_NEAR(camera.outline->ry, 113.5, 1e-9);
  EXPECT_NEAR(camera.outline->angle, 30, 1e-9);
  EXPECT_NEAR(optics::yaw_pitch_roll(camera.registration).yaw, 0.05, 1e-9);
  EXPECT_NEAR(optics::yaw_pitch_roll(camera.registration).pitch, 0, 1e-9);

  ASSERT_TRUE(proposes(daemon, ProposalState::None)) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::RevertAlignment, {0}), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "camera colour: alignment 2 of ")) << daemon.output();
  const auto reverted = app::files::resolve((folder / "site.toml").string());
  ASSERT_TRUE(reverted) << reverted.error().message;
  EXPECT_NEAR(reverted->rig.cameras.front().outline->centre.u, 204.3, 1e-9);
  ASSERT_EQ(command(daemon, CommandCode::RevertAlignment, {0}), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "restored 1: turned by hand")) << daemon.output();
}

/// Edits the rig file while the daemon runs.
class AlignmentOfAnotherRig : public AlignmentCommands {
 protected:
  void propose(Subprocess& daemon) {
    ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
    ASSERT_EQ(command(daemon, CommandCode::MoveOutline, {0, 20225, 16175}), CommandResult::Done);
    ASSERT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  }
  std::vector<app::CalibrationEntry> accepted() const {
    app::files::TextFiles files;
    return app::files::load_calibrations(app::files::calibration_file(folder / state_folder), files)
        .value();
  }
  static std::string moved_rig() {
    std::string rig = kRecordingRig;
    return rig.replace(rig.find("204.3"), 5, "190.0");
  }
};

TEST_F(AlignmentOfAnotherRig, IsNotAcceptedAfterTheRigFileWasEdited) {
  Subprocess daemon = start(site());
  propose(daemon);
  std::ofstream(folder / "rig.toml") << moved_rig();
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::NotPossible);
  EXPECT_TRUE(says(daemon, "the rig was changed since the start")) << daemon.output();
  EXPECT_TRUE(accepted().empty());
  EXPECT_TRUE(proposes(daemon, ProposalState::Ready)) << "it waits for the rig that it is for";
  std::ofstream(folder / "rig.toml") << kRecordingRig;
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
}

TEST_F(AlignmentOfAnotherRig, IsNotAcceptedInATrial) {
  ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
  const std::string config = site();
  const app::files::Trial trial{config, {{folder / "rig.toml", moved_rig()}}, 3600};
  ASSERT_TRUE(app::files::request_trial(folder.path(), trial));
  Subprocess daemon = start(config);
  ::unsetenv("STATE_DIRECTORY");
  propose(daemon);
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::NotPossible);
  EXPECT_TRUE(says(daemon, "a new configuration is on trial")) << daemon.output();
  EXPECT_TRUE(accepted().empty());
  ASSERT_TRUE(app::files::confirm_trial(folder.path()));
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
}

TEST_F(AlignmentOfAnotherRig, IsNotAcceptedWhileTheLastGoodConfigurationRuns) {
  ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
  const std::string config = site();
  {
    Subprocess daemon = start(config);
    propose(daemon);
    ASSERT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
    ASSERT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
  }
  std::ofstream(folder / "rig.toml") << "nonsense = ";
  Subprocess daemon = start(config);
  ::unsetenv("STATE_DIRECTORY");
  propose(daemon);
  EXPECT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::NotPossible);
  EXPECT_TRUE(says(daemon, "cannot restart with its files")) << daemon.output();
  EXPECT_EQ(accepted().size(), 1U) << "the one that counts";
}

/// Calibrated camera in front of the ball, around which a tool moves a lamp. The rig has the ball's
/// outline; the position of the camera is unknown.
class PlacementCommands : public AlignmentCommands {
 protected:
  PlacementCommands() {
    machine.centre = {120, 60, 430};
    machine.radius = 50;
    const optics::Vec3 forward = optics::normalized({-0.2, 1, -0.1});
    const optics::Vec3 right = optics::normalized(cross(forward, {0, 0, 1}));
    RigCamera camera;
    camera.focal = 115 * std::sqrt(12 * 12 - 1.0);
    camera.width = 400;
    camera.height = 320;
    camera.pose = {{right, cross(forward, right), forward}, machine.centre - forward * 600};
    machine.cameras = {camera};
    machine.points = {{-180, -100, 300}, {420, -140, 260}, {60, -300, 640},
                      {380, 100, 700},   {-150, 40, 600},  {150, -260, 200}};
  }

  std::string placement_site() {
    const RigCamera& camera = machine.cameras.front();
    limb = limb_of(camera, machine.centre, machine.radius);
    std::ostringstream rig;
    rig.precision(10);
    rig << "[ball]\ncentre = [120, 60, 430]\nradius = 50\n[[camera]]\nname = \"colour\"\n"
        << "width = 400\nheight = 320\n[camera.intrinsics]\nfx = " << camera.focal
        << "\nfy = " << camera.focal << "\ncx = 199.5\ncy = 159.5\n[camera.outline]\ncentre = ["
        << limb.centre.u << ", " << limb.centre.v << "]\nradii = [" << limb.rx << ", " << limb.ry
        << "]\nangle = " << limb.angle << "\n";
    show_lamp({});
    // Enough pictures that the recording reads each one anew.
    std::filesystem::create_directory(folder / "pictures");
    for (std::size_t n = 0; n <= hal::kKeptFolderBytes / (400 * 320); ++n) {
      std::filesystem::create_symlink(folder / "shown.png",
                                      folder / "pictures" / (std::to_string(n) + ".png"));
    }
    return write_config(
        "[place]\nsigma_px = 0.5\n[[camera]]\nname = \"colour\"\nback_end = \"replay\"\n"
        "frame_rate = 20\n[camera.replay]\nsource = \"pictures\"\n",
        rig.str(), kRecordingRecipe);
  }

  /// Writes pictures with the lamp at the image of that point, and a brighter one at a fixed place.
  void show_lamp(const std::optional<optics::Vec3>& point) {
    cv::Mat picture = align::painted_ball({400, 320}, {limb.centre, limb.rx, limb.ry, limb.angle});
    picture = picture / 3;
    add_light(picture, {limb.centre.u + 30, limb.centre.v - 35}, 250, 2.5);
    if (point) {
      add_light(picture, seen_at(machine.cameras.front(), machine.centre, machine.radius, *point),
                160, 1.5);
    }
    // The daemon may read it at any moment.
    cv::imwrite((folder / "new.png").string(), picture);
    std::filesystem::rename(folder / "new.png", folder / "shown.png");
  }
  static void add_light(cv::Mat& picture, const optics::Vec2& at, double light, double sigma) {
    for (int v = 0; v < picture.rows; ++v) {
      for (int u = 0; u < picture.cols; ++u) {
        const double square = std::pow(u - at.u, 2) + std::pow(v - at.v, 2);
        auto& pixel = picture.at<std::uint8_t>(v, u);
        pixel = cv::saturate_cast<std::uint8_t>(pixel +
                                                light * std::exp(-square / (2 * sigma * sigma)));
      }
    }
  }

  /// Arguments of mark_point: thousandths of mm.
  static std::vector<std::int32_t> at(const optics::Vec3& p) {
    const auto scaled = [](double mm) { return static_cast<std::int32_t>(std::lround(mm * 1000)); };
    return {0, scaled(p.x), scaled(p.y), scaled(p.z)};
  }
  /// Moves the lamp there and marks it; again where a busy machine delivered no picture in time.
  bool mark(Subprocess& daemon, const optics::Vec3& point) {
    const auto points = read("camera_0_marked_points"), frames = read("camera_0_frames");
    // The figures may still be those before the command: marking a point twice replaces it.
    const auto is_marked = [&] { return read("camera_0_marked_points") == points + 1; };
    const auto is_refused = [&] {
      return read("camera_0_proposal") == static_cast<int>(ProposalState::Refused);
    };
    show_lamp(point);
    return eventually(daemon, [&] { return read("camera_0_frames") > frames + 2; }) &&
           eventually(daemon, [&] {
             const auto given = command(daemon, CommandCode::MarkPoint, at(point));
             return (given == CommandResult::Done || given == CommandResult::Busy) &&
                    eventually(daemon, [&] { return is_marked() || is_refused(); }) && is_marked();
           });
  }

  MirroredRig machine;
  SeenLimb limb;
};

TEST_F(PlacementCommands, ACameraIsPlacedByALampThatTheMachineMoves) {
  Subprocess daemon = start(placement_site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::PlaceCamera, {0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::ForgetPoints, {0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::MarkPoint, {0, 100'000'001, 0, 0}),
            CommandResult::ArgumentOutOfRange);
  for (const optics::Vec3& point : machine.points) {
    ASSERT_TRUE(mark(daemon, point)) << daemon.output();
  }
  // The lamp is off, and the remaining light does not count as a point.
  show_lamp({});
  const auto frames = read("camera_0_frames");
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > frames + 2; }));
  ASSERT_EQ(command(daemon, CommandCode::MarkPoint, at({0, 0, 0})), CommandResult::Done);
  ASSERT_TRUE(proposes(daemon, ProposalState::Refused)) << daemon.output();
  EXPECT_TRUE(says(daemon, "no light has moved to (0, 0, 0 mm)")) << daemon.output();

  ASSERT_EQ(command(daemon, CommandCode::PlaceCamera, {0}), CommandResult::Done);
  ASSERT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  const auto error = read("camera_0_proposal_error");  // thousandths of degrees
  EXPECT_GT(error, 10);
  EXPECT_LT(error, 1500);
  EXPECT_TRUE(says(daemon, "marked minus shown: (-180, -100, 300 mm)")) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
  EXPECT_TRUE(says(daemon, "place by 6 points")) << daemon.output();
  const auto site = app::files::resolve((folder / "site.toml").string());
  ASSERT_TRUE(site) << site.error().message;
  const optics::RigCamera& placed = site->rig.cameras.front();
  ASSERT_TRUE(placed.pose);
  const optics::Pose& truth = machine.cameras.front().pose;
  EXPECT_LT(norm(placed.pose->position - truth.position), 10);
  EXPECT_GT(dot(placed.pose->rotation.row2, truth.rotation.row2), std::cos(0.02));
  EXPECT_GT(dot(placed.pose->rotation.row0, truth.rotation.row0), std::cos(0.02));
}

TEST_F(PlacementCommands, ACameraIsPlacedByPointsThatSomebodyPicked) {
  Subprocess daemon = start(placement_site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::PickPixel, {0, 100, 100}),
            CommandResult::ArgumentOutOfRange)
      << "beside the ball";
  std::uint64_t marked = 0;
  for (const optics::Vec3& point : machine.points) {
    const auto seen = seen_at(machine.cameras.front(), machine.centre, machine.radius, point);
    const auto scaled = [](double px) { return static_cast<std::int32_t>(std::lround(px * 100)); };
    ASSERT_EQ(command(daemon, CommandCode::PickPixel, {0, scaled(seen.u), scaled(seen.v)}),
              CommandResult::Done);
    ASSERT_EQ(command(daemon, CommandCode::MarkPoint, at(point)), CommandResult::Done);
    ++marked;
    ASSERT_TRUE(eventually(daemon, [&] {
      return read("camera_0_marked_points") == static_cast<std::int64_t>(marked) &&
             read("camera_0_proposal") == static_cast<int>(ProposalState::None);
    })) << daemon.output();
  }
  ASSERT_EQ(command(daemon, CommandCode::PlaceCamera, {0}), CommandResult::Done);
  ASSERT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "place by 6 points")) << daemon.output();
  const auto site = app::files::resolve((folder / "site.toml").string());
  ASSERT_TRUE(site) << site.error().message;
  ASSERT_TRUE(site->rig.cameras.front().pose);
  EXPECT_LT(norm(site->rig.cameras.front().pose->position - machine.cameras.front().pose.position),
            2);
}

TEST_F(AlignmentCommands, TheFirstCameraIsRegisteredToNone) {
  Subprocess daemon = start(site());
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") > 2; })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::RegisterCamera, {0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::LearnCleanBall, {0}), CommandResult::Done);
  EXPECT_EQ(command(daemon, CommandCode::LearnCleanBall, {3}), CommandResult::ArgumentOutOfRange);
}

TEST_F(AlignmentCommands, ADriftIsAnAlarmAndBecomesTheAlignment) {
  const std::string config = site();
  {
    Subprocess daemon = start(config);
    ASSERT_TRUE(eventually(daemon, [&] {
      return read("camera_0_alignment") == static_cast<int>(WatchLevel::Good);
    })) << daemon.output();
    EXPECT_TRUE(eventually(daemon, [&] {
      return read("camera_0_outline_check") == static_cast<int>(OutlineState::Aligned);
    })) << daemon.output();
  }
  show({{206.3, 161.7}, 115, 115, 0});  // while the lamp is off
  Subprocess daemon = start(config);
  ASSERT_TRUE(eventually(daemon, [&] {
    return read("camera_0_alignment") == static_cast<int>(WatchLevel::Alarm);
  })) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::CorrectAlignment, {0}), CommandResult::Done);
  ASSERT_TRUE(proposes(daemon, ProposalState::Ready)) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::AcceptAlignment, {0}), CommandResult::Done);
  EXPECT_TRUE(eventually(daemon, [&] {
    return read("camera_0_alignment") == static_cast<int>(WatchLevel::Good);
  })) << daemon.output();
}

TEST_F(AlignmentCommands, ALastingDriftIsCorrectedWhereThatIsConfigured) {
  const std::string config = site("correct = true\n");
  {
    Subprocess daemon = start(config);
    ASSERT_TRUE(eventually(daemon, [&] {
      return read("camera_0_alignment") == static_cast<int>(WatchLevel::Good);
    })) << daemon.output();
  }
  show({{206.3, 161.7}, 115, 115, 0});
  Subprocess daemon = start(config);
  EXPECT_TRUE(says(daemon, "camera colour: alignment 1 of ")) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] {
    return read("camera_0_alignment") == static_cast<int>(WatchLevel::Good);
  })) << daemon.output();
}

}  // namespace
}  // namespace orbwatch::tests
