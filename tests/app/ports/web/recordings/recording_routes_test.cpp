// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/recording_routes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "tests/app/ports/web/access/access_served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Events as the recorder has them, with the files of each in a folder.
class Events : public RecordedEvents {
 public:
  explicit Events(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& name, const std::string& recording) {
    std::ofstream(folder_ / (name + ".mcap")) << recording;
    std::ofstream(folder_ / (name + ".jpg")) << "picture of " << name;
    RecordedEvent event;
    event.name = name;
    event.trigger = "alarm";
    event.text = "melt pool: too large";
    event.alarm = {"pool", "hot_spot_width", signals::AlarmLevel::HighAlarm, 27.25, "mm"};
    event.triggered = "2026-11-28T12:00:00Z";
    event.part = "blade 7";
    event.layer = 12;
    event.bytes = recording.size();
    events_.push_back(event);
    list_ = nullptr;
  }

  Result<std::shared_ptr<const std::vector<RecordedEvent>>> list() override {
    const std::lock_guard lock(mutex_);
    if (!list_) list_ = std::make_shared<std::vector<RecordedEvent>>(events_);
    return list_;
  }
  Result<std::filesystem::path> recording(std::string_view event) const override {
    return file(event, ".mcap");
  }
  Result<std::filesystem::path> picture(std::string_view event) const override {
    return file(event, ".jpg");
  }
  Result<std::vector<RecordedFrames>> frames(std::string_view event) override {
    return file(event, ".mcap").map([](const auto&) {
      return std::vector<RecordedFrames>{
          {"thermal", {"2026-11-28T12:00:00Z"}, {{0, 8, 4, 40, 30}}}};
    });
  }
  Result<std::string> frame(std::string_view event, std::string_view camera,
                            std::size_t frame) override {
    return file(event, ".mcap").map([&](const auto&) {
      return std::string(camera) + " " + std::to_string(frame);
    });
  }
  Result<std::vector<RecordedSignal>> signals(std::string_view event) override {
    return file(event, ".mcap").map([](const auto&) {
      return std::vector<RecordedSignal>{{"pool", "width", "mm"}, {"", "layer", ""}};
    });
  }
  Result<std::vector<RecordedRecipeChange>> recipes(std::string_view event) override {
    return file(event, ".mcap").map([](const auto&) {
      return std::vector<RecordedRecipeChange>{{"2026-11-28T12:00:00Z", 3}};
    });
  }
  Result<RecordedCourse> course(std::string_view event, const std::string& region,
                                const std::string& figure) override {
    return file(event, ".mcap").and_then([&](const auto&) -> Result<RecordedCourse> {
      if (region != "pool") return fail("the event has no signal " + figure);
      return RecordedCourse{
          "mm", {"2026-11-28T12:00:00Z", ""}, {7, 8}, {1.5, signals::kNotValid}, {2, 3}};
    });
  }
  Result<> set_pinned(std::string_view event, bool is_pinned) override {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(events_, event, &RecordedEvent::name);
    if (found == events_.end()) return fail("there is no event of this name");
    found->is_pinned = is_pinned;
    list_ = nullptr;
    return {};
  }
  Result<> remove(std::string_view event) override {
    const std::lock_guard lock(mutex_);
    const auto gone = std::erase_if(events_, [&](const auto& one) { return one.name == event; });
    if (gone == 0) return fail("there is no event of this name");
    list_ = nullptr;
    return {};
  }

 private:
  Result<std::filesystem::path> file(std::string_view event, const char* ending) const {
    const std::lock_guard lock(mutex_);
    const auto is_it = [&](const RecordedEvent& one) { return one.name == event; };
    if (std::ranges::none_of(events_, is_it)) return fail("there is no event of this name");
    return folder_ / (std::string(event) + ending);
  }

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::vector<RecordedEvent> events_;
  std::shared_ptr<const std::vector<RecordedEvent>> list_;
};

