// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options/options.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rig.h"

namespace orbwatch::app::cli {

/// Cameras of a command: some of a rig's, or one described by options.
struct CameraOptions {
  std::filesystem::path rig;
  std::vector<std::string> cameras;  ///< arguments: NAME or NAME=IMAGE
  std::optional<optics::BallModel::Kind> model;
  // Description that replaces a rig:
  std::optional<optics::Outline> ball;
  std::optional<double> alpha;
  std::optional<double> distance;
  std::optional<optics::YawPitchRoll> rotation;
};

/// Options of the cameras; they write into `cameras`, which outlives them.
std::vector<Option> camera_options(CameraOptions& cameras);

/// One of the selected cameras.
struct ChosenCamera {
  std::string name;               ///< name in the rig; empty without one
  std::filesystem::path picture;  ///< the image in NAME=IMAGE
  optics::BallProjection ball;
  std::optional<optics::RigCamera> rig_camera;  ///< the camera in the rig, or else:
  std::optional<optics::Outline> outline;       ///< set by --ball
};

/// Returns the cameras in the order given, 1 to remap::kMaxSources. Errors: no camera, too many, a
/// duplicate, an unknown one, --rig together with an option that it replaces, those of load_rig and
/// optics::ball_projection.
CliResult<std::vector<ChosenCamera>> choose_cameras(const CameraOptions& options);

/// Finds the rig's camera of that name. The error lists the existing ones.
Result<optics::RigCamera> find_camera(const optics::Rig& rig, const std::string& name);

}  // namespace orbwatch::app::cli
