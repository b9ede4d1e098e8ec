// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/export_routes.h"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Exports that are ready at once.
class QuickExports : public RecordedExports {
 public:
  explicit QuickExports(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void start() override { is_running = true; }
  void stop() override { is_running = false; }
  std::chrono::nanoseconds cpu_time() const override { return std::chrono::nanoseconds(0); }

  Result<std::uint64_t> begin(const ExportRequest& request) override {
    if (request.event != "e1") return fail("there is no event of this name");
    newest = request;
    status_.number += 1;
    status_.state = ExportState::Ready;
    status_.event = request.event;
    status_.user = request.user;
    status_.file = "e1.csv";
    std::ofstream(folder_ / "export") << "table";
    return status_.number;
  }
  ExportStatus status() const override { return status_; }
  Result<std::filesystem::path> file(std::uint64_t number) const override {
    if (number != status_.number || status_.state != ExportState::Ready) return fail("no file");
    return folder_ / "export";
  }
  Result<> remove(std::uint64_t number) override {
    if (number != status_.number || status_.state != ExportState::Ready) return fail("has ended");
    status_.state = ExportState::None;
    std::filesystem::remove(folder_ / "export");
    return {};
  }

  void show_event(std::string event) { status_.event = std::move(event); }

  std::atomic<bool> is_running{false};
  ExportRequest newest;

 private:
  const std::filesystem::path folder_;
  ExportStatus status_;
};

class ExportRoutes : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    context.exports = exports;
    context.state_folder = folder.path();
    serve(context);
  }
  void TearDown() override { sink.reset(); }  // it writes into the folder
  Answer post(const std::string& path, const json& body) const {
    return request(port(), "POST", "/api/v1/" + path, kJsonHeader, body.dump());
  }
  json status() const { return json::parse(get(port(), "/api/v1/recordings/export").body); }

  const orbwatch::tests::TemporaryFolder folder;
  const std::shared_ptr<QuickExports> exports = std::make_shared<QuickExports>(folder.path());
};

TEST_F(ExportRoutes, AreMadeWhileThePageIsServed) {
  EXPECT_TRUE(exports->is_running);
  sink.reset();
  EXPECT_FALSE(exports->is_running);
}

TEST_F(ExportRoutes, SendAFileOnce) {
  EXPECT_EQ(status()["state"], "none");
  const Answer begun = post("export_recording", {{"event", "e1"},
                                                 {"format", "avi"},
                                                 {"camera", "thermal"},
                                                 {"from", "12"},
                                                 {"to", "20"},
                                                 {"draws", true}});
  ASSERT_EQ(begun.status, 200) << begun.body;
  EXPECT_EQ(json::parse(begun.body)["number"], 1);
  EXPECT_EQ(exports->newest.format, ExportFormat::Avi);
  EXPECT_EQ(exports->newest.camera, "thermal");
  EXPECT_EQ(exports->newest.from, "12");
  EXPECT_EQ(exports->newest.to, "20");
  EXPECT_TRUE(exports->newest.draws);
  EXPECT_EQ(status()["state"], "ready");
  const std::string path = "/api/v1/recordings/exported?number=";
  EXPECT_EQ(get(port(), path + "2").status, 404);
  EXPECT_EQ(request(port(), "HEAD", path + "1", "", "").status, 200) << "removes nothing";
  const Answer sent = get(port(), path + "1");
  EXPECT_EQ(sent.body, "table");
  EXPECT_EQ(sent.headers.at("Content-Disposition"), "attachment; filename=\"e1.csv\"");
  EXPECT_EQ(status()["state"], "none");
  EXPECT_EQ(get(port(), path + "1").status, 404);
}

TEST_F(ExportRoutes, AreCancelledAndInTheAudit) {
  EXPECT_EQ(post("export_recording", {{"event", "e1"}, {"format", "csv"}}).status, 200);
  EXPECT_EQ(post("cancel_export", {{"number", 2}}).status, 409);
  EXPECT_EQ(post("cancel_export", {{"number", 1}}).status, 200);
  EXPECT_FALSE(std::filesystem::exists(folder / "export"));
  EXPECT_EQ(post("export_recording", {{"event", "e2"}, {"format", "csv"}}).status, 409);
  const json audit = json::parse(get(port(), "/api/v1/audit").body)["entries"];
  ASSERT_GE(audit.size(), 3U);
  EXPECT_EQ(audit[0]["what"], "export_recording");
  EXPECT_EQ(audit[0]["after"], "e1 csv");
  EXPECT_EQ(audit[2]["what"], "cancel_export");
}

TEST_F(ExportRoutes, ValuesInTheAuditAreCutBetweenCharacters) {
  std::string uncut = "x", cut = "x";
  for (int i = 0; i < 3000; ++i) uncut += "\u00e4";
  for (int i = 0; i < 2047; ++i) cut += "\u00e4";  // 4095 bytes; one more character has 4097
  exports->show_event(uncut);
  EXPECT_EQ(post("cancel_export", {{"number", 7}}).status, 409);
  EXPECT_EQ(json::parse(get(port(), "/api/v1/audit").body)["entries"].back()["before"], cut);
}

TEST_F(ExportRoutes, RefuseWhatIsNoExport) {
  EXPECT_THAT(post("export_recording", {{"event", "e1"}, {"format", "exe"}}).body,
              HasSubstr("mcap, csv, tif, avi, zip"));
  EXPECT_EQ(post("export_recording", {{"event", "e1"}}).status, 400);
  EXPECT_EQ(get(port(), "/api/v1/recordings/exported?number=0").status, 400);
  serve(make_context());
  EXPECT_THAT(get(port(), "/api/v1/recordings/export").body, HasSubstr(R"("number":0)"));
  EXPECT_EQ(get(port(), "/api/v1/recordings/exported?number=1").status, 404);
  EXPECT_EQ(post("export_recording", {{"event", "e1"}, {"format", "csv"}}).status, 404);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
