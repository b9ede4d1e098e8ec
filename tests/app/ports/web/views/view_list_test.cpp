// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/views/view_list.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/ports/web/served.h"
#include "tests/app/ports/web/streams/live_client.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;

class ServedViews : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    PublishedView& front = context.views[0];
    front.measured = false;
    front.mixes = true;
    front.spec.orientation = {30, -10, 5};
    front.sources = {{"colour", "grey", {0, 100}, false}, {"thermal", "hot", {15, 200}, true}};
    context.views[1].sources = {{"thermal", "turbo", {0, 100}, true}};
    sink = std::make_unique<WebSink>(on_a_free_port(), context);
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  json views() const { return json::parse(get(port(), "/api/v1/views").body)["views"]; }

  static std::shared_ptr<View> turned_view(double yaw) {
    const auto view = make_view(0, "front", 1, 64, 48);
    view->spec.orientation = {yaw, -20, 5};
    view->spec.h_fov = 75;
    view->weights = {1, 0.25};
    view->colours[1] = {3, {15, 200}};
    return view;
  }
};

TEST_F(ServedViews, SayWhatCommandsMayChange) {
  const json all = views();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["name"], "front");
  EXPECT_EQ(all[0]["index"], 0);
  EXPECT_EQ(all[0]["is_pointed"], true);
  EXPECT_EQ(all[0]["is_zoomed"], true);
  EXPECT_EQ(all[0]["is_mixed"], true);
  EXPECT_EQ(all[1]["is_measured"], true);
  EXPECT_EQ(all[1]["is_pointed"], false) << "what is measured stays put";
  EXPECT_EQ(all[1]["is_mixed"], false);
}

TEST_F(ServedViews, SayWhatColoursMean) {
  const json thermal = views()[0]["sources"][1];
  EXPECT_EQ(thermal["camera"], "thermal");
  EXPECT_EQ(thermal["colour_map"], "hot");
  EXPECT_EQ(thermal["range"], (json{15., 200.}));
  EXPECT_EQ(thermal["unit"], "degC");
  const json hot = json::parse(get(port(), "/api/v1/views").body)["colour_maps"][3];
  EXPECT_EQ(hot["name"], "hot");
  EXPECT_EQ(hot["stops"].front(), "#000000");
  EXPECT_EQ(hot["stops"].back(), "#ffffff");
  EXPECT_EQ(views()[0]["sources"][0]["unit"], "%");
}

TEST_F(ServedViews, SayHowTheyAreNowAndWereConfigured) {
  EXPECT_TRUE(views()[0]["aim"].is_null()) << "nothing is known before the first picture";
  app::tests::hand_over(*sink, turned_view(120));
  const json front = views()[0];
  EXPECT_EQ(front["aim"],
            (json{{"yaw", 120.},
                  {"pitch", -20.},
                  {"roll", 5.},
                  {"h_fov", 75.},
                  {"weights", {1., 0.25}},
                  {"colours", {nullptr, {{"colour_map", "hot"}, {"range", {15., 200.}}}}}}));
  EXPECT_EQ(front["configured"]["yaw"], 30.);
  EXPECT_EQ(front["configured"]["h_fov"], 90.) << "that of its kind";
}

TEST_F(ServedViews, EachPictureSaysWhereItLooks) {
  LiveClient client(port(), "/api/v1/live?view=front");
  for (const double yaw : {-60.0, 60.0}) {
    const auto view = turned_view(yaw);
    ASSERT_TRUE(eventually([&] { return sink->needs(0, view->stamp).jpeg; }));
    sink->accept(view);
    EXPECT_EQ(client.next("view").head["aim"]["yaw"], yaw);
  }
}

TEST(Aims, SayWhatACommandWouldReplace) {
  Aim aim;
  aim.spec.orientation = {10, 20, 30};
  aim.spec.h_fov = 40;
  aim.weights = {1, 0.25};
  aim.colours[1] = {3, {15, 200}};
  const auto present = [&aim](CommandCode code, double source) {
    const auto command = at_present({code, {7, source, 1, 2}}, aim);
    return command ? command->arguments : std::array<double, kMaxArguments>{};
  };
  using Arguments = std::array<double, kMaxArguments>;
  EXPECT_EQ(present(CommandCode::PointView, 0), (Arguments{7, 10, 20, 40}));
  EXPECT_EQ(present(CommandCode::MixSources, 1), (Arguments{7, 1, 0.25}));
  EXPECT_EQ(present(CommandCode::SetColourMap, 1), (Arguments{7, 1, 3}));
  EXPECT_EQ(present(CommandCode::SetColourRange, 1), (Arguments{7, 1, 15, 200}));
  EXPECT_FALSE(at_present({CommandCode::SetColourMap, {7, 0}}, aim)) << "it has its own colours";
  EXPECT_FALSE(at_present({CommandCode::MixSources, {7, 2}}, aim)) << "there is no such source";
  EXPECT_FALSE(at_present({CommandCode::MixSources, {7, 60000}}, aim));
  EXPECT_FALSE(at_present({CommandCode::SelectView, {7}}, aim));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
