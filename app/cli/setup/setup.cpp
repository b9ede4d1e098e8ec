// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/setup.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "app/alignment/found_outline.h"
#include "app/alignment/registration.h"
#include "app/cli/setup/site_files.h"
#include "proc/align/obstacle/standing_box.h"
#include "proc/optics/lens.h"

namespace orbwatch::app::cli {
namespace {

/// A ball centre by tape and one by a pose differ by no more than that, ball radii.
constexpr double kContradiction = 0.5;

/// The name of an obstacle that nobody has stated.
constexpr const char* kFoundBox = "found_box";

/// The ball in a few pictures of a record.
Result<align::BallDetection> detect(const CameraRecord& record) {
  const std::size_t last = record.pictures.size() - 1;
  std::vector<Picture> few{record.pictures.front().picture};
  for (const std::size_t n : {last / 2, last}) {
    if (n > 0) few.push_back(record.pictures[n].picture);
  }
  return surest_ball(few);
}

std::string in_rig(const std::filesystem::path& folder) { return (folder / kRigFile).string(); }

/// Detects in every camera, and drops those without a ball.
Result<> detect_balls(Setup& setup, const std::filesystem::path& folder, Progress& progress) {
  std::vector<SetupCamera> seeing;
  for (SetupCamera& camera : setup.cameras) {
    progress.begin("looking for the ball of " + camera.name);
    const auto ball = detect(camera.record);
    if (!ball) {
      setup.without_ball.push_back(camera.name);
      setup.missing.push_back(camera.name + " is left out: " + ball.error().message);
      continue;
    }
    camera.ball = *ball;
    if (!ball->is_confident()) {
      setup.missing.push_back(camera.name + ": " + doubt_text(*ball) + ". Look at " +
                              (folder / (camera.name + ".png")).string());
    }
    seeing.push_back(std::move(camera));
  }
  setup.cameras = std::move(seeing);
  if (!setup.cameras.empty()) return {};
  return fail("no camera shows a ball: " + setup.missing.front());
}

/// The ball's centre, by a camera whose place is known.
Result<optics::Vec3> ball_centre(const SetupCamera& camera, double ball_radius) {
  if (!camera.lens) {
    return fail(camera.name + ": a pose needs the lens; give --calibration " + camera.name +
                "=FILE");
  }
  const auto lens = optics::Lens::make(*camera.lens);
  if (!lens) return tl::unexpected(lens.error());
  const auto sight = optics::sight_from_outline(camera.ball.outline, *lens);
  if (!sight) return fail(camera.name + ": " + sight.error().message);
  const optics::Vec3 offset = sight->axis * (sight->distance * ball_radius);
  return camera.pose->position + optics::transposed(camera.pose->rotation) * offset;
}

Result<> find_ball(Setup& setup, const std::filesystem::path& folder) {
  const auto placed =
      std::ranges::find_if(setup.cameras, [](const auto& c) { return c.pose.has_value(); });
  if (placed == setup.cameras.end()) {
    setup.missing.push_back("where the cameras stand in the machine; until then views count from " +
                            setup.cameras.front().name + ". orbwatch place --rig " +
                            in_rig(folder) + " --camera " + setup.cameras.front().name +
                            " --point U,V=X,Y,Z ... -o " + in_rig(folder));
    return {};
  }
  const auto centre = ball_centre(*placed, setup.ball_radius);
  if (!centre) return tl::unexpected(centre.error());
  if (!setup.ball_centre) setup.ball_centre = *centre;
  const double apart = optics::norm(*setup.ball_centre - *centre);
  if (apart <= kContradiction * setup.ball_radius) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "%s sees the ball at %.1f, %.1f, %.1f mm, %.1f mm from --ball-centre; one of "
                "pose, centre and diameter is wrong",
                placed->name.c_str(), centre->x, centre->y, centre->z, apart);
  return fail(text);
}

void say_what_lenses_lack(Setup& setup) {
  for (const SetupCamera& camera : setup.cameras) {
    if (camera.lens || camera.distance) continue;
    setup.missing.push_back("how far " + camera.name + " is from the ball; " +
                            std::to_string(static_cast<int>(kAssumedDistance)) +
                            " ball radii are assumed. Give --calibration " + camera.name +
                            "=FILE, or --distance " + camera.name + "=MM by tape");
  }
}

optics::RigCamera rig_camera(const SetupCamera& camera, double ball_radius) {
  optics::RigCamera rig;
  rig.name = camera.name;
  rig.width = camera.record.format.width;
  rig.height = camera.record.format.height;
  rig.intrinsics = camera.lens;
  rig.pose = camera.pose;
  if (camera.pose) return rig;
  rig.outline = camera.ball.outline;
  rig.registration = camera.registration;
  if (!camera.lens) {
    rig.distance = camera.distance ? *camera.distance / ball_radius : kAssumedDistance;
  }
  return rig;
}

/// The pictures of the first camera and another one that are no further apart than half of the
/// slower one's period.
Result<align::SimultaneousPictures> together(const Setup& setup, std::size_t camera) {
  const CameraRecord& first = setup.cameras.front().record;
  const CameraRecord& other = setup.cameras[camera].record;
  const double slower = std::min(first.format.frame_rate, other.format.frame_rate);
  return simultaneous(first.pictures, other.pictures, hal::period_of(slower) / 2);
}

/// Boxes are looked for in a room that the first camera knows.
bool seeks_box(const Setup& setup) { return setup.walls && setup.cameras.front().pose; }

/// Settings of a registration while the scene may lack a box. The outlines are detected ones, to be
/// refined; while a box is sought, they stay: refined, they would take up a part of its parallax.
RegistrationSettings first_settings(const Setup& setup) {
  const bool keeps = seeks_box(setup);
  return {.outline_sigma = keeps ? 0 : kFoundOutlineSigma, .keeps_outline = keeps};
}

/// The registration of a camera to the first one.
Result<align::Registration> registration(const Setup& setup, std::size_t camera,
                                         const RegistrationSettings& settings, Progress& progress) {
  const optics::Rig rig = rig_of(setup);
  const auto pictures = together(setup, camera);
  if (!pictures) return tl::unexpected(pictures.error());
  const align::WorkProgress shown([&](align::WorkStep step, double /*share*/) {
    progress.begin(setup.cameras[camera].name + ": " + std::string(operator_text(step)));
  });
  return register_camera(rig, rig.cameras.front(), rig.cameras[camera], *pictures, settings, shown)
      .map([](const FoundRegistration& found) { return found.found.registration; });
}

/// The outline may be refined along with the rotation: both are needed.
void accept(SetupCamera& camera, const align::Registration& found) {
  camera.registration = found.rotation;
  camera.ball.outline = found.outline;
}

void register_cameras(Setup& setup, const std::filesystem::path& folder, Progress& progress) {
  const std::string first = setup.cameras.front().name;
  for (std::size_t n = 1; n < setup.cameras.size(); ++n) {
    SetupCamera& camera = setup.cameras[n];
    if (camera.pose) continue;
    const auto found = registration(setup, n, first_settings(setup), progress);
    camera.is_registered = found.has_value();
    if (found) {
      accept(camera, *found);
    } else {
      const std::string rig = in_rig(folder);
      std::string& missing = setup.missing.emplace_back("how ");
      missing.append(camera.name).append(" stands to ").append(first).append(": ");
      missing.append(found.error().message).append(". orbwatch register --rig ").append(rig);
      missing.append(" ").append(first).append("=PATH ").append(camera.name).append("=PATH -o ");
      missing.append(rig);
    }
  }
}

/// The box that the first camera and another one prove.
std::optional<optics::Box> found_box(const Setup& setup, std::size_t camera) {
  const optics::Rig rig = rig_of(setup);
  const auto pictures = together(setup, camera);
  const auto first = optics::ball_projection(rig, rig.cameras.front());
  const auto second = optics::ball_projection(rig, rig.cameras[camera]);
  if (!pictures || !first || !second) return std::nullopt;
  const auto found = align::find_standing_box({pictures->reference.front(), *first},
                                              {pictures->camera.front(), *second}, rig.scene);
  if (!found) return std::nullopt;  // the stated scene stands
  return found->box;
}

std::string sentence(const optics::Box& box, const std::string& first, const std::string& second) {
  char text[320];
  std::snprintf(
      text, sizeof text,
      "a box of %.0f x %.0f mm, %.0f mm high, about %.0f, %.0f mm: %s and %s agree better "
      "with it, nobody has measured it",
      box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z,
      (box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2, first.c_str(), second.c_str());
  return text;
}

/// The first box on the floor that cameras prove.
void find_obstacle(Setup& setup, const std::filesystem::path& folder, Progress& progress) {
  const std::string first = setup.cameras.front().name;
  for (std::size_t n = 1; n < setup.cameras.size(); ++n) {
    if (!setup.cameras[n].is_registered && !setup.cameras[n].pose) continue;
    progress.begin("looking for a box on the floor");
    const auto box = found_box(setup, n);
    if (!box) continue;
    const std::string what = sentence(*box, first, setup.cameras[n].name);
    setup.obstacles.push_back({kFoundBox, *box, "found: " + what + "."});
    setup.missing.push_back("whether there is " + what + ". Measure it and correct " + kFoundBox +
                            " in " + in_rig(folder) + ", or give --obstacle");
    break;
  }
}

/// Registers cameras again, in the scene as far as it is known, with their outlines.
void refine_registrations(Setup& setup, Progress& progress) {
  for (std::size_t n = 1; n < setup.cameras.size(); ++n) {
    if (!setup.cameras[n].is_registered) continue;
    const auto again = registration(setup, n, {.outline_sigma = kFoundOutlineSigma}, progress);
    if (again) accept(setup.cameras[n], *again);
  }
}

}  // namespace

bool is_placed(const Setup& setup, const SetupCamera& camera) {
  return camera.is_registered || camera.pose || camera.name == setup.cameras.front().name;
}

std::vector<std::string> left_out(const Setup& setup) {
  std::vector<std::string> names;
  for (const SetupCamera& camera : setup.cameras) {
    if (!is_placed(setup, camera)) names.push_back(camera.name);
  }
  names.insert(names.end(), setup.without_ball.begin(), setup.without_ball.end());
  return names;
}

optics::Rig rig_of(const Setup& setup) {
  optics::Rig rig;
  rig.ball = {setup.ball_centre.value_or(optics::Vec3{}), setup.ball_radius};
  if (setup.walls && setup.ball_centre) {
    rig.scene.room = optics::Scene::Room::Box;
    rig.scene.walls = *setup.walls;
  }
  for (const NamedBox& obstacle : setup.obstacles) rig.scene.obstacles.push_back(obstacle.box);
  for (const SetupCamera& camera : setup.cameras) {
    rig.cameras.push_back(rig_camera(camera, setup.ball_radius));
  }
  return rig;
}

Result<> align_cameras(Setup& setup, const std::filesystem::path& folder, Progress& progress) {
  if (auto found = detect_balls(setup, folder, progress); !found) return found;
  if (auto found = find_ball(setup, folder); !found) return found;
  say_what_lenses_lack(setup);
  register_cameras(setup, folder, progress);
  if (!seeks_box(setup)) return {};
  find_obstacle(setup, folder, progress);
  refine_registrations(setup, progress);
  return {};
}

}  // namespace orbwatch::app::cli