/// The event e1 alone has a configuration.
Result<std::vector<RecordedRecipe>> regions_in(const std::filesystem::path& recording) {
  const std::string name = recording.filename().string();
  if (name != "e1.mcap") return fail("no configuration in it");
  return std::vector<RecordedRecipe>{{3, {{name, "thermal", {{{1.5, 2}, {3, 4}}}}}}};
}

class RecordingRoutes : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    context.events = events;
    context.regions = regions_in;
    context.state_folder = folder.path();
    serve(context);
  }
  void TearDown() override { sink.reset(); }  // it writes into the folder
  json list() const { return json::parse(get(port(), "/api/v1/recordings").body); }
  Answer post(const std::string& path, const json& body) const {
    return request(port(), "POST", path, kJsonHeader, body.dump());
  }

  const orbwatch::tests::TemporaryFolder folder;
  const std::shared_ptr<Events> events = std::make_shared<Events>(folder.path());
};

TEST_F(RecordingRoutes, ListTheNewestFirst) {
  events->add("20261128-120000-alarm", "first");
  events->add("20261128-130000-alarm", "second one");
  const json all = list();
  EXPECT_TRUE(all["missing"].is_null());
  ASSERT_EQ(all["events"].size(), 2U);
  const json& newest = all["events"][0];
  EXPECT_EQ(newest["name"], "20261128-130000-alarm");
  EXPECT_EQ(newest["cause"], "melt pool: too large");
  EXPECT_EQ(newest["alarm"]["region"], "pool");
  EXPECT_EQ(newest["alarm"]["level_text"], "high alarm");
  EXPECT_EQ(newest["alarm"]["value"], 27.25);
  EXPECT_EQ(newest["line"], "");
  EXPECT_EQ(newest["part"], "blade 7");
  EXPECT_EQ(newest["layer"], 12);
  EXPECT_EQ(newest["bytes"], 10);
  EXPECT_EQ(newest["is_pinned"], false);
}

TEST_F(RecordingRoutes, SearchTheEvents) {
  for (const char* name : {"e1", "e2", "e3"}) events->add(name, "recording");
  const auto search = [&](const std::string& query) {
    return json::parse(get(port(), "/api/v1/recordings?" + query).body);
  };
  const json newest = search("limit=2&part=BLADE%207&layer=12&to=2026-11-28T12:00:00Z");
  ASSERT_EQ(newest["events"].size(), 2U);
  EXPECT_EQ(newest["events"][1]["name"], "e2");
  EXPECT_EQ(newest["matching"], 3);
  EXPECT_EQ(newest["has_older"], true);
  const json older = search("before=e2");
  ASSERT_EQ(older["events"].size(), 1U);
  EXPECT_EQ(older["has_older"], false);
  EXPECT_EQ(search("trigger=line")["matching"], 0);
  for (const char* wrong : {"limit=0", "limit=1001", "limit=x", "layer=x", "from=yesterday"}) {
    EXPECT_EQ(get(port(), std::string("/api/v1/recordings?") + wrong).status, 400) << wrong;
  }
}

TEST_F(RecordingRoutes, SendAListAgainOnlyWhenItDiffers) {
  events->add("e1", "recording");
  const auto ask = [&](const std::string& tag) {
    return request(port(), "GET", "/api/v1/recordings", "If-None-Match: " + tag + "\r\n", "");
  };
  const std::string tag = ask("none").headers.at("ETag");
  const Answer again = ask(tag);
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(again.body, "");
  EXPECT_TRUE(events->set_pinned("e1", true));
  const Answer pinned = ask(tag);
  EXPECT_EQ(pinned.status, 200);
  EXPECT_NE(pinned.headers.at("ETag"), tag);
  EXPECT_EQ(json::parse(pinned.body)["events"][0]["is_pinned"], true);
  EXPECT_EQ(ask(pinned.headers.at("ETag")).status, 304);
}

