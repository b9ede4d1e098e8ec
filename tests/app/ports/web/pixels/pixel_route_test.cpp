// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/pixels/pixel_route.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "proc/optics/rotation.h"
#include "proc/remap/remap.h"
#include "tests/app/ports/web/served.h"
#include "tests/app/ports/web/streams/live_client.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 48;
constexpr double kKelvinPerCount = 0.04, kKelvinOffset = 173.15;
/// Column with counts but without a displayed camera, and the reverse.
constexpr int kBlindColumn = 3, kUncountedColumn = 5;

class ServedPixels : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    context.ball = {{10, 20, 30}, 5};
    optics::Scene scene;
    scene.room = optics::Scene::Room::Box;
    scene.walls = {{-500, -400, -300}, {600, 520, 800}};
    context.scene = optics::SceneProxy::make(scene, context.ball).value();
    const auto ball = optics::BallProjection::make(
        optics::BallModel::make(optics::BallModel::Kind::Exact, 345).value(), {{31, 23}, 20, 20, 0},
        optics::rotation({40, -20, 10}));
    own_picture = std::make_shared<const optics::ViewProjection>(
        optics::ViewProjection::make({optics::ViewKind::Ball, {}, {}, {}, kWidth, kHeight}, *ball)
            .value());
    context.views[1].ball = own_picture;
    sink = std::make_unique<WebSink>(on_a_free_port(), context);
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
    live.emplace(port(), "/api/v1/live?view=front&view=wide");
  }

  /// Passes a view like the pipeline: with counts if needed, unless its rendering began before.
  void pass_on(std::size_t index, double yaw, bool is_late = false) {
    const auto view =
        make_view(index, index == 0 ? "front" : "wide", ++frame_set, kWidth, kHeight, true);
    const auto pixels = static_cast<std::size_t>(kWidth) * kHeight;
    view->spec = {optics::ViewKind::Perspective, {yaw, 0, 0}, 90, {}, kWidth, kHeight};
    validity.assign(pixels, static_cast<std::uint8_t>(orbwatch::Validity::Seen));
    view->validity = {validity.data(), kWidth, kHeight, 1, kWidth};
    *view->validity.at(kBlindColumn, 7) = static_cast<std::uint8_t>(orbwatch::Validity::Blind);
    *view->radiometric.at(kUncountedColumn, 7) = 0;
    EXPECT_TRUE(eventually([&] { return sink->needs(index, view->stamp).jpeg; }));
    if (sink->needs(index, view->stamp).counts && !is_late) view->counts = view->radiometric;
    view->kelvin_per_count = kKelvinPerCount;
    view->kelvin_offset = kKelvinOffset;
    sent = view;
    sink->accept(view);
  }
  /// Passes a view and returns the number of its picture.
  std::uint64_t send(std::size_t index = 0, double yaw = 0) {
    pass_on(index, yaw);
    return live->next("view").head["number"];
  }
  Answer pixel(std::uint64_t number, const std::string& at, const std::string& view = "front") {
    return get(port(),
               "/api/v1/live/pixel?view=" + view + "&number=" + std::to_string(number) + at);
  }
  json seen(std::uint64_t number, int u, int v, const std::string& view = "front") {
    const Answer answer =
        pixel(number, "&u=" + std::to_string(u) + "&v=" + std::to_string(v), view);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return json::parse(answer.body);
  }

  std::shared_ptr<const optics::ViewProjection> own_picture;
  std::optional<LiveClient> live;
  std::uint64_t frame_set = 0;
  std::vector<std::uint8_t> validity;
  std::shared_ptr<View> sent;
};

TEST_F(ServedPixels, ComeFromThePictureThatWasSentUnderTheNumber) {
  const std::uint64_t unasked = send();
  EXPECT_EQ(pixel(unasked, "&u=0&v=0").status, 410) << "nobody pointed yet";
  const std::uint64_t first = send(0, 0);
  const ViewPtr first_view = sent;
  const std::uint64_t second = send(0, 90);
  EXPECT_EQ(second, first + 1);
  const auto counts = [](const ViewPtr& view, int u, int v) {
    return kKelvinPerCount * *view->radiometric.at(u, v) + kKelvinOffset - 273.15;
  };
  EXPECT_NEAR(seen(first, 40, 30)["temperature"], counts(first_view, 40, 30), 1e-9);
  EXPECT_NEAR(seen(second, 40, 30)["temperature"], counts(sent, 40, 30), 1e-9);
  const std::uint8_t* const rgb = first_view->picture.samples<std::uint8_t>().at(40, 30);
  EXPECT_NEAR(seen(first, 40, 30)["intensity"], remap::luma(rgb) / 2.55, 1e-9);
}

