// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/export_spool.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "tests/app/ports/recorder/export/recorded_event.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Spool : public tests::RecordedEventTest {
 protected:
  void SetUp() override {
    tests::RecordedEventTest::SetUp();
    event = recording.parent_path().filename().string();
    spool.emplace(settings());
    spool->start();
  }
  void TearDown() override { spool.reset(); }

  RecorderSettings settings(int reserve_mib = 16) const {
    RecorderSettings all{.folder = folder / "recordings", .reserve_mib = reserve_mib};
    all.events.emplace();
    return all;
  }
  ExportRequest request(ExportFormat format, const std::string& user = "") const {
    ExportRequest asked;
    asked.event = event;
    asked.format = format;
    asked.user = user;
    return asked;
  }
  /// The newest export once it has ended.
  ExportStatus end() const {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (spool->status().state == ExportState::Making) {
      if (std::chrono::steady_clock::now() > give_up) {
        ADD_FAILURE() << "the export does not end";
        break;
      }
      std::this_thread::yield();
    }
    return spool->status();
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder / "recordings/exports", none)) {
      all.push_back(entry.path());
    }
    return all;
  }

  std::string event;
  std::optional<ExportSpool> spool;
};

TEST_F(Spool, MakesEachKindOfFile) {
  const std::vector<std::pair<ExportFormat, std::string>> kinds{
      {ExportFormat::Mcap, "\x89MCAP0\r\n"},
      {ExportFormat::Csv, "utc,utc_ns"},
      {ExportFormat::Tiff, "II"},
      {ExportFormat::Avi, "RIFF"},
      {ExportFormat::Zip, "PK"}};
  for (const auto& [format, beginning] : kinds) {
    ExportRequest asked = request(format);
    asked.camera = "thermal";
    asked.draws = format == ExportFormat::Avi;
    const auto number = spool->begin(asked);
    ASSERT_TRUE(number) << number.error().message;
    const ExportStatus status = end();
    ASSERT_EQ(status.state, ExportState::Ready) << status.error;
    EXPECT_EQ(status.number, *number);
    EXPECT_THAT(status.file, testing::StartsWith(event));
    const auto file = spool->file(*number);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_THAT(tests::text_in(*file), testing::StartsWith(beginning));
    EXPECT_EQ(status.bytes, fs::file_size(*file));
    EXPECT_EQ(files().size(), 1U) << "neither the one before nor parts of this one";
  }
}

TEST_F(Spool, MakesARange) {
  ExportRequest asked = request(ExportFormat::Csv);
  asked.from = std::to_string(sets[1]);
  asked.to = std::to_string(sets[4]);
  const auto number = spool->begin(asked);
  ASSERT_TRUE(number) << number.error().message;
  ASSERT_EQ(end().state, ExportState::Ready) << end().error;
  const std::string table = tests::text_in(spool->file(*number).value());
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 4);
}

TEST_F(Spool, RefusesWhatItCannotExport) {
  ExportRequest asked = request(ExportFormat::Csv);
  asked.event = "../x";
  EXPECT_THAT(spool->begin(asked).error().message, HasSubstr("not the name of an event"));
  asked = request(ExportFormat::Csv);
  asked.from = "x";
  EXPECT_THAT(spool->begin(asked).error().message, HasSubstr("from: \"x\""));
  asked = request(ExportFormat::Csv);
  asked.draws = true;
  EXPECT_THAT(spool->begin(asked).error().message, HasSubstr("into avi only"));
  asked = request(ExportFormat::Csv);
  asked.from = "999999";
  ASSERT_TRUE(spool->begin(asked));
  EXPECT_EQ(end().state, ExportState::Failed);
  EXPECT_THAT(end().error, HasSubstr("no frame set in this range"));
  asked = request(ExportFormat::Tiff);
  asked.camera = "../../x";
  ASSERT_TRUE(spool->begin(asked));
  EXPECT_THAT(end().error, HasSubstr("no camera ../../x"));
  EXPECT_EQ(spool->status().file, event + "-______x.tif");
  EXPECT_TRUE(files().empty());
}

TEST_F(Spool, RemovesAFileThatWasTaken) {
  const auto number = spool->begin(request(ExportFormat::Csv));
  ASSERT_TRUE(number);
  ASSERT_EQ(end().state, ExportState::Ready);
  ASSERT_TRUE(spool->remove(*number));
  EXPECT_TRUE(files().empty());
  EXPECT_EQ(spool->status().state, ExportState::None);
  EXPECT_FALSE(spool->file(*number));
  EXPECT_THAT(spool->remove(*number).error().message, HasSubstr("has ended"));
}

