// A device's buffers: requested, mapped, exported, queued and dequeued.
#include <fcntl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/v4l2/device/device_call.h"
#include "hal/v4l2/device/v4l2_device.h"

namespace orbwatch::hal {

struct V4l2Device::BufferQuery {
  BufferQuery(std::uint32_t type, std::uint32_t index)
      : buffer(cleared<v4l2_buffer>()), planes(cleared<decltype(planes)>()) {
    buffer.index = index;
    buffer.type = type;
    buffer.memory = V4L2_MEMORY_MMAP;
    if (type != V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) return;
    buffer.m.planes = planes.data();
    buffer.length = static_cast<std::uint32_t>(planes.size());
  }
  BufferQuery(const BufferQuery&) = delete;
  BufferQuery& operator=(const BufferQuery&) = delete;

  v4l2_buffer buffer;
  std::array<v4l2_plane, VIDEO_MAX_PLANES> planes;
};

DeviceResult<std::uint32_t> V4l2Device::request_buffers(std::uint32_t count) {
  auto request = cleared<v4l2_requestbuffers>();
  request.count = count;
  request.type = type_;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = call(file_, VIDIOC_REQBUFS, request); error != 0) {
    return failed("cannot get buffers", error);
  }
  return request.count;
}

DeviceResult<std::vector<BufferMemory>> V4l2Device::map_buffer(std::uint32_t index) {
  BufferQuery query(type_, index);
  if (const int error = call(file_, VIDIOC_QUERYBUF, query.buffer); error != 0) {
    return failed("cannot find buffer " + std::to_string(index), error);
  }
  if (!is_multi_planar()) {
    query.planes[0].length = query.buffer.length;
    query.planes[0].m.mem_offset = query.buffer.m.offset;
    query.buffer.length = 1;
  }
  std::vector<BufferMemory> memory;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(query.buffer.length, kMaxPlanes); ++i) {
    const v4l2_plane& plane = query.planes[i];
    auto mapped = map_memory(index, i, plane.length, plane.m.mem_offset);
    if (!mapped) return tl::unexpected(mapped.error());
    memory.push_back(std::move(*mapped));
  }
  return memory;
}

DeviceResult<BufferMemory> V4l2Device::map_memory(std::uint32_t index, std::uint32_t number,
                                                  std::size_t length, std::uint32_t offset) {
  std::optional<DmaBuffer> exported = export_memory(index, number);
  const int file = exported ? exported->descriptor() : file_.get();
  void* const memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, file,
                              exported ? 0 : static_cast<off_t>(offset));
  if (memory == MAP_FAILED) return failed("cannot map buffer " + std::to_string(index), errno);
  return BufferMemory{MappedMemory({static_cast<std::byte*>(memory), length}), std::move(exported)};
}

/// Nullopt when the driver does not export: then its own mapping is used.
std::optional<DmaBuffer> V4l2Device::export_memory(std::uint32_t index, std::uint32_t number) {
  auto request = cleared<v4l2_exportbuffer>();
  request.type = type_;
  request.index = index;
  request.plane = number;
  request.flags = O_CLOEXEC | O_RDWR;
  if (call(file_, VIDIOC_EXPBUF, request) != 0) return std::nullopt;
  return DmaBuffer(FileDescriptor(request.fd));
}

DeviceResult<> V4l2Device::queue(std::uint32_t index) {
  BufferQuery query(type_, index);
  if (const int error = call(file_, VIDIOC_QBUF, query.buffer); error != 0) {
    return failed("cannot queue a buffer", error);
  }
  return {};
}

DeviceResult<std::optional<FilledBuffer>> V4l2Device::dequeue() {
  BufferQuery query(type_, 0);
  const int error = call(file_, VIDIOC_DQBUF, query.buffer);
  if (error == EAGAIN) return std::nullopt;
  if (error != 0) return failed("cannot read a frame", error);
  const v4l2_buffer& buffer = query.buffer;
  FilledBuffer filled{buffer.index, buffer.flags, buffer.sequence, buffer.timestamp, {}};
  if (!is_multi_planar()) {
    filled.samples[0] = {0, buffer.bytesused};
    return filled;
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(buffer.length, kMaxPlanes); ++i) {
    const v4l2_plane& plane = query.planes[i];
    // bytesused includes the offset; a larger offset leaves no samples.
    filled.samples[i] = {plane.data_offset,
                         plane.bytesused - std::min(plane.bytesused, plane.data_offset)};
  }
  return filled;
}

DeviceResult<> V4l2Device::stream_on() {
  if (const int error = call(file_, VIDIOC_STREAMON, type_); error != 0) {
    return failed("cannot start the stream", error);
  }
  return {};
}

DeviceResult<> V4l2Device::stream_off() {
  if (const int error = call(file_, VIDIOC_STREAMOFF, type_); error != 0) {
    return failed("cannot stop the stream", error);
  }
  return {};
}

}  // namespace orbwatch::hal
