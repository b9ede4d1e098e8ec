#pragma once

#include <linux/videodev2.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/device_result.h"
#include "hal/file_descriptor.h"

namespace orbwatch::hal {

/// A stretch of a driver's memory in this process.
class MappedMemory {
 public:
  explicit MappedMemory(std::span<std::byte> memory) : memory_(memory) {}
  MappedMemory(MappedMemory&& other) noexcept;
  MappedMemory& operator=(MappedMemory&&) = delete;
  ~MappedMemory();

  std::span<std::byte> bytes() const { return memory_; }

 private:
  std::span<std::byte> memory_;
};

/// An open V4L2 capture device: each call is one ioctl, repeated when a signal interrupts it. Every
/// error names the device. Thread-bound.
class V4l2Device {
 public:
  /// Errors: no such device, no permission, not a V4L2 device, or one that cannot stream
  /// single-planar pictures.
  static DeviceResult<V4l2Device> open(const std::string& path);

  const std::string& path() const { return path_; }
  const std::string& card() const { return card_; }  ///< what the device calls itself
  int descriptor() const { return file_.get(); }

  /// The pixel formats on offer, by four-character code.
  std::vector<std::uint32_t> formats() const;
  /// The sizes on offer for one of them, as text: "640x480", or "2x2..4096x2160" for a range.
  std::vector<std::string> sizes(std::uint32_t pixel_format) const;

  DeviceResult<v4l2_pix_format> format() const;
  /// What the driver made of `wanted`, which may differ from it.
  DeviceResult<v4l2_pix_format> set_format(const v4l2_pix_format& wanted);
  /// Asks for `frame_rate` per second, unless it is 0, and returns what the driver has; 0: unknown.
  DeviceResult<double> set_frame_rate(double frame_rate);

  /// The control that follows number `after` (0: the first), or nothing behind the last.
  std::optional<v4l2_query_ext_ctrl> next_control(std::uint32_t after) const;
  DeviceResult<> set_control(const v4l2_query_ext_ctrl& control, std::int64_t value);

  /// Has the driver make `count` buffers; returns how many it made. 0 gives them back.
  DeviceResult<std::uint32_t> request_buffers(std::uint32_t count);
  DeviceResult<MappedMemory> map_buffer(std::uint32_t index);
  /// Hands a buffer to the driver.
  DeviceResult<> queue(std::uint32_t index);
  /// Takes a filled buffer from the driver, or nothing when none is ready.
  DeviceResult<std::optional<v4l2_buffer>> dequeue();
  DeviceResult<> stream_on();
  DeviceResult<> stream_off();

 private:
  V4l2Device(std::string path, FileDescriptor file)
      : path_(std::move(path)), file_(std::move(file)) {}

  DeviceResult<> check_capabilities();
  tl::unexpected<FaultReport> failed(const std::string& action, int error) const;

  std::string path_;
  FileDescriptor file_;
  std::string card_;
};

}  // namespace orbwatch::hal
