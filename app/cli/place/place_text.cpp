// SPDX-License-Identifier: Apache-2.0
#include "app/cli/place/place_text.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/cli/text_table.h"

namespace orbwatch::app::cli {
namespace {

using align::PlacedCamera;
using align::PlacedMark;
using align::Placement;
using align::PlaceRequest;
using optics::Vec3;
using Json = nlohmann::ordered_json;

std::string listed(const Vec3& v, int digits) {
  return fixed_text(v.x, digits) + ", " + fixed_text(v.y, digits) + ", " + fixed_text(v.z, digits);
}

/// The rms length of the deviation, mm.
double position_sigma(const PlacedCamera& camera) {
  const cv::Matx66d& c = camera.covariance;
  return std::sqrt(c(3, 3) + c(4, 4) + c(5, 5));
}

double centre_sigma(const Placement& placement) {
  return std::sqrt(cv::trace(placement.ball_centre_covariance));
}

std::string pose_text(const PlacedCamera& camera, const std::string& name) {
  const optics::Mat3& r = camera.pose.rotation;
  std::string text = "camera " + name + "\n  position    " + listed(camera.pose.position, 2) +
                     " mm, +- " + fixed_text(position_sigma(camera), 2) + "\n  rotation    " +
                     listed(r.row0, 6) + ",  " + listed(r.row1, 6) + ",  " + listed(r.row2, 6) +
                     "\n              +- " + fixed_text(camera.rotation_sigma, 3) +
                     " deg\n  directions  of its views are known to " +
                     fixed_text(camera.direction_sigma, 3) + " deg, rms over the view\n";
  if (camera.focal_sigma) {
    text += "  focal       " + fixed_text(camera.lens.fx, 1) + " px, +- " +
            fixed_text(*camera.focal_sigma, 1) + "\n";
  }
  return text;
}

std::string points_text(const PlaceRequest& request, const align::UnplacedCamera& camera,
                        const PlacedCamera& placed) {
  std::vector<Fields> rows;
  for (std::size_t m = 0; m < placed.marks.size(); ++m) {
    const align::PointMark& mark = camera.marks[m];
    const PlacedMark& found = placed.marks[m];
    const Vec3& p = request.points[mark.point];
    rows.push_back({{"x_mm", fixed_text(p.x, 1)},
                    {"y_mm", fixed_text(p.y, 1)},
                    {"z_mm", fixed_text(p.z, 1)},
                    {"u", fixed_text(mark.pixel.u, 1)},
                    {"v", fixed_text(mark.pixel.v, 1)},
                    {"off_u", found.residual ? fixed_text(found.residual->u, 2) : kNoValue},
                    {"off_v", found.residual ? fixed_text(found.residual->v, 2) : kNoValue},
                    {"note", found.is_outlier ? "WRONG: left out" : ""}});
  }
  return record_lines(rows);
}

Json list(const Vec3& v) { return {v.x, v.y, v.z}; }

Json rotation_json(const optics::Mat3& m) {
  return {m.row0.x, m.row0.y, m.row0.z, m.row1.x, m.row1.y, m.row1.z, m.row2.x, m.row2.y, m.row2.z};
}

Json camera_json(const PlaceRequest& request, const align::UnplacedCamera& camera,
                 const PlacedCamera& placed) {
  Json json{{"name", camera.name},
            {"position", list(placed.pose.position)},
            {"rotation", rotation_json(placed.pose.rotation)},
            {"focal_length", {placed.lens.fx, placed.lens.fy}},
            {"position_sigma", position_sigma(placed)},
            {"rotation_sigma", placed.rotation_sigma},
            {"direction_sigma", placed.direction_sigma},
            {"covariance", Json::array()},
            {"points", Json::array()}};
  if (placed.focal_sigma) json["focal_sigma"] = *placed.focal_sigma;
  for (int row = 0; row < 6; ++row) {
    Json numbers = Json::array();
    for (int column = 0; column < 6; ++column) numbers.push_back(placed.covariance(row, column));
    json["covariance"].push_back(numbers);
  }
  for (std::size_t m = 0; m < placed.marks.size(); ++m) {
    const align::PointMark& mark = camera.marks[m];
    const PlacedMark& found = placed.marks[m];
    Json residual;
    if (found.residual) residual = {found.residual->u, found.residual->v};
    json["points"].push_back({{"point", list(request.points[mark.point])},
                              {"pixel", {mark.pixel.u, mark.pixel.v}},
                              {"residual", residual},
                              {"outlier", found.is_outlier}});
  }
  return json;
}

}  // namespace

std::string place_text(const PlaceRequest& request, const Placement& placement) {
  std::string text;
  for (std::size_t c = 0; c < placement.cameras.size(); ++c) {
    text += pose_text(placement.cameras[c], request.cameras[c].name) +
            points_text(request, request.cameras[c], placement.cameras[c]) + "\n";
  }
  const double sigma = centre_sigma(placement);
  text += "ball centre   " + listed(placement.ball_centre, 2) + " mm" +
          (sigma > 0 ? ", +- " + fixed_text(sigma, 2) : ", taken for exact") + "\n";
  text += "chi-square    " + fixed_text(placement.reduced_chi_square, 2) + ", reduced, of " +
          std::to_string(placement.redundancy) +
          " equations more than unknowns; about 1 if the sigmas are right\n";
  return text;
}

std::string place_json(const PlaceRequest& request, const Placement& placement) {
  Json json{{"ball_centre", list(placement.ball_centre)},
            {"ball_centre_sigma", centre_sigma(placement)},
            {"reduced_chi_square", placement.reduced_chi_square},
            {"redundancy", placement.redundancy},
            {"cameras", Json::array()}};
  for (std::size_t c = 0; c < placement.cameras.size(); ++c) {
    json["cameras"].push_back(camera_json(request, request.cameras[c], placement.cameras[c]));
  }
  return json.dump(2) + "\n";
}

}  // namespace orbwatch::app::cli
