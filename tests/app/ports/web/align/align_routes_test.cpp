// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/align/align_routes.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A source with one alignment that records requests.
class Source : public AlignmentSource {
 public:
  AlignmentReport report(std::size_t camera) const override {
    AlignmentReport report;
    report.width = 640;
    report.height = 480;
    if (camera != 0) return report;
    report.is_watched = true;
    report.state = ProposalState::Ready;
    report.steps = steps;
    report.in_force.emplace();
    report.in_force->outline = {{310, 250.5}, 220, 200, 30};
    report.in_force->rotation = {40, -20, 10};
    report.proposed = report.in_force;
    report.proposed->method = "detect";
    report.proposed->direction_sigma = 0.2;
    report.proposed->work_sigma = 1.5;
    report.proposed->edges = {{{5, 6, 7}, {8, 9, 10}, {{1, 2}, {3, 4}}}};
    report.proposed->corners = {{{5, 6, 7}, {1, 2}}};
    report.points = {{{1, 2, 3}, {4, 5}, optics::Vec2{0.5, -0.25}, false}, {{7, 8, 9}, {6, 5}}};
    return report;
  }
  std::optional<optics::Vec3> direction(std::size_t camera,
                                        const optics::Vec2& pixel) const override {
    if (camera != 0 || pixel.u != 10.5) return std::nullopt;
    return normalized(optics::Vec3{1, 1, std::sqrt(2)});
  }
  Result<> request(const AlignmentPicture& picture, OnPictures on_pictures,
                   IsWanted /*is_wanted*/) override {
    if (picture.camera == 1 && !picture.is_beside_first) return fail("the camera is not watched");
    const std::lock_guard lock(mutex_);
    asked_ = picture;
    // Called later and elsewhere, like by cameras.
    const AlignmentJpegs one{hal::Clock::now(), {"a picture"}};
    const AlignmentJpegs both{one.stamp, {"the first", "the second one"}};
    pictures_.emplace_back([on_pictures = std::move(on_pictures),
                            made = picture.is_beside_first ? both : one] { on_pictures(made); });
    return {};
  }
  std::atomic<std::size_t> steps{2};

  AlignmentPicture asked() const {
    const std::lock_guard lock(mutex_);
    return asked_;
  }

 private:
  mutable std::mutex mutex_;
  AlignmentPicture asked_;
  std::vector<std::jthread> pictures_;
};

class ServedAlignment : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    context.alignment = &source;
    names = context.names.cameras;
    sink = std::make_unique<WebSink>(on_a_free_port(), context);
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  Answer view(const std::string& query) const {
    return get(port(), "/api/v1/alignment/view.jpg?camera=" + names[0] + query);
  }

  std::vector<std::string> names;
  Source source;
};

