// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/look_around/look_around.h"

#include <utility>

#include "app/ports/web/http/entity_tag.h"
#include "app/ports/web/look_around/mesh_text.h"

namespace orbwatch::app::web {

LookAround::LookAround(const StatusNames& names, const std::vector<PublishedView>& views,
                       const std::vector<BallPictures::Ball>& balls,
                       std::shared_ptr<hal::SharedThreads> threads)
    : work_(std::move(threads), [this] { compute(); }) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].is_own_picture) {
      list_.spheres.push_back(names.views[i]);
      spheres_.push_back({views[i].ball, {}, {}, {}});
    } else if (views[i].spec.kind == optics::ViewKind::Perspective && !views[i].measured) {
      list_.pointed.push_back({names.views[i], i});
    }
  }
  for (const BallPictures::Ball& ball : balls) {
    list_.spheres.push_back(ball.name);
    spheres_.push_back({ball.view, {}, {}, {}});
  }
}

void LookAround::mesh(const ViewQuery& query, const ExchangePtr& exchange) {
  auto index = index_of("picture of a ball", query.view, list_.spheres);
  if (!index) {
    exchange->answer(std::move(index.error()));
    return;
  }
  Sphere& sphere = spheres_[*index];
  {
    const std::lock_guard lock(mutex_);
    if (!sphere.mesh) {
      sphere.waiting.push_back(exchange);
      work_.request();
      return;
    }
  }
  // A computed mesh never changes.
  answer(exchange, sphere.mesh, sphere.tag);
}

void LookAround::compute() {
  for (Sphere& sphere : spheres_) {
    {
      const std::lock_guard lock(mutex_);
      if (sphere.waiting.empty()) continue;
    }
    auto mesh = std::make_shared<const std::string>(
        mesh_text(optics::ball_mesh(*sphere.view), *sphere.view));
    std::string tag = entity_tag(*mesh);
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
  Response response = body_response(kType, mesh);
  response.tag = tag;
  exchange->answer(std::move(response));
}

}  // namespace orbwatch::app::web
