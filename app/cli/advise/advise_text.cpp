// SPDX-License-Identifier: Apache-2.0
#include "app/cli/advise/advise_text.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "app/cli/text_table.h"

namespace orbwatch::app::cli {

std::string advise_text(const align::Arrangement& arrangement, const align::Advice& a) {
  std::string out;
  out += "alpha            " + fixed_text(a.alpha, 2) + " deg, the reflected field of view\n";
  out += "ball             " + fixed_text(a.ball_pixels, 0) + " px radius, " +
         fixed_text(100 * a.fill, 0) + " % of the picture's short side\n";
  out += "depth of field   " + fixed_text(a.depth_of_field, 1) + " mm, focused at " +
         fixed_text(a.focus, 1) + " mm: f/" + fixed_text(a.f_number, 1) + " or more, below f/" +
         fixed_text(a.diffraction_f_number, 1) + "\n";
  out += "\nA target " + fixed_text(arrangement.target_distance, 0) +
         " mm from the ball's centre, by its angle from the camera as the ball sees them:\n";
  std::vector<Fields> rows;
  for (const align::TargetSight& sight : a.sights) {
    rows.push_back({{"angle_deg", fixed_text(sight.phi, 0)},
                    {"px_per_deg", fixed_text(sight.pixels_per_degree, 2)},
                    {"px_per_mm", fixed_text(sight.pixels_per_mm, 3)},
                    {"smallest_mm", fixed_text(sight.smallest, 2)},
                    {"parallax_deg", fixed_text(sight.parallax, 2)}});
  }
  out += record_lines(rows);
  out += "Smallest: " + fixed_text(align::kMeasuredPixels, 0) +
         " pixels across. Parallax: the error without a scene in the rig file.\n\n";
  if (a.changes.empty()) return out + "Nothing to change.\n";
  for (const std::string& change : a.changes) out += "Change: " + change + ".\n";
  return out;
}

std::string advise_json(const align::Advice& a) {
  nlohmann::ordered_json json{{"alpha", a.alpha},
                              {"ball_pixels", a.ball_pixels},
                              {"fill", a.fill},
                              {"focus", a.focus},
                              {"depth_of_field", a.depth_of_field},
                              {"f_number", a.f_number},
                              {"diffraction_f_number", a.diffraction_f_number},
                              {"sights", nlohmann::ordered_json::array()},
                              {"changes", a.changes}};
  for (const align::TargetSight& sight : a.sights) {
    json["sights"].push_back({{"phi", sight.phi},
                              {"pixels_per_degree", sight.pixels_per_degree},
                              {"pixels_per_mm", sight.pixels_per_mm},
                              {"smallest", sight.smallest},
                              {"parallax", sight.parallax}});
  }
  return json.dump(2) + "\n";
}

}  // namespace orbwatch::app::cli
