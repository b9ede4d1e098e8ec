// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {

/// Writes pictures into v4l2loopback in turn, like a program that plays a camera.
class Feeder {
 public:
  using Pictures = std::vector<std::vector<std::byte>>;

  /// Waits until the device accepts the format: a reader may still have it. For the same reason the
  /// device may refuse the first picture for a while.
  Feeder(const std::string& device, std::uint32_t fourcc, std::uint32_t width, std::uint32_t height,
         Pictures pictures)
      : file_(::open(device.c_str(), O_RDWR | O_CLOEXEC)), pictures_(std::move(pictures)) {
    v4l2_format format;
    std::memset(&format, 0, sizeof(format));
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    format.fmt.pix.width = width;
    format.fmt.pix.height = height;
    format.fmt.pix.pixelformat = fourcc;
    format.fmt.pix.field = V4L2_FIELD_NONE;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (::ioctl(file_.get(), VIDIOC_S_FMT, &format) != 0) {
      if (std::chrono::steady_clock::now() > deadline) {
        ADD_FAILURE() << device << " does not take the format: " << std::strerror(errno);
        return;
      }
      std::this_thread::yield();
    }
    EXPECT_EQ(format.fmt.pix.pixelformat, fourcc);
    EXPECT_EQ(format.fmt.pix.width, width);
    thread_ = std::jthread([this](const std::stop_token& stop) { feed(stop); });
  }

  void pause() { set(false, pictures_); }
  void resume() { set(true, pictures_); }
  void show(Pictures pictures) { set(true, std::move(pictures)); }

 private:
  void set(bool feeding, Pictures pictures) {
    const std::lock_guard lock(mutex_);
    feeding_ = feeding;
    pictures_ = std::move(pictures);
  }

  void feed(const std::stop_token& stop) {
    bool has_fed = false;
    for (std::size_t n = 0; !stop.stop_requested(); ++n) {
      {
        const std::lock_guard lock(mutex_);
        if (feeding_) {
          const auto& picture = pictures_[n % pictures_.size()];
          const auto written = ::write(file_.get(), picture.data(), picture.size());
          if (has_fed || written >= 0 || errno != EBUSY) {
            EXPECT_EQ(written, static_cast<ssize_t>(picture.size())) << std::strerror(errno);
            has_fed = true;
          }
        }
      }
      // Period of the camera's frame rate.
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  FileDescriptor file_;
  std::mutex mutex_;
  bool feeding_ = true;
  Pictures pictures_;
  std::jthread thread_;
};

}  // namespace orbwatch::hal
