// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/align/alignment_text.h"

#include <nlohmann/json.hpp>

#include "app/model/json.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const optics::Vec2& pixel) { return {pixel.u, pixel.v}; }
Json json_of(const optics::Vec3& point) { return {point.x, point.y, point.z}; }

Json json_of(const CameraAlignmentState& state);

template <class T>
Json json_of(const std::optional<T>& part) {
  return part ? json_of(*part) : Json();
}

Json json_of(const CameraAlignmentState& state) {
  Json edges = Json::array();
  for (const SceneEdge& edge : state.edges) {
    Json pixels = Json::array();
    for (const optics::Vec2& pixel : edge.pixels) pixels.push_back(json_of(pixel));
    edges.push_back(
        {{"from", json_of(edge.from)}, {"to", json_of(edge.to)}, {"pixels", std::move(pixels)}});
  }
  const optics::Outline& outline = state.outline;
  return {{"outline",
           {{"u", outline.centre.u},
            {"v", outline.centre.v},
            {"rx", outline.rx},
            {"ry", outline.ry},
            {"angle", outline.angle}}},
          {"rotation",
           {{"yaw", state.rotation.yaw},
            {"pitch", state.rotation.pitch},
            {"roll", state.rotation.roll}}},
          {"position", json_of(state.position)},
          {"number", state.number},
          {"method", state.method},
          {"quality", state.quality},
          {"direction_sigma", to_json(state.direction_sigma)},
          {"edges", std::move(edges)}};
}

Json json_of(const PlacedPoint& point) {
  return {{"point", json_of(point.point)},
          {"pixel", json_of(point.pixel)},
          {"residual", json_of(point.residual)},
          {"is_outlier", point.is_outlier}};
}

Json json_of(const std::string& name, std::size_t index, const AlignmentReport& report) {
  Json points = Json::array();
  for (const PlacedPoint& point : report.points) points.push_back(json_of(point));
  return {{"name", name},
          {"index", index},
          {"width", report.width},
          {"height", report.height},
          {"is_watched", report.is_watched},
          {"state", static_cast<int>(report.state)},
          {"state_text", operator_text(report.state)},
          {"refusal", report.refusal},
          {"steps", report.steps},
          {"in_force", json_of(report.in_force)},
          {"proposed", json_of(report.proposed)},
          {"picked", json_of(report.picked)},
          {"points", std::move(points)}};
}

}  // namespace

std::string alignment_json(const std::vector<std::string>& cameras,
                           const std::vector<AlignmentReport>& reports) {
  Json list = Json::array();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    list.push_back(json_of(cameras[i], i, reports[i]));
  }
  return Json{{"cameras", std::move(list)}}.dump();
}

std::string direction_json(const optics::Vec3& direction) {
  const optics::YawPitchRoll angles = optics::yaw_pitch(direction);
  return Json{{"yaw", angles.yaw}, {"pitch", angles.pitch}}.dump();
}

}  // namespace orbwatch::app::web
