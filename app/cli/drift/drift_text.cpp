// SPDX-License-Identifier: Apache-2.0
#include "app/cli/drift/drift_text.h"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "proc/optics/vec.h"

namespace orbwatch::app::cli {
namespace {

using optics::Outline;

/// Motion of the ball's picture, pixels.
struct Shift {
  Shift(const align::PictureMotion& motion, const Outline& stored)
      : u(motion.u),
        v(motion.v),
        stored_radius(optics::mean_radius(stored)),
        radius(motion.growth * stored_radius) {}

  double centre_percent() const { return 100 * std::hypot(u, v) / stored_radius; }
  double radius_percent() const { return 100 * radius / stored_radius; }

  double u, v;
  double stored_radius;
  double radius;
};

std::string event_text(const char* name, const std::optional<DriftRun::Event>& event) {
  if (!event) return "";
  return std::string(name) + "picture " + std::to_string(event->frame + 1) + ", " + event->file +
         "\n";
}

nlohmann::ordered_json event_json(const std::optional<DriftRun::Event>& event) {
  return event ? nlohmann::ordered_json(event->frame) : nlohmann::ordered_json(nullptr);
}

}  // namespace

std::string drift_text(const DriftRun& run, const Outline& stored) {
  const align::DriftState& last = run.last;
  const Shift shift(last.motion, stored);
  std::ostringstream out;
  out << std::fixed << std::setprecision(2);
  out << "state            " << text(last.level)
      << (last.reason.empty() ? "" : ": " + std::string(last.reason)) << "\n"
      << event_text("first warning    ", run.first_warning)
      << event_text("first alarm      ", run.first_alarm);
  out << "measured         " << run.measured << " of " << run.frames << " pictures\n";
  for (const auto& [reason, count] : run.not_measured) {
    out << "                 " << count << " not: " << reason << "\n";
  }
  if (run.measured == 0) return out.str();
  out << "direction error  " << last.direction_error << " deg rms, sigma " << last.direction_sigma
      << "\nball moved by    " << shift.u << ", " << shift.v << " px (" << shift.centre_percent()
      << " % of its radius), radius by " << shift.radius << " px (" << shift.radius_percent()
      << " %)\ncause            " << text(last.cause) << "\n";
  const Outline& o = last.outline;
  out << "\nThe rig file's outline would be\n[camera.outline]\ncentre = [" << o.centre.u << ", "
      << o.centre.v << "]\nradii = [" << o.rx << ", " << o.ry << "]\nangle = " << o.angle << "\n";
  return out.str();
}

std::string drift_json(const DriftRun& run, const Outline& stored) {
  const align::DriftState& last = run.last;
  const Shift shift(last.motion, stored);
  nlohmann::ordered_json json;
  json["frames"] = run.frames;
  json["measured"] = run.measured;
  json["not_measured"] = run.not_measured;
  json["state"] = text(last.level);
  json["reason"] = last.reason;
  json["first_warning_frame"] = event_json(run.first_warning);
  json["first_alarm_frame"] = event_json(run.first_alarm);
  json["shift"] = {{"u", shift.u}, {"v", shift.v}, {"radius", shift.radius}};
  json["shift_percent"] = {{"centre", shift.centre_percent()}, {"radius", shift.radius_percent()}};
  json["roll"] = optics::degrees(std::atan2(last.motion.roll, 1 + last.motion.growth));
  json["direction_error_deg"] = last.direction_error;
  json["direction_sigma_deg"] = last.direction_sigma;
  json["cause"] = text(last.cause);
  json["outline"] = {{"centre", {last.outline.centre.u, last.outline.centre.v}},
                     {"radii", {last.outline.rx, last.outline.ry}},
                     {"angle", last.outline.angle}};
  if (last.turn) {
    json["turn"] = nlohmann::ordered_json::array();
    for (const optics::Vec3& row : {last.turn->row0, last.turn->row1, last.turn->row2}) {
      json["turn"].push_back({row.x, row.y, row.z});
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace orbwatch::app::cli
