// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "app/model/status/utc_text.h"
#include "app/ports/recorder/events/event_summary.h"
#include "hal/frame/frame_pool.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/mcap/crc32.h"
#include "hal/recording/camera_recording.h"
#include "hal/recording/camera_stream.h"
#include "hal/recording/image.h"
#include "tests/app/ports/recorder/events/painted_event.h"
#include "tests/app/ports/recorder/events/read_event.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"
#include "tests/support/reference_data.h"
#include "tests/support/share.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using tests::kColour, tests::kStates, tests::kThermal;
using tests::ReadMessage;
using tests::RecordedMachine;
using Numbers = std::vector<std::uint64_t>;

class Events : public testing::Test {
 protected:
  RecorderSettings settings() const {
    EventSettings events;
    events.ring_mib = 1;
    events.before = milliseconds(50);
    events.after = milliseconds(40);
    events.longest = milliseconds(300);
    events.on_laser = events.on_layer = true;
    events.on_lines = {"button"};
    return {.folder = folder_ / "recordings", .events = events};
  }

  /// Frame sets from `first` to `last` that have a new frame of the colour camera, or of all.
  static Numbers sets(std::uint64_t first, std::uint64_t last, bool is_colour = false) {
    Numbers numbers;
    for (std::uint64_t n = first; n <= last; ++n) {
      if (!is_colour || n % 3 != 0) numbers.push_back(n);
    }
    return numbers;
  }

  static std::optional<int> quality_in(const fs::path& file) {
    const auto pictures = hal::recording::CameraRecording::open(file, "colour");
    if (!pictures) return 0;
    return hal::recording::jpeg_quality_in(pictures->index().channels.pictures.metadata);
  }

  /// Checks that the pictures of the colour camera are replayed as they were decoded.
  static void expect_replayed(const fs::path& file) {
    auto pictures = hal::recording::CameraRecording::open(file, "colour");
    ASSERT_TRUE(pictures) << pictures.error().message;
    const auto& index = pictures->index();
    EXPECT_EQ(index.format.format, PixelFormat::Nv12);
    const int width = index.format.width, height = index.format.height;
    auto pool = hal::make_frame_pool(PixelFormat::Nv12, width, height, 2);
    const auto expected = pool.acquire(), read = pool.acquire();
    const auto in = [&](hal::FrameBuffer& frame) {
      return MutablePicture::contiguous(PixelFormat::Nv12, width, height, frame.memory, width);
    };
    for (std::size_t n = 0; n < index.exposures.size(); ++n) {
      const auto sent = tests::sent_jpeg(index.exposures[n].sequence, width, height);
      ASSERT_TRUE(hal::JpegDecoder().decode_nv12(sent, in(*expected)));
      ASSERT_TRUE(pictures->read(n, in(*read)));
      EXPECT_TRUE(std::equal(read->memory, read->memory + read->capacity, expected->memory));
    }
  }