TEST_F(Spool, LeavesNothingOfACancelledExport) {
  const auto number = spool->begin(request(ExportFormat::Zip));
  ASSERT_TRUE(number);
  EXPECT_TRUE(spool->remove(*number)) << "while it is made, or when it is ready";
  EXPECT_EQ(end().state, ExportState::None);
  spool.reset();
  EXPECT_TRUE(files().empty());
}

TEST_F(Spool, KeepsAFileFromOthersForAMinute) {
  const auto number = spool->begin(request(ExportFormat::Csv, "kim"));
  ASSERT_TRUE(number);
  ASSERT_EQ(end().state, ExportState::Ready);
  const auto other = spool->begin(request(ExportFormat::Csv, "lee"));
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("an export of kim waits for its download"));
  const auto own = spool->begin(request(ExportFormat::Csv, "kim"));
  ASSERT_TRUE(own) << own.error().message;
  EXPECT_EQ(end().state, ExportState::Ready);
  EXPECT_FALSE(spool->file(*number)) << "replaced";
}

TEST_F(Spool, GivesItsPlaceToOthersAfterItsTime) {
  spool.emplace(settings(), ExportTimes{.owned = std::chrono::seconds(0)});
  spool->start();
  const auto number = spool->begin(request(ExportFormat::Csv, "kim"));
  ASSERT_TRUE(number);
  ASSERT_EQ(end().state, ExportState::Ready);
  const auto other = spool->begin(request(ExportFormat::Csv, "lee"));
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(end().state, ExportState::Ready);
  EXPECT_FALSE(spool->file(*number));
}

TEST_F(Spool, RemovesAFileThatNobodyTakes) {
  spool.emplace(settings(), ExportTimes{.kept = std::chrono::milliseconds(1)});
  spool->start();
  const auto number = spool->begin(request(ExportFormat::Csv));
  ASSERT_TRUE(number);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (spool->status().state != ExportState::None || !files().empty()) {
    ASSERT_LT(std::chrono::steady_clock::now(), give_up);
    std::this_thread::yield();
  }
  EXPECT_EQ(spool->status().error, "");
  EXPECT_FALSE(spool->file(*number));
  EXPECT_FALSE(spool->remove(*number));
}

TEST_F(Spool, LeavesTheReserveOfTheDisk) {
  const auto free = fs::space(folder.path()).available >> 20;
  spool.emplace(settings(static_cast<int>(free) + 1024));
  spool->start();
  ASSERT_TRUE(spool->begin(request(ExportFormat::Mcap)));
  EXPECT_EQ(end().state, ExportState::Failed);
  EXPECT_THAT(end().error, HasSubstr("reserve_mib"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Spool, ForgetsFilesOfAnEarlierRun) {
  spool.reset();
  fs::create_directories(folder / "recordings/exports");
  std::ofstream(folder / "recordings/exports/7") << "of an earlier run";
  spool.emplace(settings());
  EXPECT_FALSE(spool->begin(request(ExportFormat::Csv))) << "not started";
  spool->start();
  ASSERT_TRUE(spool->begin(request(ExportFormat::Csv)));
  EXPECT_EQ(end().state, ExportState::Ready);
  EXPECT_EQ(files().size(), 1U);
  spool->stop();
  EXPECT_TRUE(files().empty());
}

TEST_F(Spool, WantOfMemoryIsAFailure) {
  const auto all = export_kinds();
  std::vector<ExportKind> kinds(all.begin(), all.end());
  std::ranges::find(kinds, ExportFormat::Csv, &ExportKind::format)->write =
      [](const ExportSource&, const fs::path&, const ExportSteps&) -> Result<> {
    throw std::bad_alloc();
  };
  spool.emplace(settings(), ExportTimes{}, kinds);
  spool->start();
  ASSERT_TRUE(spool->begin(request(ExportFormat::Csv)));
  EXPECT_EQ(end().state, ExportState::Failed);
  EXPECT_EQ(end().error, "not enough memory; export a smaller range");
  ASSERT_TRUE(spool->begin(request(ExportFormat::Mcap)));
  EXPECT_EQ(end().state, ExportState::Ready) << end().error;
  spool.reset();
}

TEST_F(Spool, DamageIsAFailure) {
  damage();
  ASSERT_TRUE(spool->begin(request(ExportFormat::Csv)));
  EXPECT_EQ(end().state, ExportState::Failed);
  EXPECT_NE(end().error, "");
}

}  // namespace
}  // namespace orbwatch::app::recorder
