// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/replay_routes.h"

#include <gmock/gmock.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Replays of the event e1 that end when the test asks for their result.
class KnownReplays : public RecordedReplays {
 public:
  void start() override { is_running = true; }
  void stop() override { is_running = false; }
  std::chrono::nanoseconds cpu_time() const override { return std::chrono::nanoseconds(0); }

  Result<std::uint64_t> begin(const ReplayRequest& request) override {
    if (request.event != "e1") return fail("there is no event of this name");
    if (status_.state == ReplayState::Measuring) return fail("another replay is running");
    newest = request;
    status_.number += 1;
    status_.state = ReplayState::Measuring;
    status_.event = request.event;
    status_.recipe = request.recipe;
    return status_.number;
  }
  ReplayStatus status() const override { return status_; }
  Result<std::shared_ptr<const ReplayResult>> result(std::uint64_t number) const override {
    if (number != status_.number) return fail("there is no result");
    auto result = std::make_shared<ReplayResult>();
    result->number = number;
    ReplayedAlarm& alarm = result->alarms.emplace_back();
    alarm.name = "1, pool: hot_spot_width";
    alarm.differs = true;
    alarm.now.push_back(
        {signals::AlarmLevel::HighWarning, "2026-11-28T09:22:00Z", "2026-11-28T09:22:01Z", 4, 9});
    ReplayedSignal& signal = result->signals.emplace_back();
    signal.region = "pool";
    signal.figure = "hot_spot_width";
    signal.unit = "mm";
    return result;
  }
  Result<RecordedCourse> course(std::uint64_t number, const std::string& region,
                                const std::string& figure) const override {
    if (number != status_.number || region != "pool" || figure != "width") return fail("no signal");
    return RecordedCourse{"mm", {"2026-11-28T09:22:00Z"}, {4}, {12}, {13}};
  }
  Result<> cancel(std::uint64_t number) override {
    if (number != status_.number || status_.state == ReplayState::None) return fail("has ended");
    status_.state = ReplayState::None;
    return {};
  }

  std::atomic<bool> is_running{false};
  ReplayRequest newest;

 private:
  ReplayStatus status_;
};

class ReplayRoutes : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    context.replays = replays;
    context.state_folder = folder.path();
    serve(context);
  }
  void TearDown() override { sink.reset(); }  // it writes into the folder
  Answer post(const std::string& path, const json& body) const {
    return request(port(), "POST", "/api/v1/" + path, kJsonHeader, body.dump());
  }
  Answer read(const std::string& path) const { return get(port(), "/api/v1/recordings/" + path); }

  const orbwatch::tests::TemporaryFolder folder;
  const std::shared_ptr<KnownReplays> replays = std::make_shared<KnownReplays>();
};

TEST_F(ReplayRoutes, AreMeasuredWhileThePageIsServed) {
  EXPECT_TRUE(replays->is_running);
  sink.reset();
  EXPECT_FALSE(replays->is_running);
}

TEST_F(ReplayRoutes, SendWhatARecipeWouldHaveRaised) {
  EXPECT_EQ(json::parse(read("replay").body)["state"], "none");
  const Answer begun = post("replay_recording", {{"event", "e1"}, {"recipe", 2}});
  ASSERT_EQ(begun.status, 200) << begun.body;
  EXPECT_EQ(replays->newest.recipe, 2);
  EXPECT_EQ(json::parse(read("replay").body)["state"], "measuring");
  const json result = json::parse(read("replayed?number=1").body);
  EXPECT_EQ(result["alarms"][0]["computed"][0]["level_text"], "high warning");
  EXPECT_EQ(result["alarms"][0]["computed"][0]["first"], 4);
  EXPECT_EQ(result["alarms"][0]["recorded"], json::array());
  EXPECT_EQ(result["signals"][0]["largest"], nullptr);
  EXPECT_EQ(read("replayed?number=2").status, 404);
  const std::string signal = "replayed_signal?number=1&region=pool&figure=";
  EXPECT_EQ(json::parse(read(signal + "width").body)["high"][0], 13);
  EXPECT_EQ(read(signal + "..%2Fx").status, 404);
}

TEST_F(ReplayRoutes, TakeTheSelectedRecipe) {
  const auto status = app::tests::make_status();
  sink->accept(status);
  ASSERT_EQ(post("replay_recording", {{"event", "e1"}}).status, 200);
  EXPECT_EQ(replays->newest.recipe, status.recipe);
}

TEST_F(ReplayRoutes, AreCancelledAndInTheAudit) {
  EXPECT_EQ(post("replay_recording", {{"event", "e1"}, {"recipe", 2}}).status, 200);
  EXPECT_EQ(post("replay_recording", {{"event", "e1"}, {"recipe", 1}}).status, 409);
  EXPECT_EQ(post("cancel_replay", {{"number", 2}}).status, 409);
  EXPECT_EQ(post("cancel_replay", {{"number", 1}}).status, 200);
  EXPECT_EQ(post("replay_recording", {{"event", "../e1"}}).status, 409);
  const json audit = json::parse(get(port(), "/api/v1/audit").body)["entries"];
  ASSERT_GE(audit.size(), 3U);
  EXPECT_EQ(audit[0]["what"], "replay_recording");
  EXPECT_EQ(audit[0]["after"], "e1 recipe 2");
}

TEST_F(ReplayRoutes, LongNamesAreCutInTheAudit) {
  const std::string name(300, 'x');
  EXPECT_EQ(post("replay_recording", {{"event", name}, {"recipe", 2}}).status, 409);
  const json audit = json::parse(get(port(), "/api/v1/audit").body)["entries"];
  EXPECT_EQ(audit.back()["after"], name.substr(0, 100) + " recipe 2");
}

TEST_F(ReplayRoutes, RefuseWhatIsNoReplay) {
  EXPECT_EQ(post("replay_recording", {{"recipe", 1}}).status, 400);
  EXPECT_EQ(post("replay_recording", {{"event", "e1"}, {"recipe", 70000}}).status, 400);
  EXPECT_EQ(post("replay_recording", {{"event", "e1"}, {"recipe", -1}}).status, 400);
  EXPECT_EQ(read("replayed?number=0").status, 400);
  serve(make_context());
  EXPECT_THAT(read("replay").body, HasSubstr(R"("number":0)"));
  EXPECT_EQ(read("replayed?number=1").status, 404);
  EXPECT_EQ(post("replay_recording", {{"event", "e1"}}).status, 404);
  EXPECT_EQ(post("cancel_replay", {{"number", 1}}).status, 404);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