  const orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(Events, EachTriggerHasItsWholeTimeInOneEventToTheFrame) {
  const RecorderSettings site = settings();
  RecordedMachine machine(site);
  std::mt19937 random(7);
  const auto roll = [&](unsigned most) { return random() % most; };
  Numbers triggers;
  const auto cases = static_cast<std::size_t>(orbwatch::tests::share_of(1000));
  machine.status.machine.values.laser_on = 0;
  machine.status.machine.values.layer = 1;
  std::uint64_t n = 1, next = 10;
  for (; triggers.size() < cases; ++n) {
    bool is_alarm = false;
    machine.status.machine.values.laser_on = 0;
    if (n == next) {
      const unsigned kind = roll(5);
      is_alarm = kind == 0;
      if (kind == 1) machine.recorder().request();
      if (kind == 2) machine.status.machine.values.laser_on = 1;
      if (kind == 3) machine.status.machine.values.layer += 1;
      if (kind == 4) ++machine.status.process_input_edges[RecordedMachine::kButton];
      triggers.push_back(n);
      // In bursts, and apart: two sets at least, so that the laser is off between.
      next = n + 2 + (roll(2) != 0 ? roll(3) : roll(40));
    }
    machine.pass(n, is_alarm);
    for (unsigned rounds = roll(4); rounds > 0; --rounds) ASSERT_TRUE(machine.record());
  }
  for (const std::uint64_t end = n + 10; n < end; ++n) machine.pass(n);
  machine.record_all();

  const auto events = machine.events();
  const RecorderStatistics statistics = machine.statistics();
  EXPECT_EQ(statistics.pictures_lost, 0U);
  EXPECT_EQ(statistics.recordings, events.size());
  EXPECT_EQ(statistics.recordings + statistics.triggers_joined, triggers.size());
  EXPECT_GT(statistics.triggers_joined, cases / 8);
  ASSERT_GT(events.size(), cases / 8);

  std::vector<std::pair<std::uint64_t, std::uint64_t>> spans;
  std::set<std::string> kinds;
  std::size_t overlaps = 0;
  for (const StoredEvent& event : events) {
    ASSERT_TRUE(event.is_finished) << event.name;
    const auto summary = read_summary(event.folder);
    ASSERT_TRUE(summary) << summary.error().message;
    kinds.insert(summary->trigger);
    auto topics = tests::read_recording(event.folder / kEventFile);
    const Numbers recorded = tests::sequences_of(topics[kThermal]);
    ASSERT_FALSE(recorded.empty());
    const std::uint64_t first = recorded.front(), last = recorded.back();
    EXPECT_EQ(recorded, sets(first, last)) << "none is missing, none is doubled";
    EXPECT_EQ(tests::sequences_of(topics[kColour]), sets(first, last, true));
    EXPECT_EQ(tests::frame_sets_of(topics[kStates]), recorded);
    EXPECT_EQ(first, RecordedMachine::first_of(summary->frame_set, site.events->before));
    EXPECT_TRUE(std::ranges::any_of(triggers, [&](std::uint64_t trigger) {
      return trigger >= first && last == RecordedMachine::last_of(trigger, site.events->after);
    })) << last;
    EXPECT_LE(RecordedMachine::at(last) - RecordedMachine::at(first), site.events->longest);
    EXPECT_TRUE(summary->has_beginning);
    EXPECT_FALSE(summary->is_interrupted);
    EXPECT_EQ(summary->pictures.front(), std::pair(std::string("thermal"), recorded.size()));
    EXPECT_TRUE(fs::exists(event.folder / kEventPicture));
    tests::expect_painted(topics);
    if (!spans.empty() && spans.back().second >= first) ++overlaps;
    spans.emplace_back(first, last);
  }
  EXPECT_EQ(kinds.size(), kTriggerKinds.size());
  EXPECT_GT(overlaps, cases / 40);
  for (const std::uint64_t trigger : triggers) {
    EXPECT_TRUE(std::ranges::any_of(spans, [&](const auto& span) {
      return span.first <= RecordedMachine::first_of(trigger, site.events->before) &&
             span.second >= RecordedMachine::last_of(trigger, site.events->after);
    })) << trigger;
  }
}

TEST_F(Events, OthersReadEveryPixelAndStamp) {
  const fs::path packages = fs::path(ORBWATCH_SOURCE_DIR) / "build/mcap-readers/node_modules";
  ORBWATCH_REQUIRE_FILE(packages / "@foxglove/rosmsg2-serialization");
  RecordedMachine machine(settings());
  for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n, n == 10);
  machine.record_all();
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 1U);
  const fs::path file = events.front().folder / kEventFile;
  std::set<std::string> expected;
  auto topics = tests::read_recording(file);
  for (const ReadMessage& message : topics[kThermal]) {
    const auto [x0, y0, width, height] = RecordedMachine::kBall;
    std::vector<std::uint16_t> samples;
    for (int y = y0; y < y0 + height; ++y) {
      for (int x = x0; x < x0 + width; ++x) {
        samples.push_back(tests::painted(message.sequence, 0, x, y));
      }
    }
    char line[160];
    std::snprintf(line, sizeof line, "%s sensor_msgs/msg/Image %u %llu.%09llu %dx%d mono16 0 %d %u",
                  kThermal, message.sequence,
                  static_cast<unsigned long long>(message.log_time / 1'000'000'000),
                  static_cast<unsigned long long>(message.log_time % 1'000'000'000), width, height,
                  2 * width, hal::mcap::crc32_of(std::as_bytes(std::span(samples))));
    expected.insert(line);
  }
  ::setenv("NODE_PATH", packages.c_str(), 1);
  orbwatch::tests::Subprocess program(
      {"/usr/bin/node", ORBWATCH_SOURCE_DIR "/tests/app/ports/recorder/read_log.mjs", file},
      folder_ / "printed");
  ASSERT_EQ(program.wait(), 0) << program.output();
  std::set<std::string> read;
  std::istringstream output(program.output());
  for (std::string line; std::getline(output, line);) {
    if (line.find("sensor_msgs/msg/Image") != line.npos) read.insert(line);
  }
  EXPECT_EQ(read.size(), RecordedMachine::last_of(10, milliseconds(40)) -
                             RecordedMachine::first_of(10, milliseconds(50)) + 1);
  EXPECT_EQ(read, expected);
}

TEST_F(Events, AStormOfAlarmsMakesFewEventsAndIsCounted) {
  RecordedMachine machine(settings());
  constexpr std::uint64_t kSets = 1000;
  for (std::uint64_t n = 1; n <= kSets; ++n) {
    machine.pass(n, true);
    machine.record_all();
  }
  for (std::uint64_t n = kSets + 1; n <= kSets + 10; ++n) machine.pass(n);
  machine.record_all();
  const RecorderStatistics statistics = machine.statistics();
  EXPECT_EQ(statistics.recordings + statistics.triggers_joined, kSets);
  EXPECT_EQ(statistics.recordings_lost, 0U);
  // 10 s of events of 300 ms, each 50 ms before its first trigger.
  EXPECT_LE(statistics.recordings, 50U);
  EXPECT_GE(statistics.recordings, 33U);
  std::set<std::uint64_t> recorded;
  for (const StoredEvent& event : machine.events()) {
    auto topics = tests::read_recording(event.folder / kEventFile);
    for (const std::uint64_t n : tests::sequences_of(topics[kThermal])) recorded.insert(n);
  }
  EXPECT_EQ(Numbers(recorded.begin(), recorded.end()), sets(1, *recorded.rbegin()));
}

TEST_F(Events, PicturesThatFindNoRoomAreLostAndCountedAndNobodyWaits) {
  RecordedMachine machine(settings());
  machine.pass(1, true);
  constexpr std::uint64_t kSets = 60000;
  std::uint64_t n = 2;
  for (; n <= kSets && machine.statistics().pictures_lost == 0; ++n) machine.pass(n, true);
  ASSERT_GT(machine.statistics().pictures_lost, 0U) << "nothing is read";
  EXPECT_LE(machine.statistics().ring_used, 1.0);
  const std::uint64_t last = n + 100;
  for (; n <= last; ++n) machine.pass(n);
  machine.record_all();
  EXPECT_GT(machine.statistics().recordings_lost, 0U) << "more events at once than windows";
  for (const StoredEvent& event : machine.events()) {
    auto topics = tests::read_recording(event.folder / kEventFile);
    const Numbers recorded = tests::sequences_of(topics[kThermal]);
    EXPECT_EQ(recorded, sets(recorded.front(), recorded.back()));
  }
}

TEST_F(Events, TheSummaryCountsTheLostPicturesOfTheEventsTimeAlone) {
  for (const bool is_begun_before : {false, true}) {
    SCOPED_TRACE(is_begun_before);
    RecorderSettings site = settings();
    site.folder = folder_ / (is_begun_before ? "begun" : "waiting");
    site.events->after = std::chrono::seconds(30);  // more than the ring has room for
    site.events->longest = std::chrono::seconds(90);
    RecordedMachine machine(site);
    machine.pass(1, true);
    if (is_begun_before) {
      ASSERT_TRUE(machine.record());
    }
    const std::uint64_t last = RecordedMachine::last_of(1, site.events->after);
    for (std::uint64_t n = 2; n <= last + 100; ++n) machine.pass(n);
    machine.record_all();
    const auto events = machine.events();
    ASSERT_EQ(events.size(), 1U);
    const auto summary = read_summary(events.front().folder);
    ASSERT_TRUE(summary) << summary.error().message;
    const std::size_t all = sets(1, last).size() + sets(1, last, true).size();
    const std::size_t recorded = summary->pictures[0].second + summary->pictures[1].second;
    ASSERT_LT(recorded, all);
    EXPECT_EQ(summary->lost, all - recorded);
    EXPECT_GT(machine.statistics().pictures_lost, summary->lost) << "others after its end";
  }
}

TEST_F(Events, TheScaleIsThatOfACameraThatCameAfterTheStart) {
  RecordedMachine machine(settings());
  hal::StreamFormat thermal = RecordedMachine::cameras()[0].format;
  thermal.kelvin_per_count = 0.1;
  thermal.kelvin_offset = 20;
  machine.recorder().accept_format(0, thermal);
  for (std::uint64_t n = 1; n <= 12; ++n) machine.pass(n, n == 10);
  thermal.kelvin_per_count = 0.2;
  machine.recorder().accept_format(0, thermal);
  for (std::uint64_t n = 13; n <= 20; ++n) machine.pass(n);
  machine.record_all();
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 1U);
  const auto pictures =
      hal::recording::CameraRecording::open(events.front().folder / kEventFile, "thermal");
  ASSERT_TRUE(pictures) << pictures.error().message;
  EXPECT_EQ(pictures->index().format.kelvin_per_count, 0.1);
  EXPECT_EQ(pictures->index().format.kelvin_offset, 20);
  EXPECT_EQ(pictures->index().exposures.back().sequence, 12U) << "a file has one scale";
}

