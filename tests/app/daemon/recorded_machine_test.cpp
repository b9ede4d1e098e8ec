// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/recorded_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <condition_variable>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "app/daemon/site/site_check.h"
#include "app/ports/recorder/recorded_states.h"
#include "tests/app/daemon/replay/recorded_demo.h"

namespace orbwatch::app::daemon {
namespace {

using recorder::Figure;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::uint64_t kBegin = 1'700'000'000'000'000'000;
constexpr hal::TimePoint kStamp{std::chrono::hours(1)};

/// Figures of a machine in layer `layer`, whose state is 20 ms old.
std::vector<Figure> in_layer(double layer) {
  return {
      {"quality", 1, "", ""},   {"state_age", 0.02, "s", ""}, {"part", std::nan(""), "", "blade"},
      {"layer", layer, "", ""}, {"x", 12.5, "mm", ""},        {"laser_on", 1, "", ""},
      {"vx", -3, "mm/s", ""},   {"states", 77, "", ""}};
}

class RecordedMachineTest : public testing::Test {
 protected:
  /// Writes states of frame sets 100 ms apart; one without figures has no machine.
  void write(const std::vector<std::vector<Figure>>& sets) const {
    std::filesystem::remove(path_);
    tests::PictureFile file(path_);
    const auto states = file.add("/orbwatch/process_state", hal::recording::SetNumbers::kType);
    for (std::size_t n = 0; n < sets.size(); ++n) {
      recorder::ProcessState state;
      state.frame_set = n + 1;
      if (!sets[n].empty()) state.components.push_back({"machine", "", sets[n]});
      file.write(states, set_time(n), static_cast<std::uint32_t>(n), state);
    }
    file.finish();
  }
  static std::uint64_t set_time(std::size_t n) { return kBegin + n * 100'000'000; }

  std::string refusal(const std::vector<std::vector<Figure>>& sets) const {
    write(sets);
    const auto loaded = RecordedMachine(path_, kTimeout).load();
    return loaded ? std::string() : loaded.error().message;
  }

  /// A set at `stamp` with a frame that was recorded in set `n`.
  static hal::FrameSet replayed(std::size_t n, hal::TimePoint stamp) {
    hal::FrameSet set;
    set.stamp = stamp;
    auto frame = std::make_shared<hal::FrameBuffer>();
    frame->metadata.recorded_set = set_time(n);
    set.frames[1] = std::move(frame);
    return set;
  }

  static constexpr milliseconds kTimeout{500};
  const tests::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "event.mcap";
};

TEST_F(RecordedMachineTest, AFrameSetHasTheStateThatWasRecordedWithItWheneverItIsReplayed) {
  write({in_layer(3), in_layer(4), {}, in_layer(6)});
  RecordedMachine machine(path_, kTimeout);
  EXPECT_EQ(machine.follow(replayed(0, kStamp)).quality, MachineQuality::NoState) << "not loaded";
  ASSERT_TRUE(machine.load());
  for (const std::size_t n : {1U, 3U, 0U}) {
    const hal::TimePoint stamp = kStamp + milliseconds(40) * n;
    const MachineStatus& status = machine.follow(replayed(n, stamp));
    EXPECT_EQ(status.quality, MachineQuality::Good);
    EXPECT_EQ(status.part.text(), "blade");
    EXPECT_EQ(status.values.layer, static_cast<double>(3 + n));
    EXPECT_EQ(status.values.x, 12.5);
    EXPECT_EQ(status.values.laser_on, 1);
    EXPECT_EQ(status.vx, -3);
    EXPECT_TRUE(std::isnan(status.values.feed));
    EXPECT_EQ(status.state, stamp - milliseconds(20));
  }
  EXPECT_EQ(machine.follow(replayed(3, kStamp)).states, 4U) << "its own count, not the recorded";
}

TEST_F(RecordedMachineTest, NothingIsKnownOfASetWithoutAStateAndAfterTheTimeout) {
  write({in_layer(3), {}});
  RecordedMachine machine(path_, kTimeout);
  ASSERT_TRUE(machine.load());
  EXPECT_EQ(machine.follow(replayed(0, kStamp)).quality, MachineQuality::Good);
  hal::FrameSet without;
  without.stamp = kStamp + milliseconds(33);
  EXPECT_EQ(machine.follow(without).values.layer, 3) << "without a new replayed frame";
  EXPECT_EQ(machine.keep(kStamp + milliseconds(500)).values.layer, 3);
  EXPECT_EQ(machine.keep(kStamp + milliseconds(501)).quality, MachineQuality::Stale);
  EXPECT_TRUE(std::isnan(machine.keep(kStamp + milliseconds(502)).values.layer));
  const MachineStatus& unknown = machine.follow(replayed(1, kStamp + milliseconds(600)));
  EXPECT_EQ(unknown.quality, MachineQuality::NoState);
  EXPECT_TRUE(std::isnan(unknown.values.layer));
}

TEST_F(RecordedMachineTest, RefusesRecordingsWithTheReason) {
  EXPECT_THAT(refusal({{}, {}}), HasSubstr("event.mcap: no states of a machine"));
  EXPECT_THAT(refusal({{{"quality", 0, "", ""}}}), HasSubstr("no states of a machine"));
  EXPECT_THAT(refusal({in_layer(3), {{"quality", 9, "", ""}}}),
              HasSubstr("state 1 of the machine: quality must be from 0 to 4"));
  EXPECT_THAT(refusal({in_layer(2.5)}), HasSubstr("layer is 2.500000; it must be a whole number"));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal({{{"quality", 1, "", ""}, {"vx", infinity, "mm/s", ""}}}),
              HasSubstr("vx must be a number"));
  EXPECT_THAT(refusal({{{"quality", 1, "", ""}, {"state_age", 1e300, "s", ""}}}),
              HasSubstr("state_age must be an age"));
  const std::string name(33, 'a');
  EXPECT_NE(refusal({{{"quality", 1, "", ""}, {"part", std::nan(""), "", name}}}), "");
  std::ofstream(path_) << "no recording";
  EXPECT_THAT(RecordedMachine(path_, kTimeout).load().error().message, HasSubstr("event.mcap"));
}

TEST(ReplayedRecording, IsTheOneOfTheCameras) {
  files::Resolved site = demo();
  site.site.machine.source = MachineSource::Recording;
  const auto refused = check_site(site, Dates::Ignored);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("no camera replays one"));
  site.site.cameras[0].back_end = hal::ReplaySettings{.name = {}, .source = "/r/event.mcap"};
  EXPECT_EQ(replayed_recording(site).value_or(""), "/r/event.mcap");
  site.site.cameras[1].back_end = hal::ReplaySettings{.name = {}, .source = "/r/other.mcap"};
  const auto two = replayed_recording(site);
  ASSERT_FALSE(two);
  EXPECT_THAT(two.error().message, HasSubstr("two: /r/event.mcap and /r/other.mcap"));
}

