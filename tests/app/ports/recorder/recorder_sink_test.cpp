// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/recorder_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "hal/mcap/reader.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"
#include "tests/support/reference_data.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;
using Lines = std::multiset<std::string>;
using orbwatch::tests::RecordedMachine;
using recorder::RecorderStatistics;

/// Waits for the recorder, whose thread works for itself.
bool eventually(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // polls another thread
  }
  return true;
}

/// Frame set `n` of a machine, with figures that differ from set to set.
Status status_of(std::uint64_t n) {
  Status status;
  status.frame_set = n;
  status.stamp = hal::Clock::now();
  status.recipe = 1;
  status.region_count = status.camera_count = 1;
  status.regions[0].quality = Quality::Good;
  for (const auto& signal : signals::kSignals) {
    status.regions[0].signals.*signal.member = 1.0 / static_cast<double>(n);
  }
  status.machine.quality = MachineQuality::Good;
  status.machine.part = *PartName::make("Flügel 7");
  status.machine.values.layer = static_cast<double>(n);
  return status;
}

class Recorder : public testing::Test {
 protected:
  RecorderSettings settings() const { return {.folder = folder_ / "recordings"}; }
  std::unique_ptr<RecorderSink> started(const RecorderSettings& settings) {
    auto sink = std::make_unique<RecorderSink>(settings, names_, texts_);
    EXPECT_TRUE(sink->start());
    return sink;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(settings().folder)) all.push_back(entry.path());
    std::ranges::sort(all);
    return all;
  }
  RecorderSettings settings_with_events() const {
    RecorderSettings site = settings();
    site.events.emplace();
    site.events->ring_mib = 1;
    site.events->before = site.events->after = std::chrono::milliseconds(50);
    return site;
  }
  /// The pipeline's part of frame set `n` of a RecordedMachine.
  static void pass_set(RecorderSink& sink, std::uint64_t n) {
    hal::FrameSet set;
    set.id = n;
    set.stamp = RecordedMachine::at(n);
    set.frames[0] = orbwatch::tests::painted_frame(n, 0, set.stamp, RecordedMachine::kWidth,
                                                   RecordedMachine::kHeight);
    sink.accept_frames(set);
    Status status = status_of(n);
    status.stamp = set.stamp;
    sink.accept(status);
  }
  static std::uint64_t messages_in(const fs::path& file) {
    auto reader = hal::mcap::Reader::open(file);
    EXPECT_TRUE(reader) << reader.error().message;
    std::uint64_t count = 0;
    for (std::size_t n = 0; reader && n < reader->summary().chunks.size(); ++n) {
      EXPECT_TRUE(reader->load_chunk(n));
      while (reader->next()) ++count;
    }
    return count;
  }

  const orbwatch::tests::TemporaryFolder folder_;
  const StatusNames names_{{"thermal"}, {}, {{1, {"pool"}}}};
  const RecordedTexts texts_{{{"site.toml", "rig = \"rig.toml\""}, {"rig.toml", "[ball]"}},
                             {{"orbwatch", "0.1.0"}}};
};

TEST_F(Recorder, EveryFrameSetIsInTheFileOnce) {
  auto sink = started(settings());
  constexpr std::uint64_t kSets = 100;
  for (std::uint64_t n = 1; n <= kSets; ++n) {
    sink->accept(status_of(n));
    sink->accept(status_of(n));  // a heartbeat repeats the set
  }
  sink->stop();
  const RecorderStatistics statistics = sink->statistics();
  EXPECT_EQ(statistics.recorded, kSets);
  EXPECT_EQ(statistics.lost, 0U);
  ASSERT_EQ(files().size(), 1U);
  EXPECT_EQ(messages_in(files().front()), kSets);
  EXPECT_GE(statistics.bytes, 1000U);
}