TEST_F(Events, ColourIsJpegOfTheStatedQualityOrLosslessOnRequest) {
  for (const bool lossless : {false, true}) {
    RecorderSettings site = settings();
    site.folder = folder_ / (lossless ? "lossless" : "jpeg");
    site.events->lossless = lossless;
    RecordedMachine machine(site);
    for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n, n == 10);
    machine.record_all();
    const auto events = machine.events();
    ASSERT_EQ(events.size(), 1U);
    auto topics = tests::read_recording(events.front().folder / kEventFile);
    if (lossless) {
      const auto& pictures = topics["/orbwatch/colour/image_raw"];
      ASSERT_FALSE(pictures.empty());
      hal::recording::Image image;
      ASSERT_TRUE(hal::mcap::decode_cdr(pictures.front().bytes, image));
      EXPECT_EQ(image.encoding, "nv12");
      const auto value = static_cast<std::byte>(60 + pictures.front().sequence % 100);
      EXPECT_TRUE(std::ranges::all_of(image.data, [&](std::byte b) { return b == value; }));
      continue;
    }
    const auto& pictures = topics[kColour];
    ASSERT_FALSE(pictures.empty());
    hal::recording::CompressedImage image;
    ASSERT_TRUE(hal::mcap::decode_cdr(pictures.front().bytes, image));
    EXPECT_EQ(image.format, hal::recording::kColourJpeg);
    EXPECT_EQ(quality_in(events.front().folder / kEventFile), 90);
    const auto size = hal::JpegDecoder().read_size(image.data);
    ASSERT_TRUE(size) << size.error().message;
    EXPECT_EQ(size->width, RecordedMachine::kWidth);
    EXPECT_EQ(size->height, RecordedMachine::kHeight);
  }
}

