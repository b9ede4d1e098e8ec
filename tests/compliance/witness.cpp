// SPDX-License-Identifier: Apache-2.0
#include "tests/compliance/witness.h"

#include <chrono>
#include <cmath>

namespace orbwatch::tests {
namespace {

using namespace std::chrono_literals;

/// Sufficient time, also in an emulated machine.
constexpr auto kGuard = 120s;
/// A sensor may have begun its first exposure before the start of the stream.
constexpr auto kBeforeStart = 1s;

}  // namespace

void configure(hal::Camera& camera, const hal::StreamRequest& request, hal::StreamFormat& format) {
  const auto agreed = camera.configure(request);
  ASSERT_TRUE(agreed) << agreed.error().message;
  format = *agreed;
  EXPECT_GT(format.width, 0);
  EXPECT_GT(format.height, 0);
  EXPECT_TRUE(request.width == 0 || request.width == format.width) << format.width;
  EXPECT_TRUE(request.height == 0 || request.height == format.height) << format.height;
  EXPECT_GE(format.frame_rate, 0);
}

void Witness::start(hal::Camera& camera) {
  {
    const std::lock_guard lock(mutex_);
    started_ = hal::Clock::now();
    closed_ = false;
    thread_ = {};
    frames_.clear();
    faults_.clear();
  }
  const auto started = camera.start([this](const hal::Frame& frame) { on_frame(frame); },
                                    [this](const hal::FaultReport& fault) { on_fault(fault); });
  ASSERT_TRUE(started) << started.error().message;
}

void Witness::stop(hal::Camera& camera) {
  camera.stop();
  close();
}

void Witness::close() {
  const std::lock_guard lock(mutex_);
  EXPECT_FALSE(inside_) << "the stream ended while a callback was running";
  closed_ = true;
}

void Witness::wait_for_frames(std::size_t count) {
  std::unique_lock lock(mutex_);
  ASSERT_TRUE(changed_.wait_for(lock, kGuard, [&] { return frames_.size() >= count; }))
      << frames_.size() << " of " << count
      << " frames came, last fault: " << (faults_.empty() ? "none" : faults_.back().detail);
}

bool Witness::wait_for_more(std::size_t count, hal::Clock::duration max_wait) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, max_wait, [&] { return frames_.size() > count; });
}

void Witness::wait_for_fault(std::size_t seen, const std::function<bool(hal::Fault)>& holds) {
  std::unique_lock lock(mutex_);
  const auto came = [&] {
    for (std::size_t i = seen; i < faults_.size(); ++i) {
      if (holds(faults_[i].fault)) return true;
    }
    return false;
  };
  ASSERT_TRUE(changed_.wait_for(lock, kGuard, came)) << "no such report among " << faults_.size();
}

std::vector<hal::FrameMetadata> Witness::frames() const {
  const std::lock_guard lock(mutex_);
  return frames_;
}

std::vector<hal::FaultReport> Witness::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

/// Checks that callbacks come one at a time, on one thread that is not the owner's, between start
/// and stop. Call with the lock held.
void Witness::expect_callback_allowed() {
  EXPECT_FALSE(closed_) << "a callback outside of the stream";
  EXPECT_FALSE(inside_) << "two callbacks at a time";
  if (thread_ == std::thread::id()) thread_ = std::this_thread::get_id();
  EXPECT_EQ(thread_, std::this_thread::get_id()) << "callbacks on two threads";
}

void Witness::on_frame(const hal::Frame& frame) {
  {
    const std::lock_guard lock(mutex_);
    expect_callback_allowed();
    expect_frame_of_stream(*frame, hal::Clock::now());
    inside_ = true;
    frames_.push_back(frame->metadata);
  }
  if (then_) then_(frame);
  {
    const std::lock_guard lock(mutex_);
    inside_ = false;
  }
  changed_.notify_all();
}

void Witness::on_fault(const hal::FaultReport& fault) {
  {
    const std::lock_guard lock(mutex_);
    expect_callback_allowed();
    const hal::Fault before = faults_.empty() ? hal::Fault::None : faults_.back().fault;
    EXPECT_NE(before, fault.fault) << "reported twice: " << fault.detail;
    faults_.push_back(fault);
  }
  changed_.notify_all();
}

void Witness::expect_frame_of_stream(const hal::FrameBuffer& frame, hal::TimePoint now) const {
  const Picture& picture = frame.picture;
  EXPECT_EQ(picture.format, format_.format);
  EXPECT_EQ(picture.colour_space.matrix, format_.colour_space.matrix);
  EXPECT_EQ(picture.colour_space.range, format_.colour_space.range);
  EXPECT_EQ(picture.width, format_.width);
  EXPECT_EQ(picture.height, format_.height);
  EXPECT_NE(picture.planes[0].data, nullptr);
  EXPECT_GE(std::abs(picture.planes[0].stride), row_bytes(picture.format, picture.width));
  const hal::FrameMetadata& metadata = frame.metadata;
  EXPECT_LE(metadata.exposure_start, now) << "not on the steady clock";
  EXPECT_GE(metadata.exposure_start, started_ - kBeforeStart) << "not on the steady clock";
  EXPECT_GE(metadata.exposure_time.count(), 0);
  EXPECT_TRUE(std::isfinite(metadata.gain) && metadata.gain > 0) << metadata.gain;
  if (frames_.empty()) return;
  EXPECT_GT(metadata.sequence, frames_.back().sequence);
  EXPECT_GT(metadata.exposure_start, frames_.back().exposure_start);
}

}  // namespace orbwatch::tests
