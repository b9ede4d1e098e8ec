// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/progress.h"
#include "app/cli/setup/connected_camera.h"
#include "app/cli/setup/recording.h"
#include "proc/align/detect/ball_detector.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app::cli {

/// A camera on its way into a rig.
struct SetupCamera {
  std::string name;
  files::BackEndSettings back_end;
  std::filesystem::path calibration;  ///< empty: none
  std::optional<optics::Intrinsics> lens;
  std::optional<optics::Pose> pose;
  double pose_change = 0;          ///< largest angle between its axes and those stated, degrees
  std::optional<double> distance;  ///< camera to the ball's centre, mm
  CameraRecord record;

  // Found out.
  align::BallDetection ball;
  optics::Mat3 registration;
  bool is_registered = false;
};

/// Boxes within the machine, by name.
struct NamedBox {
  std::string name;
  optics::Box box;
  std::string remark;  ///< for people; empty: as stated
};

/// Computers to which the site's page is served.
enum class PageClients {
  None,
  Loopback,  ///< this computer only
  Network    ///< others too, over HTTPS, which see nothing until a password is set
};

/// A site in the making: stated facts, found ones, and missing ones.
struct Setup {
  double ball_radius = 0;  ///< mm
  std::optional<optics::Vec3> ball_centre;
  std::optional<optics::Box> walls;
  std::vector<NamedBox> obstacles;
  PageClients page = PageClients::Loopback;
  std::vector<SetupCamera> cameras;       ///< the first one is what others are registered to
  std::vector<std::string> without_ball;  ///< names of cameras that were dropped
  std::vector<std::string> missing;  ///< sentences for people, each with the command that adds it
};

/// True: it is known how a camera of the setup stands to the first one. Else it is left out of
/// merged and measured views.
bool is_placed(const Setup& setup, const SetupCamera& camera);

/// Names of the cameras that are not placed, then of those without a ball.
std::vector<std::string> left_out(const Setup& setup);

/// Assumed distance of a camera without lens and distance, ball radii.
inline constexpr double kAssumedDistance = 12;

/// The rig as far as it is known.
optics::Rig rig_of(const Setup& setup);

/// Finds the ball in every camera's pictures, the ball in the machine by the first camera's pose,
/// registers the others to the first one, and looks for a box on the floor that is not stated.
/// Cameras without a ball are left out. `folder`: the site's, for the commands in `missing`. Error:
/// no camera shows a ball, or what is known contradicts itself.
Result<> align_cameras(Setup& setup, const std::filesystem::path& folder, Progress& progress);

}  // namespace orbwatch::app::cli