TEST_F(Recorder, OthersReadEachFigureByItsDefinition) {
  const fs::path packages = fs::path(ORBWATCH_SOURCE_DIR) / "build/mcap-readers/node_modules";
  ORBWATCH_REQUIRE_FILE(packages / "@foxglove/rosmsg2-serialization");
  auto sink = started(settings());
  Lines expected;
  for (std::uint64_t n = 1; n <= 20; ++n) {
    const Status status = status_of(n);
    const auto utc = hal::to_utc(status.stamp);
    const auto second = std::chrono::floor<std::chrono::seconds>(utc);
    char stamp[64];
    std::snprintf(stamp, sizeof stamp, "%lld.%09lld",
                  static_cast<long long>(second.time_since_epoch().count()),
                  static_cast<long long>(std::chrono::nanoseconds(utc - second).count()));
    const std::string at =
        "/orbwatch/process_state orbwatch_msgs/msg/ProcessState " + std::to_string(n) + " ";
    for (const auto& [component, readings] : status_readings({status, names_, status.stamp, utc})) {
      const bool is_recorded = component.kind == "region" || component.kind == "machine";
      for (const Reading& reading : readings) {
        if (!is_recorded) continue;
        std::ostringstream line;
        line << at << component.kind << " " << component.name << " " << reading.name << " ";
        if (std::isnan(reading.value)) {
          line << "nan";
        } else {
          line << std::hex << std::bit_cast<std::uint64_t>(reading.value);
        }
        line << " " << reading.unit << " " << reading.text;
        expected.insert(line.str());
      }
    }
    sink->accept(status);
  }
  sink->stop();

  ::setenv("NODE_PATH", packages.c_str(), 1);
  const std::string script = ORBWATCH_SOURCE_DIR "/tests/app/ports/recorder/read_log.mjs";
  orbwatch::tests::Subprocess program({"/usr/bin/node", script, files().front()},
                                      folder_ / "printed");
  ASSERT_EQ(program.wait(), 0) << program.output();
  Lines read;
  std::istringstream output(program.output());
  for (std::string line; std::getline(output, line);) {
    const bool is_compared =
        line.find(" region ") != std::string::npos || line.find(" machine ") != std::string::npos;
    // The stamp stands between the frame set's number and the component.
    const std::size_t set = line.find(' ', line.find("ProcessState ") + 13);
    const std::size_t part = line.find(' ', set + 1);
    if (is_compared) read.insert(line.erase(set, part - set));
  }
  EXPECT_EQ(read, expected);
  EXPECT_THAT(program.output(), testing::HasSubstr("attachment rig.toml [ball]"));
  EXPECT_THAT(program.output(), testing::HasSubstr("versions orbwatch 0.1.0"));
}

TEST_F(Recorder, AFileThatWasNotEndedIsFinishedByTheNextRun) {
  fs::create_directories(settings().folder);
  const fs::path torn = settings().folder / "log-20261128T090000Z.mcap";
  {
    auto sink = started(settings());
    for (std::uint64_t n = 1; n <= 50; ++n) sink->accept(status_of(n));
    ASSERT_TRUE(eventually([&] { return sink->statistics().recorded == 50; }));
    // The disk's content as after a power failure now.
    fs::copy_file(files().front(), torn);
    sink->stop();
  }
  fs::resize_file(torn, fs::file_size(torn) - 3);  // and the last record is torn
  {
    auto reader = hal::mcap::Reader::open(torn);
    ASSERT_TRUE(reader);
    EXPECT_FALSE(reader->is_finished());
  }
  auto sink = started(settings());
  sink->accept(status_of(1));
  ASSERT_TRUE(eventually([&] { return sink->statistics().recorded == 1; }));
  auto reader = hal::mcap::Reader::open(torn);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->is_finished());
}

TEST_F(Recorder, TheOldestAreDeletedAtTheLimitAndOthersStay) {
  const fs::path folder = settings().folder;
  fs::create_directories(folder);
  const auto fill = [&](const std::string& name, std::uintmax_t bytes) {
    std::ofstream(folder / name) << "x";
    fs::resize_file(folder / name, bytes);
  };
  constexpr std::uintmax_t kBig = std::uintmax_t{100} << 20;
  for (const char* day : {"01", "02", "03", "04"}) {
    fill("log-202601" + std::string(day) + "T000000Z.mcap", kBig);
  }
  fill("my-own.mcap", kBig);
  RecorderSettings small = settings();
  small.limit_mib = 256;
  auto sink = started(small);
  sink->accept(status_of(1));
  ASSERT_TRUE(eventually([&] { return sink->statistics().recorded == 1; }));
  sink->stop();
  EXPECT_EQ(sink->statistics().removed, 2U);
  EXPECT_FALSE(fs::exists(folder / "log-20260101T000000Z.mcap"));
  EXPECT_FALSE(fs::exists(folder / "log-20260102T000000Z.mcap"));
  EXPECT_TRUE(fs::exists(folder / "log-20260103T000000Z.mcap"));
  EXPECT_TRUE(fs::exists(folder / "my-own.mcap"));
}

