// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/videodev2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/fault.h"
#include "hal/frame/device_memory.h"
#include "hal/thread/file_descriptor.h"
#include "hal/v4l2/format/driver_format.h"

namespace orbwatch::hal {

/// Owner of the memory of a device's buffers: the driver, or dma-bufs that it imports.
enum class BufferOwner : std::uint32_t {
  Driver = V4L2_MEMORY_MMAP,
  Importer = V4L2_MEMORY_DMABUF,
};

/// One memory plane of a buffer: mapped, and a dma-buf if it is imported or the driver exports it.
struct BufferMemory {
  MappedMemory mapping;
  std::optional<DmaBuffer> dma_buffer;
};

/// Data that a driver states about a filled buffer.
struct FilledBuffer {
  /// Position of the samples in one memory plane, bytes.
  struct Samples {
    std::size_t offset = 0;
    std::size_t size = 0;
  };

  std::uint32_t index = 0;
  std::uint32_t flags = 0;  ///< V4L2_BUF_FLAG_*
  std::uint32_t sequence = 0;
  timeval timestamp{};
  std::array<Samples, kMaxPlanes> samples;
};

/// An offered size, or a range of sizes.
struct FrameSizeOffer {
  std::uint32_t min_width = 0, max_width = 0;  ///< equal for one size
  std::uint32_t min_height = 0, max_height = 0;
};

/// Open V4L2 capture device, of the single- or of the multi-planar interface: each call is one
/// ioctl, repeated when a signal interrupts it. Every error names the device. Thread-bound.
class V4l2Device {
 public:
  /// Errors: no such device, no permission, not a V4L2 device, or one that cannot stream pictures.
  static DeviceResult<V4l2Device> open(const std::string& path);

  const std::string& path() const { return path_; }
  const std::string& card() const { return card_; }  ///< device's own name
  const std::string& driver() const { return driver_; }
  const std::string& bus() const { return bus_; }  ///< place on the bus: "usb-0000:00:14.0-1"
  int descriptor() const { return file_.get(); }

  /// The offered pixel formats, by four-character code.
  std::vector<std::uint32_t> formats() const;
  /// The offered sizes of a format: each, or a single range.
  std::vector<FrameSizeOffer> sizes(std::uint32_t fourcc) const;
  /// The offered frames per second of a format and size: each, or minimum and maximum of a range.
  std::vector<double> frame_rates(std::uint32_t fourcc, std::uint32_t width,
                                  std::uint32_t height) const;

  DeviceResult<DriverFormat> format() const;
  /// Requests size, field and four-character code of `wanted`; returns the driver's choice, which
  /// may differ.
  DeviceResult<DriverFormat> set_format(const DriverFormat& wanted);
  /// Requests `frame_rate` per second, unless it is 0; returns the driver's choice; 0: unknown.
  DeviceResult<double> set_frame_rate(double frame_rate);

  /// The control after id `after` (0: the first), or nullopt after the last.
  std::optional<v4l2_query_ext_ctrl> next_control(std::uint32_t after) const;
  /// The text of a menu's entry, or nullopt if the menu does not have it.
  std::optional<std::string> menu_entry(const v4l2_query_ext_ctrl& control,
                                        std::int64_t index) const;
  DeviceResult<std::int64_t> control(const v4l2_query_ext_ctrl& control) const;
  DeviceResult<> set_control(const v4l2_query_ext_ctrl& control, std::int64_t value);

  /// True if the driver does not exclude BufferOwner::Importer; drivers before Linux 4.20 state
  /// nothing. Call only while there are no buffers.
  bool may_import() const;
  /// Requests `count` buffers; returns the number that the driver made.
  DeviceResult<std::uint32_t> request_buffers(std::uint32_t count,
                                              BufferOwner owner = BufferOwner::Driver);
  DeviceResult<> free_buffers();
  /// The memory planes of one of the driver's buffers, in the format's order.
  DeviceResult<std::vector<BufferMemory>> map_buffer(std::uint32_t index);
  /// Queues a buffer to the driver. `memory`: its planes, all of them dma-bufs if the driver
  /// imports them.
  DeviceResult<> queue(std::uint32_t index, std::span<const BufferMemory> memory);
  /// Dequeues a filled buffer, or nullopt when none is ready.
  DeviceResult<std::optional<FilledBuffer>> dequeue();
  DeviceResult<> stream_on();
  DeviceResult<> stream_off();

 private:
  /// V4L2's description of one buffer, which points into itself.
  struct BufferQuery;

  V4l2Device(std::string path, FileDescriptor file)
      : path_(std::move(path)), file_(std::move(file)) {}

  DeviceResult<> check_capabilities();
  bool is_multi_planar() const { return type_ == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }
  DeviceResult<BufferMemory> map_memory(std::uint32_t index, std::uint32_t number,
                                        std::size_t length, std::uint32_t offset);
  std::optional<DmaBuffer> export_memory(std::uint32_t index, std::uint32_t number);
  /// Makes a call whose failure is a fault; `action` is for its message.
  template <class T>
  DeviceResult<> request(unsigned long code, T& argument, const std::string& action) const;
  tl::unexpected<FaultReport> failed(const std::string& action, int error) const;

  std::string path_;
  FileDescriptor file_;
  std::string card_;
  std::string driver_;
  std::string bus_;
  std::uint32_t type_ = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  BufferOwner owner_ = BufferOwner::Driver;  ///< owner of the buffers that were requested last
};

}  // namespace orbwatch::hal
