// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/look_around/look_around.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using optics::BallModel;
using optics::BallProjection;
using optics::Vec3;
using optics::ViewProjection;

class ServedSphere : public Served {
 protected:
  void start_with(const BallProjection& ball) {
    view = std::make_shared<const ViewProjection>(
        ViewProjection::make({optics::ViewKind::Ball, {}, {}, {}, 640, 480}, ball).value());
    WebContext context = make_context();
    context.state_folder = state_folder;
    context.views[0].measured = context.views[1].measured = false;
    context.views[0].spec = view->spec();
    context.views[0].ball = view;
    context.views[0].is_own_picture = true;
    sink = std::make_unique<WebSink>(on_a_free_port(), context);
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  Answer sphere(const std::string& headers = "") const {
    return get(port(), "/api/v1/sphere?view=front", headers);
  }

  std::shared_ptr<const ViewProjection> view;
};

/// An uncalibrated camera, room far away.
BallProjection far_ball(double alpha) {
  return BallProjection::make(BallModel::make(BallModel::Kind::Exact, alpha).value(),
                              {{310, 250}, 220, 200, 30}, optics::rotation({40, -20, 10}))
      .value();
}

TEST_F(ServedSphere, NodesAreWhereTheExactModelShowsThem) {
  start_with(far_ball(345));
  const Answer answer = sphere();
  ASSERT_EQ(answer.status, 200);
  const std::size_t end = answer.body.find('\n');
  const json head = json::parse(answer.body.substr(0, end));
  const std::string bytes = answer.body.substr(end + 1);
  ASSERT_EQ(bytes.size(), head["bytes"]);
  const std::size_t nodes = head["nodes"];
  const std::size_t corners =
      3 * (head["triangles"].get<std::size_t>() + head["blind"].get<std::size_t>());
  ASSERT_EQ(bytes.size(), nodes * 24 + corners * 4);
  EXPECT_EQ(head["width"], 640);
  EXPECT_EQ(head["height"], 480);
  EXPECT_EQ(head["widths"], json::array({640, 480, 320, 160}));

  const auto vector = [&](const char* name) {
    return Vec3{head[name][0], head[name][1], head[name][2]};
  };
  const Vec3 facing = vector("facing"), u = vector("u"), v = vector("v");
  std::size_t seen = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    float node[6];
    std::memcpy(node, bytes.data() + 24 * k, sizeof node);
    const Vec3 direction = normalized(Vec3{node[0], node[1], node[2]});
    const auto exact = view->pixel(direction);
    if (node[5] == 0) continue;
    ++seen;
    ASSERT_TRUE(exact);
    const Vec3 half_way = normalized(direction + facing);
    EXPECT_NEAR(head["centre"][0].get<double>() + dot(u, half_way) + node[3], exact->u, 2e-3);
    EXPECT_NEAR(head["centre"][1].get<double>() + dot(v, half_way) + node[4], exact->v, 2e-3);
  }
  EXPECT_GT(seen, 1000U);
  for (std::size_t k = 0; k < corners; ++k) {
    std::uint32_t node = 0;
    std::memcpy(&node, bytes.data() + 24 * nodes + 4 * k, sizeof node);
    ASSERT_LT(node, nodes);
  }
}

TEST_F(ServedSphere, IsSentAgainOnlyWhenTheCalibrationHasChanged) {
  start_with(far_ball(345));
  const std::string tag = sphere().headers.at("ETag");
  const Answer same = sphere("If-None-Match: " + tag + "\r\n");
  EXPECT_EQ(same.status, 304);
  EXPECT_TRUE(same.body.empty());
  EXPECT_EQ(same.headers.at("ETag"), tag);
  sink->stop();
  start_with(far_ball(346));
  const Answer other = sphere("If-None-Match: " + tag + "\r\n");
  EXPECT_EQ(other.status, 200);
  EXPECT_NE(other.headers.at("ETag"), tag);
}

TEST_F(ServedSphere, ListsWhatCanBeLookedAroundIn) {
  start_with(far_ball(345));
  const json list = json::parse(get(port(), "/api/v1/look-around").body);
  EXPECT_EQ(list["spheres"], json::array({"front"}));
  EXPECT_EQ(list["pointed"], json::array({{{"name", "wide"}, {"index", 1}}}));
  EXPECT_EQ(get(port(), "/api/v1/sphere").status, 400);
  const Answer other = get(port(), "/api/v1/sphere?view=wide");
  EXPECT_EQ(other.status, 404);
  EXPECT_THAT(other.body, testing::HasSubstr("unknown picture of a ball wide; there are: front"));
}

TEST_F(ServedSphere, EdgesOfTheSceneAreListed) {
  optics::Scene scene;
  scene.room = optics::Scene::Room::Box;
  scene.walls = {{-500, -400, -300}, {600, 500, 800}};
  const optics::Ball ball{{0, 0, 0}, 50};
  const auto model = BallModel::make(BallModel::Kind::Exact, 345).value();
  start_with(BallProjection::make(model, {{310, 250}, 220, 200, 30}, {}, ball,
                                  optics::SceneProxy::make(scene, ball).value())
                 .value());
  const Answer answer = sphere();
  const json head = json::parse(answer.body.substr(0, answer.body.find('\n')));
  ASSERT_EQ(head["edges"].size(), 12U);
  for (const json& edge : head["edges"]) {
    ASSERT_EQ(edge.size(), 6U);
    EXPECT_TRUE(edge[0] == -10 || edge[0] == 12) << edge;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