TEST_F(Events, DataOfAJpegCameraIsRecordedUnchangedAlsoWhereLosslessIsRequested) {
  for (const bool lossless : {false, true}) {
    RecorderSettings site = settings();
    site.folder = folder_ / (lossless ? "lossless" : "jpeg");
    site.events->lossless = lossless;
    site.events->cameras = {"colour"};
    RecordedMachine machine(site);
    machine.sends_jpeg = true;
    for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n, n == 10);
    EXPECT_GT(machine.statistics().ring_used, 0);
    machine.record_all();
    const auto events = machine.events();
    ASSERT_EQ(events.size(), 1U);
    const fs::path file = events.front().folder / kEventFile;
    auto topics = tests::read_recording(file);
    EXPECT_EQ(topics.count("/orbwatch/colour/image_raw"), 0U);
    ASSERT_GT(topics[kColour].size(), 4U);
    const auto sent = [](std::uint64_t number) {
      return tests::sent_jpeg(number, RecordedMachine::kWidth, RecordedMachine::kHeight);
    };
    for (const ReadMessage& message : topics[kColour]) {
      hal::recording::CompressedImage image;
      ASSERT_TRUE(hal::mcap::decode_cdr(message.bytes, image));
      EXPECT_EQ(image.format, "jpeg");
      EXPECT_TRUE(std::ranges::equal(image.data, sent(message.sequence))) << message.sequence;
    }
    const auto picture = sent(10);
    EXPECT_EQ(tests::text_in(events.front().folder / kEventPicture),
              std::string(reinterpret_cast<const char*>(picture.data()), picture.size()));
    EXPECT_EQ(quality_in(file), std::nullopt) << "it is not coded here";
    expect_replayed(file);
  }
}

