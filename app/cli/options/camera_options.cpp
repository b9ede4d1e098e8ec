// SPDX-License-Identifier: Apache-2.0
#include "app/cli/options/camera_options.h"

#include <algorithm>

#include "app/files/rig/rig_file.h"
#include "app/model/alignment/register_advice.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::cli {
namespace {

Result<> set_ball(const std::string& value, std::optional<optics::Outline>& ball) {
  const auto n = parse_numbers("ball", value);
  if (!n) return tl::unexpected(n.error());
  if (n->size() == 3) {
    ball = optics::Outline{{(*n)[0], (*n)[1]}, (*n)[2], (*n)[2], 0};
  } else if (n->size() == 5) {
    ball = optics::Outline{{(*n)[0], (*n)[1]}, (*n)[2], (*n)[3], (*n)[4]};
  } else {
    return fail("--ball is \"" + value + "\"; it must be CX,CY,R or CX,CY,RX,RY,ANGLE");
  }
  return {};
}

Result<> set_rotation(const std::string& value, std::optional<optics::YawPitchRoll>& rotation) {
  const auto n = parse_numbers("rotation", value);
  if (!n) return tl::unexpected(n.error());
  if (n->size() != 3) return fail("--rotation is \"" + value + "\"; it must be YAW,PITCH,ROLL");
  rotation = optics::YawPitchRoll{(*n)[0], (*n)[1], (*n)[2]};
  return {};
}

/// Parsed NAME or NAME=IMAGE.
struct Named {
  explicit Named(const std::string& text)
      : name(text.substr(0, text.find('='))),
        picture(name.size() < text.size() ? text.substr(name.size() + 1) : "") {}
  std::string name;
  std::string picture;
};

CliResult<> check_choice(const std::vector<std::string>& cameras) {
  if (cameras.empty()) return usage_error("--rig needs at least one --camera");
  if (cameras.size() > remap::kMaxSources) {
    return usage_error(std::to_string(cameras.size()) + " cameras are given; at most " +
                       std::to_string(remap::kMaxSources) + " are merged");
  }
  for (auto it = cameras.begin(); it != cameras.end(); ++it) {
    const std::string name = Named(*it).name;
    if (std::any_of(cameras.begin(), it, [&](const auto& c) { return Named(c).name == name; })) {
      return usage_error("camera " + name + " is given twice");
    }
  }
  return {};
}

/// An orthographic model takes no distance, even if the rig states one.
void replace_model(optics::BallModel::Kind model, optics::RigCamera& camera) {
  camera.model = model;
  if (!optics::law(model).is_orthographic) return;
  camera.alpha.reset();
  camera.distance.reset();
}

CliResult<std::vector<ChosenCamera>> choose_from_rig(const CameraOptions& o) {
  for (const auto& [given, name] : {std::pair{o.ball.has_value(), "--ball"},
                                    {o.alpha.has_value(), "--alpha"},
                                    {o.distance.has_value(), "--distance"},
                                    {o.rotation.has_value(), "--rotation"}}) {
    if (given)
      return usage_error("--rig and " + std::string(name) + " are given; the rig states it");
  }
  if (auto good = check_choice(o.cameras); !good) return tl::unexpected(good.error());
  const auto rig = files::load_rig(o.rig);
  if (!rig) return tl::unexpected(rig.error());
  std::vector<ChosenCamera> chosen;
  for (const std::string& text : o.cameras) {
    const Named named(text);
    auto camera = find_camera(*rig, named.name);
    if (!camera) return fail(o.rig.string() + ": " + camera.error().message);
    if (o.cameras.size() > 1 && !camera->is_registered) {
      return fail(o.rig.string() + ": camera " + camera->name +
                  " is not registered, and cannot be merged with others; " +
                  std::string(kRegisterAdvice));
    }
    if (o.model) replace_model(*o.model, *camera);
    auto ball = optics::ball_projection(*rig, *camera);
    if (!ball) return fail(o.rig.string() + ": " + ball.error().message);
    chosen.push_back(
        {named.name, named.picture, std::move(*ball), std::move(*camera), std::nullopt});
  }
  return chosen;
}

CliResult<std::vector<ChosenCamera>> choose_described(const CameraOptions& o) {
  if (!o.cameras.empty()) return usage_error("--camera needs --rig");
  if (!o.ball) return usage_error("--ball is missing (or --rig)");
  const auto kind = o.model.value_or(optics::BallModel::Kind::Exact);
  const auto model = optics::BallModel::make(kind, o.alpha, o.distance);
  if (!model) return tl::unexpected(model.error());
  const auto rotation = optics::rotation(o.rotation.value_or(optics::YawPitchRoll{}));
  auto ball = optics::BallProjection::make(*model, *o.ball, rotation);
  if (!ball) return tl::unexpected(ball.error());
  return std::vector<ChosenCamera>{{"", {}, std::move(*ball), std::nullopt, o.ball}};
}

std::string model_help() {
  std::string text = "law of reflection, instead of the rig's:";
  for (const auto& model : optics::kBallModels) {
    text += "\n" + std::string(model.name) + ": " + std::string(optics::law(model.value).text);
  }
  return text;
}

}  // namespace

std::vector<Option> camera_options(CameraOptions& o) {
  return {
      {"rig", 0, "RIG", "file that describes cameras, ball and machine;\nsee orbwatch describe rig",
       text_option(o.rig)},
      {"camera", 0, "NAME[=IMAGE]", "one of the rig's cameras, and its picture;\nmay be repeated",
       list_option(o.cameras)},
      {"ball", 0, "CX,CY,R | CX,CY,RX,RY,ANGLE",
       "without a rig: limb of the ball in the picture, pixels\n(centres at integers); ANGLE in "
       "degrees turns RX from\nright to down",
       [&o](const std::string& v) { return set_ball(v, o.ball); }},
      {"alpha", 0, "DEG",
       "reflected field of view, above 180 to 360:\n360 minus the ball's apparent diameter",
       number_option("alpha", o.alpha)},
      {"distance", 0, "RADII", "camera to ball's centre in ball radii, above 1",
       number_option("distance", o.distance)},
      {"rotation", 0, "YAW,PITCH,ROLL",
       "registration: turns the ball's picture into the\nreference frame",
       [&o](const std::string& v) { return set_rotation(v, o.rotation); }},
      {"model", 0, "MODEL", model_help(), word_option("model", optics::kBallModels, o.model)},
  };
}

CliResult<std::vector<ChosenCamera>> choose_cameras(const CameraOptions& options) {
  return options.rig.empty() ? choose_described(options) : choose_from_rig(options);
}

Result<optics::RigCamera> find_camera(const optics::Rig& rig, const std::string& name) {
  std::string known;
  for (const optics::RigCamera& camera : rig.cameras) {
    if (camera.name == name) return camera;
    known += (known.empty() ? "" : ", ") + camera.name;
  }
  return fail("there is no camera " + name + "; there are " + known);
}

}  // namespace orbwatch::app::cli
