// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace orbwatch::tests {

/// V4L2 device without a driver. A program that links this has its own open, close, ioctl and mmap,
/// which answer for kFakeDevice and pass everything else to the kernel: it offers one format of at
/// most 16 bit per pixel in a few sizes, and delivers a frame every hundredth of a second.
struct FakeDevice {
  std::uint32_t fourcc = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;  ///< width, height
  /// Fills a frame of the current size, row by row without padding.
  void (*draw)(std::span<std::uint16_t> words, std::size_t width) = nullptr;
  std::vector<std::byte> jpeg = {};  ///< every frame, where nothing is drawn
  /// Value of its control TriggerMode, if it has one; no frame comes while it is not 0.
  std::optional<std::int32_t> trigger_mode = std::nullopt;
};

inline constexpr const char* kFakeDevice = "/dev/video-fake";

/// Connects the device, in place of the previous one. Call only while no camera runs.
void connect(const FakeDevice& device);

/// Present value of the connected device's control TriggerMode.
std::optional<std::int32_t> trigger_mode();

}  // namespace orbwatch::tests
