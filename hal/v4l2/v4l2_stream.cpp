// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/v4l2_stream.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <utility>

#include "hal/frame/buffer_count.h"
#include "hal/frame/exposure_start.h"

namespace orbwatch::hal {
namespace {

/// The picture in a driver's memory.
Picture describe(const DriverFrame& frame, const NegotiatedFormat& format,
                 const FilledBuffer& buffer) {
  const StreamFormat& stream = format.stream;
  Picture picture{stream.format, stream.colour_space, stream.width, stream.height, {}};
  for (std::size_t n = 0; n < format.layout.plane_count; ++n) {
    const DriverLayout::Plane& plane = format.layout.planes[n];
    const std::size_t offset = buffer.samples[plane.memory].offset + plane.offset;
    picture.planes[n] = {frame.memory_planes[plane.memory].mapping.bytes().data() + offset,
                         static_cast<std::ptrdiff_t>(plane.stride)};
  }
  return picture;
}

}  // namespace

FrameStamp frame_stamp(const FilledBuffer& buffer, TimePoint arrival) {
  const FrameStamp none{arrival, StampSource::Arrival};
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return none;
  }
  const TimePoint stamp{std::chrono::seconds(buffer.timestamp.tv_sec) +
                        std::chrono::microseconds(buffer.timestamp.tv_usec)};
  if (!is_plausible(stamp, arrival)) return none;
  const bool start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  return {stamp, start ? StampSource::ExposureStart : StampSource::FrameEnd};
}

DriverFrame::DriverFrame(std::vector<BufferMemory> buffer) : memory_planes(std::move(buffer)) {
  memory = memory_planes.front().mapping.bytes().data();
  capacity = memory_planes.front().mapping.bytes().size();
}

Result<> DriverFrame::begin_read() {
  is_read_ = true;
  return synchronise(&DmaBuffer::begin_read);
}

Result<> DriverFrame::end_read() {
  if (!std::exchange(is_read_, false)) return {};
  return synchronise(&DmaBuffer::end_read);
}

Result<> DriverFrame::synchronise(Result<> (DmaBuffer::*moment)() const) {
  for (BufferMemory& stretch : memory_planes) {
    if (!stretch.dma_buffer) continue;
    if (auto done = ((*stretch.dma_buffer).*moment)(); !done) return done;
  }
  return {};
}

std::span<const std::byte> V4l2Stream::Captured::samples(std::size_t number) const {
  const auto [offset, size] = buffer.samples[number];
  const std::span<const std::byte> all = frame->memory_planes[number].mapping.bytes();
  if (offset > all.size() || size > all.size() - offset) return {};
  return all.subspan(offset, size);
}

tl::unexpected<FaultReport> V4l2Stream::failed(const std::string& message) const {
  return fail(Fault::ReadError, device_.path() + ": " + message);
}

DeviceResult<std::unique_ptr<V4l2Stream>> V4l2Stream::start(
    V4l2Device device, const NegotiatedFormat& format, std::size_t buffers,
    const std::vector<DmaBufferSource>& sources) {
  std::unique_ptr<V4l2Stream> stream(new V4l2Stream(std::move(device), format, buffers));
  if (!stream->returned_->is_open()) return stream->failed("too many open files");
  if (auto started = stream->start_in_best_memory(sources); !started) {
    return tl::unexpected(started.error());
  }
  return stream;
}

V4l2Stream::~V4l2Stream() { reset(); }

/// Ends the stream and frees the device's buffers. Mapped ones keep the device's file open; freeing
/// them still releases the device for the next stream.
void V4l2Stream::reset() {
  // Both calls fail when the device is gone; nothing is left to do then.
  static_cast<void>(device_.stream_off());
  static_cast<void>(device_.free_buffers());
  pool_.reset();
  frames_.clear();
  returned_->take();
  queued_ = 0;
}

DeviceResult<> V4l2Stream::start_in_best_memory(const std::vector<DmaBufferSource>& sources) {
  const bool imports = sources.empty() || device_.may_import();
  memory_ = choose_memory(imports ? sources : std::vector<DmaBufferSource>(),
                          [this](const DmaBufferSource& source) -> Result<> {
                            auto started = start_in(source);
                            if (started) return {};
                            reset();
                            return fail(started.error().detail);
                          });
  if (!memory_.source.empty()) return {};
  if (!imports) memory_.refusals = "the driver imports no other";
  return start_in_own_memory();
}

DeviceResult<> V4l2Stream::start_in(const DmaBufferSource& source) {
  const auto format = device_.format();
  if (!format) return tl::unexpected(format.error());
  const auto made =
      device_.request_buffers(static_cast<std::uint32_t>(requested_), BufferOwner::Importer);
  if (!made) return tl::unexpected(made.error());
  std::vector<std::unique_ptr<DriverFrame>> frames;
  while (frames.size() < std::min<std::size_t>(*made, kMaxBuffers)) {
    auto memory = allocate(source, *format);
    if (!memory) return fail(Fault::ReadError, memory.error().message);
    frames.push_back(std::make_unique<DriverFrame>(std::move(*memory)));
  }
  return start_with(std::move(frames));
}

