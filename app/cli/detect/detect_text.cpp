// SPDX-License-Identifier: Apache-2.0
#include "app/cli/detect/detect_text.h"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/alignment/found_outline.h"
#include "proc/optics/vec.h"

namespace orbwatch::app::cli {
namespace {

/// The reflected field of view, degrees.
double alpha(const optics::BallSight& sight) {
  return 360 - 2 * optics::degrees(std::asin(1 / sight.distance));
}

optics::Vec3 centre(const optics::BallSight& sight) { return sight.axis * sight.distance; }

}  // namespace

std::string detect_text(const DetectedBall& ball) {
  const optics::Outline& o = ball.detection.outline;
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << "outline     centre " << o.centre.u << ", "
      << o.centre.v << " px, radii " << o.rx << ", " << o.ry << " px, angle " << o.angle
      << " deg\nconfidence  " << ball.detection.confidence;
  if (!ball.detection.is_confident()) {
    out << ": " << doubt_text(ball.detection) << ".\n            Look at the picture of "
        << "--overlay before you use it";
  }
  out << "\n";
  if (ball.sight) {
    const optics::Vec3 c = centre(*ball.sight);
    out << "ball        centre " << c.x << ", " << c.y << ", " << c.z
        << " ball radii, camera frame; distance " << ball.sight->distance << " ball radii\n"
        << "alpha       " << alpha(*ball.sight) << " deg\n";
  }
  out << "\nFor the rig file:\nwidth = " << ball.width << "\nheight = " << ball.height
      << "\n[camera.outline]\ncentre = [" << o.centre.u << ", " << o.centre.v << "]\nradii = ["
      << o.rx << ", " << o.ry << "]\nangle = " << o.angle << "\n";
  return out.str();
}

std::string detect_json(const DetectedBall& ball) {
  const optics::Outline& o = ball.detection.outline;
  nlohmann::ordered_json json;
  json["picture"] = {{"width", ball.width}, {"height", ball.height}};
  json["outline"] = {
      {"centre", {o.centre.u, o.centre.v}}, {"radii", {o.rx, o.ry}}, {"angle", o.angle}};
  json["confidence"] = ball.detection.confidence;
  json["confident"] = ball.detection.is_confident();
  json["reason"] = ball.detection.reason;
  if (ball.sight) {
    const optics::Vec3 c = centre(*ball.sight);
    json["ball"] = {{"centre", {c.x, c.y, c.z}},
                    {"distance", ball.sight->distance},
                    {"alpha", alpha(*ball.sight)}};
  }
  return json.dump(2) + "\n";
}

}  // namespace orbwatch::app::cli
