#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Which cameras a command is about: some of a rig's, or the one that its options describe.
struct CameraOptions {
  std::filesystem::path rig;
  std::vector<std::string> cameras;  ///< as given: NAME or NAME=IMAGE
  std::optional<optics::BallModel::Kind> model;
  // Instead of a rig:
  std::optional<optics::Outline> ball;
  std::optional<double> alpha;
  std::optional<double> distance;
  std::optional<optics::YawPitchRoll> rotation;
};

/// The options themselves; they write into `cameras`, which must live as long.
std::vector<Option> camera_options(CameraOptions& cameras);

/// One of the cameras.
struct ChosenCamera {
  std::string name;               ///< as the rig has it; empty without one
  std::filesystem::path picture;  ///< what stood behind NAME=
  optics::BallProjection ball;
  std::optional<Size> size;                ///< of its pictures, if the rig states it
  std::optional<optics::Outline> outline;  ///< as --ball states it
};

/// The cameras in the order given, 1 to remap::kMaxSources. Errors: no camera, too many, one twice,
/// one that the rig lacks, --rig beside an option that says the same, what load_rig and
/// optics::ball_projection refuse.
Result<std::vector<ChosenCamera>> choose_cameras(const CameraOptions& options);

/// Refuses a picture that `camera` cannot have taken: not of the rig's size, or without the ball.
Result<> check_picture_size(const ChosenCamera& camera, const Size& picture);

/// The rig's camera of that name. Error: names those that it has.
Result<optics::RigCamera> find_camera(const optics::Rig& rig, const std::string& name);

}  // namespace orbwatch::app
