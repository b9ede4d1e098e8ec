// SPDX-License-Identifier: Apache-2.0
#include "app/cli/register/register_text.h"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "proc/optics/rotation.h"

namespace orbwatch::app::cli {
namespace {

std::array<double, 9> by_rows(const optics::Mat3& m) {
  return {m.row0.x, m.row0.y, m.row0.z, m.row1.x, m.row1.y, m.row1.z, m.row2.x, m.row2.y, m.row2.z};
}

std::string method(const RegisteredCamera& camera) {
  return std::string(word_for(align::kRegistrationMethods, camera.found.method));
}

}  // namespace

std::string register_text(const RegisteredCamera& camera) {
  const align::Registration& r = camera.found.registration;
  const optics::YawPitchRoll angles = optics::yaw_pitch_roll(r.rotation);
  const auto sigma = align::sigmas(r);
  std::ostringstream out;
  out << std::fixed << std::setprecision(3) << camera.camera << " on " << camera.reference
      << ", by " << method(camera) << "\nrotation    yaw " << angles.yaw << ", pitch "
      << angles.pitch << ", roll " << angles.roll << " deg\nsigma       " << sigma[0] << ", "
      << sigma[1] << ", " << sigma[2] << " deg about X, Y, Z; of directions "
      << align::direction_sigma(r) << " deg rms\nresidual    " << r.residual << " deg rms, "
      << r.inliers << " inliers\noverlap     " << std::setprecision(0) << 100 * r.overlap
      << " % of all directions\n\nFor the rig file:\n[camera.outline]\ncentre = ["
      << std::setprecision(3) << r.outline.centre.u << ", " << r.outline.centre.v << "]\nradii = ["
      << r.outline.rx << ", " << r.outline.ry << "]\nangle = " << r.outline.angle
      << std::setprecision(12) << "\nrotation_matrix = [";
  const auto matrix = by_rows(r.rotation);
  for (std::size_t n = 0; n < matrix.size(); ++n) out << (n > 0 ? ", " : "") << matrix[n];
  out << "]\n";
  return out.str();
}

std::string register_json(const RegisteredCamera& camera) {
  const align::Registration& r = camera.found.registration;
  const optics::YawPitchRoll angles = optics::yaw_pitch_roll(r.rotation);
  const optics::Outline& o = r.outline;
  nlohmann::ordered_json json;
  json["method"] = method(camera);
  json["reference"] = camera.reference;
  json["camera"] = camera.camera;
  json["rotation_matrix"] = by_rows(r.rotation);
  json["rotation"] = {{"yaw", angles.yaw}, {"pitch", angles.pitch}, {"roll", angles.roll}};
  json["outline"] = {
      {"centre", {o.centre.u, o.centre.v}}, {"radii", {o.rx, o.ry}}, {"angle", o.angle}};
  json["residual_deg"] = r.residual;
  json["overlap"] = r.overlap;
  json["inliers"] = r.inliers;
  json["sigma_deg"] = align::sigmas(r);
  json["direction_sigma_deg"] = align::direction_sigma(r);
  json["covariance"] = by_rows(r.covariance);
  return json.dump(2) + "\n";
}

}  // namespace orbwatch::app::cli