TEST_F(ServedPixels, WithoutANumberAreOfTheNextPictureAlsoIfNobodyElseReadsIt) {
  live.reset();
  ASSERT_TRUE(eventually([&] { return sink->statistics().streams == 0; }));
  Client client(port());
  client.send(request_text("GET", "/api/v1/live/pixel?view=front&u=4&v=5"));
  pass_on(0, 0);
  const Answer answer = client.answer();
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(json::parse(answer.body)["number"], 1);
  EXPECT_FALSE(json::parse(answer.body)["temperature"].is_null());
  EXPECT_EQ(seen(1, 4, 5)["temperature"], json::parse(answer.body)["temperature"]);
}

TEST_F(ServedPixels, AreNeverOfAPictureThatWasBegunBeforeSomebodyPointed) {
  pixel(1, "&u=0&v=0");
  pass_on(0, 0, true);
  const std::uint64_t late = live->next("view").head["number"];
  EXPECT_EQ(pixel(late, "&u=0&v=0").status, 410);
  EXPECT_FALSE(seen(send(), 4, 5)["temperature"].is_null());
}

TEST_F(ServedPixels, LieWhereTheViewOfThatMomentLooks) {
  pixel(1, "&u=0&v=0");
  for (const double yaw : {0.0, 90.0}) {
    const json at = seen(send(0, yaw), 44, 10);
    const auto view = optics::ViewProjection::make(sent->spec).value();
    const optics::Vec3 direction = *view.direction(44, 10);
    const optics::YawPitchRoll angles = optics::yaw_pitch(direction);
    EXPECT_NEAR(at["yaw"], angles.yaw, 1e-9);
    EXPECT_NEAR(at["pitch"], angles.pitch, 1e-9);
    // The point is on the front wall, 500 mm from the ball's centre, or on the right wall.
    const double distance = yaw == 0 ? 500 / direction.y : 590 / direction.x;
    EXPECT_NEAR(at["distance"], distance, 1e-6);
    EXPECT_NEAR(at["point"][0], 10 + distance * direction.x, 1e-6);
    EXPECT_NEAR(at["point"][1], 20 + distance * direction.y, 1e-6);
    EXPECT_NEAR(at["point"][2], 30 + distance * direction.z, 1e-6);
  }
}

TEST_F(ServedPixels, HaveNoNumberWhereNothingIsKnown) {
  pixel(1, "&u=0&v=0");
  const std::uint64_t number = send();
  EXPECT_TRUE(seen(number, kUncountedColumn, 7)["temperature"].is_null());
  EXPECT_TRUE(seen(number, kUncountedColumn, 7)["seen"]);
  EXPECT_FALSE(seen(number, kBlindColumn, 7)["seen"]);
  EXPECT_FALSE(seen(number, kBlindColumn, 7)["temperature"].is_null()) << "seen by the thermal one";
}

TEST_F(ServedPixels, OfABallsOwnPictureLieWhereThatShowsTheRoom) {
  pixel(1, "&u=0&v=0", "wide");
  const std::uint64_t number = send(1);
  const json at = seen(number, 25, 20, "wide");
  EXPECT_NEAR(at["yaw"], optics::yaw_pitch(*own_picture->direction(25, 20)).yaw, 1e-9);
  const json beside = seen(number, 0, 0, "wide");
  EXPECT_TRUE(beside["yaw"].is_null()) << "outside of the limb";
  EXPECT_TRUE(beside["distance"].is_null());
  EXPECT_TRUE(beside["point"].is_null());
}

TEST_F(ServedPixels, AreGoneWithTheirPicture) {
  pixel(1, "&u=0&v=0");
  const std::uint64_t number = send();
  for (std::size_t n = 1; n < RecentViews::kMost; ++n) send();
  EXPECT_EQ(pixel(number, "&u=0&v=0").status, 200);
  send();
  const Answer answer = pixel(number, "&u=0&v=0");
  EXPECT_EQ(answer.status, 410);
  EXPECT_THAT(answer.body, HasSubstr("picture " + std::to_string(number) + " of view front"));
  EXPECT_THAT(answer.body, HasSubstr("request a later picture"));
}

TEST_F(ServedPixels, WhatIsWrongIsNamed) {
  pixel(1, "&u=0&v=0");
  const std::uint64_t number = send();
  for (const auto& [query, named] : std::vector<std::pair<std::string, std::string>>{
           {"&u=64&v=0", "the picture has 64x48 pixels"},
           {"&u=0&v=48", "the picture has 64x48 pixels"},
           {"&u=-1&v=0", "u is -1; it must be 0 to"},
           {"&u=nan&v=0", "u is nan; it must be"},
           {"&u=0", "v is missing; it must be 0 to 16384 px"}}) {
    const Answer answer = pixel(number, query);
    EXPECT_EQ(answer.status, 400) << query;
    EXPECT_THAT(answer.body, HasSubstr(named));
  }
  EXPECT_EQ(get(port(), "/api/v1/live/pixel?u=0&v=0").status, 400);
  EXPECT_EQ(get(port(), "/api/v1/live/pixel?view=front&number=1e99&u=0&v=0").status, 400);
  const Answer none = pixel(number, "&u=0&v=0", "none");
  EXPECT_EQ(none.status, 404);
  EXPECT_THAT(none.body, HasSubstr("unknown view none; there are: front, wide"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