/// Keeps the machine of each frame set that has a new replayed frame.
class Watcher : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  void accept(const ViewPtr&) override {}

  void accept_frames(const hal::FrameSet& set) override {
    const hal::Frame& frame = set.frames[kThermalCamera];
    recorded_set_ = frame && !set.held[kThermalCamera] ? frame->metadata.recorded_set : 0;
  }
  void accept(const Status& status) override {
    if (status.frame_set == newest_ || recorded_set_ == 0) return;
    newest_ = status.frame_set;
    const std::lock_guard lock(mutex_);
    said_[recorded_set_] = status.machine;
    changed_.notify_all();
  }

  std::map<std::uint64_t, MachineStatus> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::minutes(2), [&] { return said_.size() >= count; }));
    return said_;
  }

 private:
  std::uint64_t recorded_set_ = 0, newest_ = 0;  ///< the pipeline's
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint64_t, MachineStatus> said_;
};

/// Figures of the machine in a recording, by the stamp of their frame set.
std::map<std::uint64_t, std::map<std::string, double>> recorded_figures(
    const std::filesystem::path& file) {
  std::map<std::uint64_t, std::map<std::string, double>> all;
  auto states = recorder::RecordedStates::open(file);
  while (const auto state = *states->next()) {
    for (const auto& component : state->state.components) {
      if (component.kind != "machine") continue;
      for (const Figure& figure : component.figures) all[state->utc][figure.name] = figure.value;
    }
  }
  return all;
}

TEST(ReplayedMachine, SaysWithEachReplayedFrameSetWhatItSaidWhenThatWasRecorded) {
  const tests::TemporaryFolder folder;
  const tests::RecordedDemo recorded(40);
  recorded.write(folder / "event.mcap");
  files::Resolved site = demo();
  site.state_folder = folder.path();
  std::get<ConsoleSettings>(site.site.sinks).enabled = false;
  std::get<ModbusSettings>(site.site.sinks).enabled = false;
  std::get<DdsSettings>(site.site.sinks).enabled = false;
  std::get<WebSettings>(site.site.sinks).enabled = false;
  site.site.machine.source = MachineSource::Recording;
  site.site.cameras[kThermalCamera].back_end =
      hal::ReplaySettings{.name = {}, .source = folder / "event.mcap"};
  Watcher watcher;
  auto appliance = Appliance::make(site, {[] { return Result<>(); }, [] {}},
                                   [](const CalibrationEntry&) { return Result<>(); });
  ASSERT_TRUE(appliance) << appliance.error().message;
  ASSERT_TRUE((*appliance)->start({&watcher}));
  const auto said = watcher.wait_for(20);
  appliance->reset();
  const auto expected = recorded_figures(folder / "event.mcap");
  std::size_t good = 0;
  for (const auto& [set_time, machine] : said) {
    ASSERT_TRUE(expected.contains(set_time));
    const auto& figures = expected.at(set_time);
    EXPECT_EQ(static_cast<double>(machine.quality), figures.at("quality"));
    good += is_fault(machine.quality) ? 0 : 1;
    for (const MachineValue& value : kMachineValues) {
      const double now = machine.values.*value.get, then = figures.at(std::string(value.name));
      EXPECT_TRUE(now == then || (std::isnan(now) && std::isnan(then))) << value.name;
    }
  }
  EXPECT_GT(good, 15U);
}

}  // namespace
}  // namespace orbwatch::app::daemon