TEST_F(ServedAlignment, SaysWhatIsInForceAndWhatIsProposed) {
  const Answer answer = get(port(), "/api/v1/alignment");
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json cameras = json::parse(answer.body)["cameras"];
  ASSERT_EQ(cameras.size(), names.size());
  const json& first = cameras[0];
  EXPECT_EQ(first["name"], names[0]);
  EXPECT_EQ(first["width"], 640);
  EXPECT_EQ(first["state"], 2);
  EXPECT_EQ(first["steps"], 2);
  EXPECT_EQ(first["in_force"]["outline"],
            (json{{"u", 310.}, {"v", 250.5}, {"rx", 220.}, {"ry", 200.}, {"angle", 30.}}));
  EXPECT_EQ(first["in_force"]["rotation"], (json{{"yaw", 40.}, {"pitch", -20.}, {"roll", 10.}}));
  EXPECT_EQ(first["in_force"]["position"], nullptr);
  EXPECT_EQ(first["in_force"]["direction_sigma"], nullptr);
  EXPECT_EQ(first["proposed"]["method"], "detect");
  EXPECT_EQ(first["proposed"]["direction_sigma"], 0.2);
  EXPECT_EQ(first["proposed"]["work_sigma"], 1.5);
  EXPECT_EQ(first["proposed"]["edges"],
            json::parse(R"([{"from": [5.0, 6.0, 7.0], "to": [8.0, 9.0, 10.0],
                            "pixels": [[1.0, 2.0], [3.0, 4.0]]}])"));
  EXPECT_EQ(first["proposed"]["corners"],
            json::parse(R"([{"point": [5.0, 6.0, 7.0], "pixel": [1.0, 2.0]}])"));
  EXPECT_EQ(first["points"][0]["point"], json::parse("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(first["points"][0]["residual"], json::parse("[0.5, -0.25]"));
  EXPECT_EQ(first["points"][1]["residual"], nullptr);
  EXPECT_EQ(cameras[1]["in_force"], nullptr);
  EXPECT_EQ(cameras[1]["is_watched"], false);
}

TEST_F(ServedAlignment, IsSentAgainOnlyWhenItHasChanged) {
  const Answer first = get(port(), "/api/v1/alignment");
  const std::string tag = first.headers.at("ETag");
  EXPECT_EQ(first.headers.at("Cache-Control"), "no-cache");
  const Answer same = get(port(), "/api/v1/alignment", "If-None-Match: " + tag + "\r\n");
  EXPECT_EQ(same.status, 304);
  EXPECT_TRUE(same.body.empty());
  EXPECT_EQ(same.headers.at("ETag"), tag);
  source.steps = 3;
  const Answer other = get(port(), "/api/v1/alignment", "If-None-Match: " + tag + "\r\n");
  EXPECT_EQ(other.status, 200);
  EXPECT_EQ(json::parse(other.body)["cameras"][0]["steps"], 3);
  EXPECT_NE(other.headers.at("ETag"), tag);
}

TEST_F(ServedAlignment, ABallsPictureComesWhenTheCameraHasTakenIt) {
  const Answer answer = get(port(), "/api/v1/alignment/ball.jpg?camera=" + names[0]);
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.headers.at("Content-Type"), "image/jpeg");
  EXPECT_EQ(answer.body, "a picture");
  EXPECT_EQ(source.asked().camera, 0U);
  EXPECT_FALSE(source.asked().view);
}

TEST_F(ServedAlignment, AViewIsWhatWasAskedFor) {
  ASSERT_EQ(view("").status, 200);
  EXPECT_FALSE(source.asked().is_proposed);
  EXPECT_FALSE(source.asked().model);
  EXPECT_EQ(source.asked().view->h_fov, 90);
  ASSERT_EQ(
      view("&which=proposed&model=paper&yaw=-30.5&pitch=12&h_fov=60&width=320&height=200").status,
      200);
  const AlignmentPicture asked = source.asked();
  EXPECT_TRUE(asked.is_proposed);
  EXPECT_EQ(asked.model, optics::BallModel::Kind::Paper);
  EXPECT_EQ(asked.view->orientation.yaw, -30.5);
  EXPECT_EQ(asked.view->orientation.pitch, 12);
  EXPECT_EQ(asked.view->h_fov, 60);
  EXPECT_EQ(asked.view->width, 320);
  EXPECT_EQ(asked.view->height, 200);
}

TEST_F(ServedAlignment, APairIsTwoMessagesOfOneTime) {
  const Answer answer =
      get(port(), "/api/v1/alignment/pair?camera=" + names[1] + "&which=proposed&yaw=-30.5");
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_TRUE(source.asked().is_beside_first);
  EXPECT_TRUE(source.asked().is_proposed);
  EXPECT_EQ(source.asked().camera, 1U);
  EXPECT_EQ(source.asked().view->orientation.yaw, -30.5);
  std::istringstream body(answer.body);
  std::vector<json> heads;
  for (const std::string file : {"the first", "the second one"}) {
    std::string head;
    ASSERT_TRUE(std::getline(body, head));
    heads.push_back(json::parse(head));
    std::string read(heads.back()["bytes"].get<std::size_t>(), ' ');
    body.read(read.data(), static_cast<std::streamsize>(read.size()));
    EXPECT_EQ(read, file);
  }
  EXPECT_EQ(heads[0]["camera"], names[0]);
  EXPECT_EQ(heads[1]["camera"], names[1]);
  EXPECT_EQ(heads[0]["stamp"], heads[1]["stamp"]);
  EXPECT_EQ(heads[0]["age_ms"], heads[1]["age_ms"]);
  EXPECT_GE(heads[0]["age_ms"], 0);
}

