// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_frame.h"

#include <libcamera/base/unique_fd.h>
#include <libcamera/control_ids.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <map>
#include <span>
#include <string>
#include <system_error>

#include "hal/frame/exposure_start.h"

namespace orbwatch::hal {
namespace {

/// The planes' common dma-buf reaches to the end of the last of them.
std::size_t length_of(const libcamera::FrameBuffer& buffer, const libcamera::SharedFD& file) {
  std::size_t length = 0;
  for (const auto& plane : buffer.planes()) {
    if (plane.fd.get() != file.get()) continue;
    length = std::max(length, std::size_t{plane.offset} + plane.length);
  }
  return length;
}

/// Size of the file, which the driver chose and which may extend beyond the last plane.
std::size_t size_of(const libcamera::FrameBuffer& buffer, const libcamera::SharedFD& file) {
  const off_t size = ::lseek(file.get(), 0, SEEK_END);
  return std::max(length_of(buffer, file), size > 0 ? static_cast<std::size_t>(size) : 0);
}

Result<MappedDmaBuffer> map_file(const libcamera::SharedFD& file, std::size_t length) {
  void* const memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) {
    return fail("cannot map a buffer: " + std::generic_category().message(errno));
  }
  return MappedDmaBuffer{DmaBuffer(FileDescriptor(file.dup().release())),
                         MappedMemory({static_cast<std::byte*>(memory), length})};
}

using std::chrono::nanoseconds;

}  // namespace

Result<std::unique_ptr<LibcameraFrame>> LibcameraFrame::map(const libcamera::FrameBuffer& buffer,
                                                            const LibcameraFormat& format,
                                                            int width, int height,
                                                            std::size_t stride) {
  auto frame = std::make_unique<LibcameraFrame>();
  std::vector<int> files;  // file of each mapping, by libcamera's number
  std::vector<std::span<const std::byte>> planes;
  for (const auto& plane : buffer.planes()) {
    auto known = std::find(files.begin(), files.end(), plane.fd.get());
    if (known == files.end()) {
      auto mapped = map_file(plane.fd, length_of(buffer, plane.fd));
      if (!mapped) return tl::unexpected(mapped.error());
      frame->dma_buffers.push_back(std::move(*mapped));
      known = files.insert(files.end(), plane.fd.get());
    }
    const auto& memory = frame->dma_buffers[static_cast<std::size_t>(known - files.begin())].memory;
    planes.push_back(memory.bytes().subspan(plane.offset, plane.length));
  }
  const auto picture = lay_out(format, width, height, stride, planes);
  if (!picture) return tl::unexpected(picture.error());
  frame->picture = *picture;
  return frame;
}

Result<std::unique_ptr<libcamera::FrameBuffer>> make_buffer_like(const libcamera::FrameBuffer& own,
                                                                 const DmaBufferSource& source) {
  std::map<int, libcamera::SharedFD> files;  // file of each of the camera's own buffers
  std::vector<libcamera::FrameBuffer::Plane> planes;
  for (const auto& plane : own.planes()) {
    const auto [file, is_new] = files.try_emplace(plane.fd.get());
    if (is_new) {
      const auto memory = source.allocate(size_of(own, plane.fd));
      if (!memory) return tl::unexpected(memory.error());
      const int descriptor = memory->descriptor();  // an lvalue is duplicated, not taken over
      file->second = libcamera::SharedFD(descriptor);
    }
    planes.push_back({file->second, plane.offset, plane.length});
  }
  return std::make_unique<libcamera::FrameBuffer>(planes);
}

Result<> LibcameraFrame::synchronise(Result<> (DmaBuffer::*moment)() const) const {
  for (const MappedDmaBuffer& buffer : dma_buffers) {
    if (auto done = (buffer.file.*moment)(); !done) return done;
  }
  return {};
}

ClockReading ClockReading::now() {
  timespec boot{};
  ::clock_gettime(CLOCK_BOOTTIME, &boot);
  return {Clock::now(), std::chrono::seconds(boot.tv_sec) + nanoseconds(boot.tv_nsec)};
}

std::optional<TimePoint> to_steady(nanoseconds stamp, const ClockReading& arrival) {
  const nanoseconds now = arrival.steady.time_since_epoch();
  if (stamp > now) stamp -= arrival.boot - now;
  if (!is_plausible(TimePoint(stamp), arrival.steady)) return std::nullopt;
  return TimePoint(stamp);
}

FrameMetadata metadata_of(const libcamera::ControlList& request, std::uint64_t buffer_stamp,
                          const ClockReading& arrival) {
  namespace controls = libcamera::controls;
  const auto of_sensor = request.get(controls::SensorTimestamp);
  const nanoseconds stamp(of_sensor.value_or(static_cast<std::int64_t>(buffer_stamp)));
  const auto moment = to_steady(stamp, arrival);
  FrameMetadata metadata;
  metadata.exposure_start = moment.value_or(arrival.steady);
  metadata.stamp_source = !moment     ? StampSource::Arrival
                          : of_sensor ? StampSource::ReadoutStart
                                      : StampSource::FrameEnd;
  metadata.exposure_time =
      std::chrono::microseconds(request.get(controls::ExposureTime).value_or(0));
  metadata.gain = static_cast<double>(request.get(controls::AnalogueGain).value_or(1.0F)) *
                  static_cast<double>(request.get(controls::DigitalGain).value_or(1.0F));
  metadata.lux = static_cast<double>(request.get(controls::Lux).value_or(0.0F));
  return metadata;
}

}  // namespace orbwatch::hal
