// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <utility>

#include "hal/camera.h"
#include "hal/frame/frame_pool.h"

namespace orbwatch::app::pipeline {

/// Width and height of a HandCamera's frames.
inline constexpr int kHandCameraSize = 100;

/// Camera that delivers a frame for each call of the test.
class HandCamera : public hal::Camera {
 public:
  HandCamera(std::string name, PixelFormat format)
      : Camera({std::move(name), "hand", "test"}),
        format_(format),
        pool_(hal::make_frame_pool(format, kHandCameraSize, kHandCameraSize)) {}
  ~HandCamera() override { stop(); }

  /// Delivers a frame with a bright square on darker ground, no part of which looks like another,
  /// before it returns. `bright` is above 199.
  void expose(std::uint16_t bright, hal::TimePoint moment = hal::Clock::now()) {
    expose(bright, {.exposure_start = moment});
  }
  /// Delivers such a frame with the device's metadata, except its number.
  void expose(std::uint16_t bright, const hal::FrameMetadata& stated) {
    act([this, bright, &stated] {
      auto buffer = pool_.acquire();
      if (!buffer) return;
      paint(*buffer, bright);
      buffer->metadata = stated;
      buffer->metadata.sequence = sequence_++;
      deliver(buffer);
    });
  }
  /// Scales the pixels outside the square, from the next frame on.
  void set_gain(double gain) {
    act([this, gain] { gain_ = gain; });
  }
  void expose_damaged(hal::TimePoint moment = hal::Clock::now()) {
    act([this, moment] {
      discard({.sequence = sequence_++, .exposure_start = moment}, "as asked for");
    });
  }
  void fail_with(hal::Fault fault) {
    act([this, fault] { report(fault); });
  }
  void deliver_wrong_size() {
    act([this] { deliver(hal::make_frame_pool(format_, 8, 8, 1).acquire()); });
  }

 protected:
  /// Executes `action` on the camera's thread before it returns.
  void act(std::function<void()> action) {
    std::unique_lock lock(mutex_);
    action_ = std::move(action);
    work_.notify_all();
    done_.wait(lock, [this] { return !action_; });
  }

 private:
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest&) override {
    return hal::StreamFormat{format_, {}, kHandCameraSize, kHandCameraSize, 100};
  }
  void run(const std::stop_token& stop) override {
    std::unique_lock lock(mutex_);
    while (work_.wait(lock, stop, [this] { return static_cast<bool>(action_); })) {
      action_();
      action_ = nullptr;
      done_.notify_all();
    }
  }
  void paint(hal::FrameBuffer& buffer, std::uint16_t bright) const {
    for (int y = 0; y < kHandCameraSize; ++y) {
      for (int x = 0; x < kHandCameraSize; ++x) {
        const bool inside = x > 25 && x < 40 && y > 45 && y < 55;
        const auto value =
            static_cast<std::uint16_t>(inside ? bright : gain_ * ((x * x + 3 * y * y) % 200));
        const std::size_t at =
            static_cast<std::size_t>(y) * kHandCameraSize + static_cast<std::size_t>(x);
        if (format_ == PixelFormat::Y16) {
          reinterpret_cast<std::uint16_t*>(buffer.memory)[at] = value;
        } else {
          const auto channels = static_cast<std::size_t>(orbwatch::info(format_).channels());
          std::fill_n(buffer.memory + channels * at, channels, static_cast<std::byte>(value));
        }
      }
    }
  }

  PixelFormat format_;
  hal::FramePool pool_;
  std::uint64_t sequence_ = 0;
  double gain_ = 1;
  std::mutex mutex_;
  std::condition_variable_any work_, done_;
  std::function<void()> action_;
};

}  // namespace orbwatch::app::pipeline
