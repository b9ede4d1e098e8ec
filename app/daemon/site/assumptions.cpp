// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/assumptions.h"

#include <cstddef>
#include <iomanip>
#include <sstream>

#include "app/model/alignment/register_advice.h"
#include "app/model/status/status.h"

namespace orbwatch::app::daemon {
namespace {

/// Empty: the region states all, or nothing is assumed, for lack of a scene.
std::string assumption_text(const pipeline::RegionOfInterest& stated,
                            const pipeline::RegionPlan& region) {
  const signals::HotSpotLimits& limits = region.settings.hot_spot_limits;
  if (!limits.need_surface()) return "";
  std::ostringstream text;
  text << std::fixed << std::setprecision(1);
  if (!stated.hot_spot_min_area) text << " hot_spot_min_area = " << limits.min_area << " mm2";
  if (!stated.hot_spot_max_speed) {
    text << (text.tellp() > 0 ? " and" : "") << " hot_spot_max_speed = " << limits.max_speed
         << " mm/s";
  }
  if (text.tellp() == 0) return "";
  return "region " + stated.name + ": assumes" + text.str() + "; state what is true of the process";
}

}  // namespace

std::vector<std::string> assumptions(const files::Resolved& site, const SitePlan& plan) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    if (site.rig_camera(i).is_registered) continue;
    std::string line = site.site.rig.path.string() + ": camera " + site.names.cameras[i] + ": is ";
    line += operator_text(AlignmentLevel::NotRegistered);
    lines.push_back(line.append("; ").append(kRegisterAdvice));
  }
  for (std::size_t i = 0; i < plan.recipes.size(); ++i) {
    for (std::size_t k = 0; k < plan.recipes[i].regions.size(); ++k) {
      const auto text = assumption_text(site.recipes[i].regions[k], plan.recipes[i].regions[k]);
      if (!text.empty()) lines.push_back(in_recipe(site, i, {text}).message);
    }
  }
  return lines;
}

}  // namespace orbwatch::app::daemon