TEST_F(Events, TheSummaryHasTheCircumstancesOfTheTrigger) {
  RecordedMachine machine(settings());
  for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n, n == 10);
  machine.record_all();
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_THAT(events.front().name, testing::EndsWith("Z-alarm"));
  const auto summary = read_summary(events.front().folder);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_EQ(summary->trigger, "alarm");
  EXPECT_EQ(summary->text, "1: hot_spot_width raised, high alarm, 27.25 mm");
  ASSERT_TRUE(summary->alarm);
  EXPECT_EQ(summary->alarm->region, "1");
  EXPECT_EQ(summary->alarm->signal, "hot_spot_width");
  EXPECT_EQ(summary->alarm->level, signals::AlarmLevel::HighAlarm);
  EXPECT_EQ(summary->alarm->value, 27.25);
  EXPECT_EQ(summary->alarm->unit, "mm");
  EXPECT_EQ(summary->line, "");
  EXPECT_EQ(summary->part, "Flügel 7");
  EXPECT_EQ(summary->layer, 12);
  EXPECT_EQ(summary->frame_set, 10U);
  const auto topics = tests::read_recording(events.front().folder / kEventFile);
  const auto utc_of = [&](std::uint64_t set) {
    for (const ReadMessage& message : topics.at(kThermal)) {
      if (message.sequence != set) continue;
      return utc_text(Utc(std::chrono::nanoseconds(message.log_time))).value_or("");
    }
    return std::string("not recorded");
  };
  EXPECT_EQ(summary->first, utc_of(RecordedMachine::first_of(10, milliseconds(50))));
  EXPECT_EQ(summary->triggered, utc_of(10));
  EXPECT_EQ(summary->last, utc_of(RecordedMachine::last_of(10, milliseconds(40))));
  EXPECT_EQ(summary->versions.front(), std::pair(std::string("orbwatch"), std::string("0.1.0")));
}

TEST_F(Events, AnEventThatCannotBeWrittenIsCountedAndTheNextOneIsRecorded) {
  const RecorderSettings site = settings();
  RecordedMachine machine(site);
  const fs::path events = site.folder / "events";
  fs::create_directories(site.folder);
  std::ofstream(events) << "in the way";
  for (std::uint64_t n = 1; n <= 10; ++n) machine.pass(n, n == 5);
  ASSERT_FALSE(machine.record());
  machine.recorder().give_up();
  EXPECT_EQ(machine.statistics().recordings_lost, 1U);
  fs::remove(events);
  for (std::uint64_t n = 11; n <= 40; ++n) machine.pass(n, n == 20);
  machine.record_all();
  EXPECT_EQ(machine.statistics().recordings, 1U);
  EXPECT_EQ(machine.events().size(), 1U);
}

TEST_F(Events, TheEndOfTheRecorderKeepsWhatIsThere) {
  RecordedMachine machine(settings());
  for (std::uint64_t n = 1; n <= 10; ++n) machine.pass(n, n == 9);
  machine.record_all();
  ASSERT_TRUE(machine.recorder().end());
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_TRUE(events.front().is_finished);
  const auto summary = read_summary(events.front().folder);
  ASSERT_TRUE(summary);
  EXPECT_TRUE(summary->is_interrupted);
  auto topics = tests::read_recording(events.front().folder / kEventFile);
  EXPECT_EQ(tests::sequences_of(topics[kThermal]),
            sets(RecordedMachine::first_of(9, milliseconds(50)), 10));
}

}  // namespace
}  // namespace orbwatch::app::recorder