TEST_F(RecordingRoutes, SendTheFilesOfAnEvent) {
  // Larger than the blocks and buffers of the server.
  std::string recording(3 << 20, '\0');
  for (std::size_t n = 0; n < recording.size(); ++n) recording[n] = static_cast<char>(n * 31 / 7);
  events->add("e1", recording);
  const Answer sent = get(port(), "/api/v1/recordings/event.mcap?event=e1");
  EXPECT_EQ(sent.status, 200);
  EXPECT_TRUE(sent.body == recording);
  EXPECT_EQ(sent.headers.at("Content-Disposition"), "attachment; filename=\"e1.mcap\"");
  const Answer picture = get(port(), "/api/v1/recordings/trigger.jpg?event=e1");
  EXPECT_EQ(picture.body, "picture of e1");
  EXPECT_EQ(picture.headers.at("Content-Type"), "image/jpeg");
}

TEST_F(RecordingRoutes, SendSinglePictures) {
  events->add("e1", "recording");
  const Answer frames = get(port(), "/api/v1/recordings/frames?event=e1");
  EXPECT_EQ(json::parse(frames.body), json::parse(R"({"cameras": [{"camera": "thermal",
      "times": ["2026-11-28T12:00:00Z"],
      "parts": [{"first": 0, "x": 8, "y": 4, "width": 40, "height": 30}]}]})"));
  const std::string path = "/api/v1/recordings/frame.jpg?event=e1&camera=thermal&frame=";
  EXPECT_EQ(get(port(), path + "7").body, "thermal 7");
  EXPECT_EQ(get(port(), path + "-1").status, 400);
  EXPECT_EQ(get(port(), "/api/v1/recordings/frames?event=e2").status, 404);
}

TEST_F(RecordingRoutes, SendSignalsOverTime) {
  events->add("e1", "recording");
  const Answer all = get(port(), "/api/v1/recordings/signals?event=e1");
  EXPECT_EQ(json::parse(all.body), json::parse(R"({"signals": [
      {"region": "pool", "figure": "width", "unit": "mm"},
      {"region": "", "figure": "layer", "unit": ""}]})"));
  const std::string path = "/api/v1/recordings/signal?event=e1&figure=width";
  EXPECT_EQ(json::parse(get(port(), path + "&region=pool").body), json::parse(R"({"unit": "mm",
      "times": ["2026-11-28T12:00:00Z", ""], "frame_sets": [7, 8], "low": [1.5, null],
      "high": [2, 3]})"));
  const Answer none = get(port(), path);
  EXPECT_EQ(none.status, 404);
  EXPECT_THAT(none.body, HasSubstr("no signal width"));
  EXPECT_EQ(get(port(), "/api/v1/recordings/signals?event=e2").status, 404);
  EXPECT_EQ(get(port(), "/api/v1/recordings/signal?event=e1").status, 400);
}

TEST_F(RecordingRoutes, SendTheRegionsOfTheRecordedRecipes) {
  events->add("e1", "recording");
  const std::string path = "/api/v1/recordings/regions?event=";
  EXPECT_EQ(json::parse(get(port(), path + "e1").body), json::parse(R"({
      "changes": [{"time": "2026-11-28T12:00:00Z", "recipe": 3}],
      "recipes": [{"number": 3, "regions": [
          {"name": "e1.mcap", "camera": "thermal", "lines": [[[1.5, 2], [3, 4]]]}]}]})"));
  events->add("e2", "another");
  const Answer without = get(port(), path + "e2");
  EXPECT_EQ(without.status, 409);
  EXPECT_THAT(without.body, HasSubstr("no configuration in it"));
  EXPECT_EQ(get(port(), path + "e3").status, 404);
}

TEST_F(RecordingRoutes, RefuseWhatIsNoEventOrHasNoFile) {
  events->add("e1", "recording");
  for (const char* file : {"event.mcap", "trigger.jpg"}) {
    const std::string path = std::string("/api/v1/recordings/") + file;
    EXPECT_EQ(get(port(), path).status, 400);
    EXPECT_EQ(get(port(), path + "?event=..%2Fe1").status, 404);
  }
  std::filesystem::remove(folder.path() / "e1.jpg");
  const Answer gone = get(port(), "/api/v1/recordings/trigger.jpg?event=e1");
  EXPECT_EQ(gone.status, 404);
  EXPECT_THAT(gone.body, HasSubstr("No such file"));
  std::filesystem::create_directory(folder.path() / "e1.jpg");
  EXPECT_THAT(get(port(), "/api/v1/recordings/trigger.jpg?event=e1").body,
              HasSubstr("not a regular file"));
}