TEST_F(ServedAlignment, WhatIsWrongIsNamed) {
  for (const auto& [query, named] : std::vector<std::pair<std::string, std::string>>{
           {"&yaw=200", "yaw is 200; it must be -180 to 180 deg"},
           {"&yaw=1e", "yaw is 1e; it must be"},
           {"&pitch=nan", "pitch is nan; it must be"},
           {"&width=100000", "width is 100000; it must be a whole number, 16 to 1920 px"},
           {"&height=100.5", "height is 100.5; it must be a whole number"},
           {"&which=other", "which is other; it must be one of in_force, proposed"},
           {"&model=flat", "model is flat; it must be one of exact, paper, classical"}}) {
    const Answer answer = view(query);
    EXPECT_EQ(answer.status, 400) << query;
    EXPECT_THAT(answer.body, HasSubstr(named));
  }
  const Answer missing = get(port(), "/api/v1/alignment/ball.jpg");
  EXPECT_EQ(missing.status, 400);
  EXPECT_THAT(missing.body, HasSubstr("camera is missing; it must be a string"));
  for (const char* path : {"ball.jpg?", "view.jpg?", "direction?u=1&v=2&"}) {
    const Answer none = get(port(), "/api/v1/alignment/" + std::string(path) + "camera=none");
    EXPECT_EQ(none.status, 404) << path;
    EXPECT_THAT(none.body, HasSubstr("unknown camera none; there are: " + names[0]));
  }
  const Answer blind = get(port(), "/api/v1/alignment/ball.jpg?camera=" + names[1]);
  EXPECT_EQ(blind.status, 409);
  EXPECT_THAT(blind.body, HasSubstr("not watched"));
}

TEST_F(ServedAlignment, APixelShowsADirection) {
  const auto at = [&](const std::string& pixel) {
    return get(port(), "/api/v1/alignment/direction?camera=" + names[0] + pixel);
  };
  const Answer seen = at("&u=10.5&v=-3");
  ASSERT_EQ(seen.status, 200) << seen.body;
  EXPECT_NEAR(json::parse(seen.body)["yaw"].get<double>(), 45, 1e-9);
  EXPECT_NEAR(json::parse(seen.body)["pitch"].get<double>(), 45, 1e-9);
  EXPECT_EQ(at("&u=11&v=-3").status, 404);
  EXPECT_EQ(at("&u=11").status, 400);
  EXPECT_EQ(at("&u=11&v=x").status, 400);
}

TEST_F(ServedAlignment, ArgumentsAreDescribed) {
  const json all = json::parse(get(port(), "/api/v1/openapi.json").body);
  const json& parameters = all["paths"]["/api/v1/alignment/view.jpg"]["get"]["parameters"];
  ASSERT_EQ(parameters.size(), 8U);
  EXPECT_EQ(parameters[0]["name"], "camera");
  EXPECT_EQ(parameters[0]["required"], true);
  EXPECT_EQ(parameters[0]["schema"]["type"], "string");
  EXPECT_EQ(parameters[2]["name"], "yaw");
  EXPECT_EQ(parameters[2]["required"], false);
  EXPECT_EQ(parameters[2]["schema"]["type"], "number");
}

}  // namespace
}  // namespace orbwatch::app::web::tests