TEST_F(Recorder, ADiskWithoutRoomIsAFaultAndRecordingGoesOnWithTheDisk) {
  RecorderSettings greedy = settings();
  greedy.reserve_mib = 1'000'000'000;
  auto sink = started(greedy);
  ASSERT_TRUE(eventually([&] {
    sink->accept(status_of(1));
    return !sink->works();
  }));
  std::uint64_t n = 1;
  ASSERT_TRUE(eventually([&] {
    sink->accept(status_of(++n));
    return sink->statistics().lost > 0;
  }));
  EXPECT_TRUE(sink->statistics().fault);
  EXPECT_EQ(sink->statistics().recorded, 0U);
}

TEST_F(Recorder, AFolderThatCannotBeMadeIsAFaultUntilItCan) {
  const fs::path in_the_way = folder_ / "recordings";
  std::ofstream(in_the_way) << "a file";
  auto sink = started(settings());
  std::uint64_t n = 0;
  ASSERT_TRUE(eventually([&] {
    sink->accept(status_of(++n));
    return !sink->works();
  }));
  fs::remove(in_the_way);
  ASSERT_TRUE(eventually([&] {
    sink->accept(status_of(++n));
    return sink->statistics().recorded > 0;
  }));
  EXPECT_TRUE(sink->works());
}

TEST_F(Recorder, AnEventByCommandIsRecordedBesideTheLogOnceTheDiskIsThere) {
  const RecorderSettings site = settings_with_events();
  RecorderSink sink(site, names_, texts_, RecordedMachine::cameras());
  std::uint64_t n = 0;
  const auto record_event = [&] {
    for (int k = 0; k < 10; ++k) pass_set(sink, ++n);
    EXPECT_TRUE(sink.request_event());
    for (int k = 0; k < 20; ++k) pass_set(sink, ++n);
  };
  // The folder of events is in the way of another file.
  fs::create_directories(site.folder);
  std::ofstream(site.folder / "events") << "a file";
  ASSERT_TRUE(sink.start());
  record_event();
  ASSERT_TRUE(eventually([&] { return sink.statistics().recordings_lost == 1; }));
  EXPECT_FALSE(sink.works());
  fs::remove(site.folder / "events");
  ASSERT_TRUE(eventually([&] {
    pass_set(sink, ++n);
    return sink.works();
  }));
  record_event();
  ASSERT_TRUE(eventually([&] { return sink.statistics().recordings == 1; }));
  sink.stop();
  EXPECT_GE(sink.statistics().pictures, 9U);
  EXPECT_GT(sink.statistics().recorded, 0U);
  EXPECT_EQ(std::distance(fs::directory_iterator(site.folder / "events"), {}), 1);
}

TEST_F(Recorder, AnEventThatWaitsForAFrameSetIsRecordedAtTheStop) {
  const RecorderSettings site = settings_with_events();
  RecorderSink sink(site, names_, texts_, RecordedMachine::cameras());
  ASSERT_TRUE(sink.start());
  pass_set(sink, 1);
  EXPECT_TRUE(sink.request_event());
  sink.stop();
  EXPECT_EQ(sink.statistics().recordings, 1U);
  EXPECT_EQ(sink.statistics().pictures, 1U);
  EXPECT_EQ(std::distance(fs::directory_iterator(site.folder / "events"), {}), 1);
}

TEST_F(Recorder, AnEventThatWaitsAtTheStopWithoutADiskIsCounted) {
  const RecorderSettings site = settings_with_events();
  std::ofstream(site.folder) << "a file in the way";
  RecorderSink sink(site, names_, texts_, RecordedMachine::cameras());
  ASSERT_TRUE(sink.start());
  pass_set(sink, 1);
  EXPECT_TRUE(sink.request_event());
  sink.stop();
  EXPECT_EQ(sink.statistics().recordings, 0U);
  EXPECT_EQ(sink.statistics().recordings_lost, 1U);
}

TEST_F(Recorder, WithoutARingNoEventCanBeRequested) {
  EXPECT_FALSE(started(settings())->request_event());
}

TEST_F(Recorder, TheSenderNeverWaitsAndEveryLossIsCounted) {
  auto sink = std::make_unique<RecorderSink>(settings(), names_, texts_);  // no thread takes any
  constexpr std::uint64_t kSets = 1000;
  for (std::uint64_t n = 1; n <= kSets; ++n) sink->accept(status_of(n));
  const std::uint64_t refused = sink->statistics().lost;
  EXPECT_GT(refused, 0U);
  EXPECT_TRUE(sink->start());
  ASSERT_TRUE(eventually([&] { return sink->statistics().recorded + refused == kSets; }));
}

}  // namespace
}  // namespace orbwatch::app