TEST_F(RecordingRoutes, PinAndDeleteWithARecordInTheAudit) {
  events->add("e1", "recording");
  EXPECT_EQ(post("/api/v1/pin_recording", {{"event", "e1"}, {"is_pinned", true}}).status, 200);
  EXPECT_EQ(list()["events"][0]["is_pinned"], true);
  EXPECT_EQ(post("/api/v1/pin_recording", {{"event", "e2"}, {"is_pinned", true}}).status, 409);
  EXPECT_EQ(post("/api/v1/remove_recording", {{"event", "e1"}}).status, 200);
  EXPECT_EQ(list()["events"], json::array());
  EXPECT_EQ(post("/api/v1/remove_recording", {{"event", "e1"}}).status, 409);
  const json audit = json::parse(get(port(), "/api/v1/audit").body)["entries"];
  ASSERT_GE(audit.size(), 3U);
  EXPECT_EQ(audit[0]["after"], "e1 pinned");
  EXPECT_EQ(audit[2]["what"], "remove_recording");
  EXPECT_EQ(audit[2]["after"], "e1 deleted");
}

TEST_F(RecordingRoutes, LongNamesAreCutInTheAudit) {
  const std::string name(300, 'x');
  EXPECT_EQ(post("/api/v1/pin_recording", {{"event", name}, {"is_pinned", true}}).status, 409);
  EXPECT_EQ(post("/api/v1/remove_recording", {{"event", name}}).status, 409);
  const json audit = json::parse(get(port(), "/api/v1/audit").body)["entries"];
  ASSERT_EQ(audit.size(), 2U);
  EXPECT_EQ(audit[0]["after"], name.substr(0, 100) + " pinned");
  EXPECT_EQ(audit[1]["after"], name.substr(0, 100) + " deleted");
}

/// Recordings of an appliance that has users.
class RecordingsOfUsers : public AccessServed {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    add_one_of_each_role();
    WebContext context = make_context();
    context.events = events;
    context.state_folder = state_folder;
    WebSettings settings;
    settings.request_timeout = std::chrono::minutes(1);  // a client that pauses is not overdue
    serve(context, settings);
  }

  const orbwatch::tests::TemporaryFolder recordings;
  const std::shared_ptr<Events> events = std::make_shared<Events>(recordings.path());
};

TEST_F(RecordingsOfUsers, ADownloadEndsWithItsToken) {
  const std::string recording(32 << 20, 'x');  // more than all buffers on the way
  events->add("e1", recording);
  Client download(port(), 4096);
  download.send(
      request_text("GET", "/api/v1/recordings/event.mcap?event=e1", by_token(Role::Viewer)));
  EXPECT_THAT(download.take_until("\r\n\r\n"), testing::StartsWith("HTTP/1.1 200"));
  const Answer revoked = post("/api/v1/revoke_token", R"({"name":"viewer"})",
                              by_token(Role::Administrator) + kJsonHeader);
  EXPECT_EQ(revoked.status, 200) << revoked.body;
  EXPECT_TRUE(eventually([&] { return sink->statistics().connections == 0; }));
  EXPECT_LT(download.rest().size(), recording.size());
  EXPECT_EQ(sink->statistics().overdue, 0U);
}

TEST_F(RecordingRoutes, SayWhichKeyIsMissingWithoutARecorder) {
  WebContext context = make_context();
  serve(context);
  EXPECT_THAT(list()["missing"].get<std::string>(), HasSubstr("[recorder.events]"));
  EXPECT_EQ(get(port(), "/api/v1/recordings/event.mcap?event=e1").status, 404);
  EXPECT_EQ(post("/api/v1/remove_recording", {{"event", "e1"}}).status, 404);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
