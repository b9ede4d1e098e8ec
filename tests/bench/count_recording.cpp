// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "app/ports/recorder/recorder_sink.h"

namespace orbwatch::bench {
namespace {

constexpr int kSetsPerSecond = 30;
/// Sets of a repetition, in whose middle an alarm is raised. Two repetitions fit the recorder's
/// queue, which no thread reads.
constexpr std::uint64_t kSets = 60;

std::shared_ptr<hal::FrameBuffer> grey_frame(PixelFormat format, int width, int height) {
  auto frame = std::make_shared<hal::FrameBuffer>();
  const auto stride = static_cast<std::size_t>(row_bytes(format, width));
  frame->capacity = picture_bytes(format, stride, height);
  frame->storage = std::make_unique<std::byte[]>(frame->capacity);
  frame->picture = MutablePicture::contiguous(format, width, height, frame->storage.get(),
                                              static_cast<std::ptrdiff_t>(stride));
  return frame;
}

/// The pipeline's part of the recorder, for the cameras of the reference machine: a colour one of
/// 1920x1080 in NV12 and a thermal one of 640x512 in Y16, whose balls fill the pictures' heights.
class RecordedMachine {
 public:
  /// Fills the ring, so that each picture replaces others.
  RecordedMachine() {
    while (recorder_.statistics().ring_used < 0.98 * kRingMib) recorder_.accept_frames(next());
  }

  /// One frame set: its pictures, its status and on request an alarm.
  void pass(bool is_alarm) {
    const hal::FrameSet set = next();
    recorder_.accept_frames(set);
    if (is_alarm) {
      app::AlarmNotice notice;
      notice.event.kind = signals::AlarmEventKind::Raised;
      notice.frame_set = set.id;
      notice.stamp = set.stamp;
      recorder_.accept_event(notice);
    }
    status_.frame_set = set.id;
    status_.stamp = set.stamp;
    recorder_.accept(status_);
  }

  bool has_lost_nothing() const {
    const auto figures = recorder_.statistics();
    return figures.lost + figures.pictures_lost + figures.recordings_lost == 0;
  }

 private:
  static constexpr int kRingMib = 256;  // 3.7 s

  static app::RecorderSettings settings() {
    app::recorder::EventSettings events;
    events.ring_mib = kRingMib;
    events.before = events.after = std::chrono::milliseconds(500);
    return {.folder = "/nonexistent", .events = events};
  }
  static std::vector<app::RecordedCamera> cameras() {
    const hal::StreamFormat colour{PixelFormat::Nv12, {}, 1920, 1080, kSetsPerSecond};
    const hal::StreamFormat thermal{PixelFormat::Y16, {}, 640, 512, kSetsPerSecond};
    return {{"colour", colour, {420, 0, 1080, 1080}, {}},
            {"thermal", thermal, {64, 0, 512, 512}, {}}};
  }

  hal::FrameSet next() {
    hal::FrameSet set;
    set.id = ++sets_;
    set.stamp = begin_ + sets_ * std::chrono::nanoseconds(1'000'000'000 / kSetsPerSecond);
    for (std::size_t n = 0; n < frames_.size(); ++n) {
      frames_[n]->metadata.sequence = sets_;
      frames_[n]->metadata.exposure_start = set.stamp;
      set.frames[n] = frames_[n];
    }
    return set;
  }

  const std::array<std::shared_ptr<hal::FrameBuffer>, 2> frames_{
      grey_frame(PixelFormat::Nv12, 1920, 1080), grey_frame(PixelFormat::Y16, 640, 512)};
  /// Its thread is not started: only the pipeline's part is counted.
  app::RecorderSink recorder_{settings(), {{"colour", "thermal"}, {}, {}}, {}, cameras()};
  const hal::TimePoint begin_ = hal::Clock::now();
  std::uint64_t sets_ = 0;
  app::Status status_;
};

}  // namespace
}  // namespace orbwatch::bench

/// "PROGRAM REPETITIONS" passes REPETITIONS times 60 frame sets, with one alarm, to the recorder,
/// for count_instructions.c: the cost of one repetition is the difference between two runs that
/// differ in REPETITIONS only. Prints the number of frame sets of one repetition.
int main(int argc, char** argv) {
  using namespace orbwatch::bench;
  const int repetitions = argc == 2 ? std::atoi(argv[1]) : 0;
  if (repetitions < 1 || repetitions > 2) {
    std::cerr << "usage: " << argv[0] << " REPETITIONS, 1 or 2\n";
    return 2;
  }
  RecordedMachine machine;
  for (int n = 0; n < repetitions; ++n) {
    for (std::uint64_t set = 0; set < kSets; ++set) machine.pass(set == kSets / 2);
  }
  if (!machine.has_lost_nothing()) {
    std::cerr << argv[0] << ": pictures, states or events were lost\n";
    return 1;
  }
  std::cout << kSets << '\n';
  return 0;
}
