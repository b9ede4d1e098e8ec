// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/setup_text.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/files/runtime/site_file.h"

namespace orbwatch::app::cli {
namespace {

const char* state_of(const Setup& setup, const SetupCamera& camera) {
  if (camera.is_registered) return ", registered";
  return is_placed(setup, camera) ? "" : ", not registered: left out of merged and measured views";
}

std::string degrees_text(double degrees) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", degrees);
  return text;
}

/// Command that runs the site. Beside an installed service a second orbwatchd would be refused: the
/// service holds state, ports and cameras.
std::string next_step(const std::filesystem::path& site) {
  const std::filesystem::path installed = files::site_file({});
  std::error_code unknown;
  const bool is_beside = std::filesystem::exists(installed, unknown) &&
                         !std::filesystem::equivalent(installed, site, unknown);
  return is_beside ? "; try it: sudo orbwatch configure " + site.string()
                   : ": run orbwatchd --config " + site.string();
}

}  // namespace

std::string setup_text(const Setup& setup, const std::filesystem::path& site) {
  std::string text;
  for (const SetupCamera& camera : setup.cameras) {
    char line[200];
    const optics::Outline& limb = camera.ball.outline;
    std::snprintf(line, sizeof line,
                  "%-12s ball at %.1f, %.1f px, radius %.1f px, confidence %.2f%s\n",
                  camera.name.c_str(), limb.centre.u, limb.centre.v, optics::mean_radius(limb),
                  camera.ball.confidence, state_of(setup, camera));
    text += line;
    if (camera.pose_change > 0) {
      text += camera.name + ": the matrix of --pose is rounded; its axes were turned by up to " +
              degrees_text(camera.pose_change) + " deg, to the nearest rotation\n";
    }
  }
  for (const std::string& sentence : setup.missing) text += "missing: " + sentence + "\n";
  const bool is_whole = left_out(setup).empty();
  return text +
         (is_whole ? "written and checked" : "written and checked, without what is missing") +
         next_step(site) + "\n";
}

std::string setup_json(const Setup& setup, const std::filesystem::path& site) {
  using Json = nlohmann::ordered_json;
  Json json{{"site", site.string()},
            {"cameras", Json::array()},
            {"left_out", left_out(setup)},
            {"missing", setup.missing}};
  for (const SetupCamera& camera : setup.cameras) {
    const optics::Outline& limb = camera.ball.outline;
    json["cameras"].push_back({{"name", camera.name},
                               {"outline",
                                {{"centre", {limb.centre.u, limb.centre.v}},
                                 {"radii", {limb.rx, limb.ry}},
                                 {"angle", limb.angle}}},
                               {"confidence", camera.ball.confidence},
                               {"registered", camera.is_registered},
                               {"pose_change", camera.pose_change}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orbwatch::app::cli
