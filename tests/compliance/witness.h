// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "hal/camera.h"

namespace orbwatch::tests {

/// Receives a camera's frames and checks each against the rules. Must outlive the stream.
class Witness {
 public:
  /// Called on the camera's thread with every frame, after its check.
  using Then = std::function<void(const hal::Frame&)>;

  explicit Witness(hal::StreamFormat format, Then then = nullptr)
      : format_(format), then_(std::move(then)) {}

  /// Starts the camera with this receiver.
  void start(hal::Camera& camera);
  /// Stops it; no frame may arrive from then on.
  void stop(hal::Camera& camera);
  /// Records that the stream was ended otherwise; no frame may arrive from then on.
  void close();

  /// Waits for `count` frames of this stream; fails the test after two minutes.
  void wait_for_frames(std::size_t count);
  /// Waits for more than `count` frames; false after `max_wait`.
  bool wait_for_more(std::size_t count, hal::Clock::duration max_wait);
  /// Waits for a report after the first `seen` for which `holds` is true.
  void wait_for_fault(std::size_t seen, const std::function<bool(hal::Fault)>& holds);

  std::vector<hal::FrameMetadata> frames() const;
  std::vector<hal::FaultReport> faults() const;

 private:
  void on_frame(const hal::Frame& frame);
  void on_fault(const hal::FaultReport& fault);
  void expect_frame_of_stream(const hal::FrameBuffer& frame, hal::TimePoint now) const;
  void expect_callback_allowed();

  const hal::StreamFormat format_;
  const Then then_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  hal::TimePoint started_;
  bool closed_ = true;
  bool inside_ = false;  ///< a callback is running
  std::thread::id thread_;
  std::vector<hal::FrameMetadata> frames_;
  std::vector<hal::FaultReport> faults_;
};

/// Configures a camera with `request`, which the format must match.
void configure(hal::Camera& camera, const hal::StreamRequest& request, hal::StreamFormat& format);

}  // namespace orbwatch::tests