/// Allocates the memory planes of one buffer.
Result<std::vector<BufferMemory>> V4l2Stream::allocate(const DmaBufferSource& source,
                                                       const DriverFormat& format) {
  std::vector<BufferMemory> memory;
  for (std::size_t i = 0; i < std::min<std::size_t>(format.memory_count, kMaxPlanes); ++i) {
    auto buffer = source.allocate(format.memory[i].bytes);
    if (!buffer) return tl::unexpected(buffer.error());
    auto mapping = buffer->map(format.memory[i].bytes);
    if (!mapping) return tl::unexpected(mapping.error());
    memory.push_back({std::move(*mapping), std::move(*buffer)});
  }
  return memory;
}

DeviceResult<> V4l2Stream::start_in_own_memory() {
  const auto made = device_.request_buffers(static_cast<std::uint32_t>(requested_));
  if (!made) return tl::unexpected(made.error());
  std::vector<std::unique_ptr<DriverFrame>> frames;
  while (frames.size() < std::min<std::size_t>(*made, kMaxBuffers)) {
    auto memory = device_.map_buffer(static_cast<std::uint32_t>(frames.size()));
    if (!memory) return tl::unexpected(memory.error());
    frames.push_back(std::make_unique<DriverFrame>(std::move(*memory)));
  }
  return start_with(std::move(frames));
}

/// Queues all buffers and starts the device.
DeviceResult<> V4l2Stream::start_with(std::vector<std::unique_ptr<DriverFrame>> frames) {
  if (frames.empty()) return failed("made no buffers");
  for (const auto& frame : frames) {
    if (auto sound = check_memory(*frame); !sound) return sound;
    returned_->put(frames_.size());
    frames_.push_back(frame.get());
  }
  pool_.emplace(std::move(frames),
                [returned = returned_](std::size_t index) { returned->put(index); });
  if (auto queued = queue_returned(); !queued) return queued;
  return device_.stream_on();
}

DeviceResult<> V4l2Stream::check_memory(const DriverFrame& frame) const {
  const std::size_t planes = frame.memory_planes.size();
  if (planes != format_.layout.memory_count) {
    return failed("has buffers in " + std::to_string(planes) + " pieces instead of " +
                  std::to_string(format_.layout.memory_count));
  }
  for (std::size_t i = 0; i < planes; ++i) {
    const std::size_t size = frame.memory_planes[i].mapping.bytes().size();
    const std::size_t needed = format_.layout.needed[i];
    if (size >= needed) continue;
    return fail(Fault::WrongFormat, device_.path() + ": has buffers of " + std::to_string(size) +
                                        " bytes; a picture takes " + std::to_string(needed));
  }
  return {};
}

DeviceResult<> V4l2Stream::queue_returned() {
  const std::uint32_t returned = returned_->take();
  for (std::uint32_t i = 0; i < frames_.size(); ++i) {
    if ((returned >> i & 1U) == 0) continue;
    if (auto queued = queue(i); !queued) return queued;
  }
  return {};
}

DeviceResult<> V4l2Stream::queue(std::uint32_t index) {
  if (auto ended = frames_[index]->end_read(); !ended) return failed(ended.error().message);
  if (auto queued = device_.queue(index, frames_[index]->memory_planes); !queued) return queued;
  queued_ |= 1U << index;
  return {};
}

DeviceResult<std::optional<V4l2Stream::Captured>> V4l2Stream::next(TimePoint deadline) {
  // A device without a buffer to fill makes poll() report an error, so it is omitted then.
  std::array<pollfd, 2> files{{{returned_->descriptor(), POLLIN, 0},
                               {is_starved() ? -1 : device_.descriptor(), POLLIN, 0}}};
  if (::poll(files.data(), files.size(), poll_timeout(deadline)) <= 0) return std::nullopt;
  if (files[0].revents != 0) {
    if (auto queued = queue_returned(); !queued) return tl::unexpected(queued.error());
  }
  if (files[1].revents == 0) return std::nullopt;
  auto captured = take();
  if (captured && !*captured && (files[1].revents & (POLLERR | POLLHUP)) != 0) {
    return failed("the stream was interrupted");
  }
  return captured;
}

DeviceResult<std::optional<V4l2Stream::Captured>> V4l2Stream::take() {
  const auto buffer = device_.dequeue();
  if (!buffer) return tl::unexpected(buffer.error());
  if (!*buffer) return std::nullopt;
  const std::uint32_t index = (*buffer)->index;
  if (index >= pool_->size()) {
    return failed("filled buffer " + std::to_string(index) + ", which does not exist");
  }
  // v4l2loopback fills buffers that were not queued. One in use does not count as a new frame; the
  // new frame is lost, visible as a gap in the sequence.
  if ((queued_ >> index & 1U) == 0) return std::nullopt;
  queued_ &= ~(1U << index);
  auto frame = pool_->acquire(index);
  if (auto begun = frame->begin_read(); !begun) return failed(begun.error().message);
  if (format_.is_zero_copy()) frame->picture = describe(*frame, format_, **buffer);
  return Captured{std::move(frame), **buffer};
}

}  // namespace orbwatch::hal
