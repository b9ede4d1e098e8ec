// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/look_around/mesh_text.h"

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "app/ports/web/streams/picture_sizes.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

Json list(const optics::Vec3& v) { return {v.x, v.y, v.z}; }

void append(std::string& bytes, std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<char>(number >> shift & 0xffU));
  }
}

void append(std::string& bytes, double number) {
  append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
}

}  // namespace

std::string mesh_text(const optics::BallMesh& mesh, const optics::ViewProjection& view) {
  std::string bytes;
  bytes.reserve(4 * (6 * mesh.nodes.size() + mesh.triangles.size() + mesh.blind.size()));
  for (const optics::BallMesh::Node& node : mesh.nodes) {
    for (const double number : {node.position.x, node.position.y, node.position.z, node.offset.u,
                                node.offset.v, node.resolution}) {
      append(bytes, number);
    }
  }
  for (const auto* triangles : {&mesh.triangles, &mesh.blind}) {
    for (const std::uint32_t node : *triangles) append(bytes, node);
  }
  Json edges = Json::array();
  for (const auto& [from, to] : view.ball()->proxy().edges()) {
    edges.push_back({from.x, from.y, from.z, to.x, to.y, to.z});
  }
  const Json head{{"width", view.width()},
                  {"height", view.height()},
                  {"widths", widths_of(view.width())},
                  {"facing", list(mesh.facing)},
                  {"centre", {mesh.centre.u, mesh.centre.v}},
                  {"u", list(mesh.u)},
                  {"v", list(mesh.v)},
                  {"nodes", mesh.nodes.size()},
                  {"triangles", mesh.triangles.size() / 3},
                  {"blind", mesh.blind.size() / 3},
                  {"edges", std::move(edges)},
                  {"bytes", bytes.size()}};
  return head.dump() + "\n" + bytes;
}

}  // namespace orbwatch::app::web
