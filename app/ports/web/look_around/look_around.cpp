// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/look_around/look_around.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/ports/web/look_around/mesh_text.h"

namespace orbwatch::app::web {
namespace {

constexpr std::string_view kBinary = "application/octet-stream";

/// Hash FNV-1a, quoted as required by HTTP.
std::string tag_of(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  char text[19];
  std::snprintf(text, sizeof text, "\"%016llx\"", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

LookAround::LookAround(const StatusNames& names, const std::vector<PublishedView>& views,
                       std::shared_ptr<hal::SharedThreads> threads)
    : work_(std::move(threads), [this] { compute(); }) {
  nlohmann::ordered_json spheres = nlohmann::ordered_json::array(), pointed = spheres;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].is_own_picture) {
      spheres.push_back(names.views[i]);
      spheres_.push_back({names.views[i], views[i].ball, {}, {}, {}});
    } else if (views[i].spec.kind == optics::ViewKind::Perspective && !views[i].measured) {
      pointed.push_back({{"name", names.views[i]}, {"index", i}});
    }
  }
  list_ = nlohmann::ordered_json{{"spheres", std::move(spheres)}, {"pointed", std::move(pointed)}}
              .dump();
}

std::vector<Route> LookAround::routes() {
  Route list;
  list.method = "GET";
  list.path = "/api/v1/look-around";
  list.role = Role::Viewer;
  list.description =
      "Returns the names of views of kind ball, from which a browser draws views of the room, and "
      "of the views that the command point_view points";
  list.type = kJson;
  list.serve = [this](const ExchangePtr& exchange) { serve_list(exchange); };
  Route mesh = list;
  mesh.path = "/api/v1/sphere";
  mesh.description =
      "Returns the room as a view of kind ball shows it, as triangles with the pixels of their "
      "corners: a line of JSON with the number of bytes that follow. The ETag changes with the "
      "calibration";
  mesh.type = kBinary;
  mesh.serve = [this](const ExchangePtr& exchange) { serve_mesh(exchange); };
  mesh.view = ViewArgument::One;
  return {std::move(list), std::move(mesh)};
}

void LookAround::serve_list(const ExchangePtr& exchange) const {
  exchange->answer(json_response(list_));
}

void LookAround::serve_mesh(const ExchangePtr& exchange) {
  const std::string* name = exchange->request().argument("view");
  const auto sphere = name ? std::ranges::find(spheres_, *name, &Sphere::name) : spheres_.end();
  if (sphere == spheres_.end()) {
    exchange->answer(
        error_response(404, "unknown view; pass ?view=NAME with a name from /api/v1/look-around"));
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    if (!sphere->mesh) {
      sphere->waiting.push_back(exchange);
      work_.request();
      return;
    }
  }
  // A computed mesh never changes.
  answer(exchange, sphere->mesh, sphere->tag);
}

void LookAround::compute() {
  for (Sphere& sphere : spheres_) {
    {
      const std::lock_guard lock(mutex_);
      if (sphere.waiting.empty()) continue;
    }
    auto mesh = std::make_shared<const std::string>(
        mesh_text(optics::ball_mesh(*sphere.view), *sphere.view));
    std::string tag = tag_of(*mesh);
    std::vector<ExchangePtr> waiting;
    {
      const std::lock_guard lock(mutex_);
      sphere.mesh = std::move(mesh);
      sphere.tag = std::move(tag);
      waiting.swap(sphere.waiting);
    }
    for (const ExchangePtr& exchange : waiting) answer(exchange, sphere.mesh, sphere.tag);
  }
}

void LookAround::answer(const ExchangePtr& exchange, const Bytes& mesh, const std::string& tag) {
  Response response;
  response.type = kBinary;
  response.headers.emplace_back("ETag", tag);
  const std::string* has = exchange->request().header("If-None-Match");
  const bool is_known = has && *has == tag;
  response.status = is_known ? 304 : 200;
  response.body = is_known ? std::make_shared<const std::string>() : mesh;
  exchange->answer(std::move(response));
}

}  // namespace orbwatch::app::web
