#include "hal/v4l2/v4l2_stream.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "hal/frame_pool.h"

namespace orbwatch::hal {
namespace {

/// For poll(): rounded up, so that the deadline has passed when it returns.
int milliseconds_until(TimePoint deadline) {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::clamp(left, milliseconds(0), milliseconds(60'000)).count());
}

void describe(DriverFrame& frame, const V4l2Agreement& agreement) {
  frame.picture =
      Picture::contiguous(agreement.stream.format, agreement.stream.width, agreement.stream.height,
                          frame.memory, static_cast<std::ptrdiff_t>(agreement.stride));
  frame.picture.colour_space = agreement.stream.colour_space;
}

}  // namespace

DriverFrame::DriverFrame(MappedMemory driver_memory) : mapping(std::move(driver_memory)) {
  memory = mapping.bytes().data();
  capacity = mapping.bytes().size();
}

ReturnedBuffers::ReturnedBuffers() : bell_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

void ReturnedBuffers::put(std::size_t index) {
  returned_.fetch_or(1U << index);
  ring();
}

void ReturnedBuffers::ring() {
  // Fails only when 2^64 - 1 rings were not heard; then it rings already.
  static_cast<void>(::eventfd_write(bell_.get(), 1));
}

std::uint32_t ReturnedBuffers::take() {
  eventfd_t rings = 0;
  static_cast<void>(::eventfd_read(bell_.get(), &rings));  // fails when nobody rang
  return returned_.exchange(0);
}

DeviceResult<std::unique_ptr<V4l2Stream>> V4l2Stream::start(V4l2Device device,
                                                            const V4l2Agreement& agreement) {
  std::unique_ptr<V4l2Stream> stream(new V4l2Stream(std::move(device)));
  if (!stream->returned_->is_open()) {
    return tl::unexpected(FaultReport{Fault::ReadError, "too many open files"});
  }
  if (auto made = stream->make_buffers(agreement); !made) return tl::unexpected(made.error());
  if (auto queued = stream->queue_returned(); !queued) return tl::unexpected(queued.error());
  if (auto on = stream->device_.stream_on(); !on) return tl::unexpected(on.error());
  return stream;
}

V4l2Stream::~V4l2Stream() {
  // Mapped buffers keep the device's file open; giving them back sets the device free for the next
  // stream all the same. Both calls fail when the device is gone, and then nothing is left to do.
  static_cast<void>(device_.stream_off());
  static_cast<void>(device_.request_buffers(0));
}

DeviceResult<> V4l2Stream::make_buffers(const V4l2Agreement& agreement) {
  const auto made = device_.request_buffers(kFramesPerCamera);
  if (!made) return tl::unexpected(made.error());
  const std::size_t count = std::min<std::size_t>(*made, ReturnedBuffers::kMaxBuffers);
  const bool packed = agreement.pixels.fourcc == V4L2_PIX_FMT_MJPEG;
  const std::size_t needed =
      packed ? 1 : agreement.stride * static_cast<std::size_t>(agreement.stream.height);
  std::vector<std::unique_ptr<DriverFrame>> frames;
  for (std::size_t i = 0; i < count; ++i) {
    auto memory = device_.map_buffer(static_cast<std::uint32_t>(i));
    if (!memory) return tl::unexpected(memory.error());
    frames.push_back(std::make_unique<DriverFrame>(std::move(*memory)));
    if (frames.back()->capacity < needed) {
      return tl::unexpected(
          FaultReport{Fault::WrongFormat, device_.path() + ": has buffers of " +
                                              std::to_string(frames.back()->capacity) +
                                              " bytes; a picture takes " + std::to_string(needed)});
    }
    if (!packed) describe(*frames.back(), agreement);
    returned_->put(i);
  }
  pool_.emplace(std::move(frames),
                [returned = returned_](std::size_t index) { returned->put(index); });
  return {};
}

DeviceResult<> V4l2Stream::queue_returned() {
  const std::uint32_t returned = returned_->take();
  for (std::uint32_t i = 0; i < pool_->size(); ++i) {
    if ((returned >> i & 1U) == 0) continue;
    if (auto queued = device_.queue(i); !queued) return queued;
    ++queued_;
  }
  return {};
}

DeviceResult<std::optional<V4l2Stream::Captured>> V4l2Stream::next(TimePoint deadline) {
  // A driver without a buffer to fill reports an error to poll(), so it is left out then.
  std::array<pollfd, 2> files{{{returned_->descriptor(), POLLIN, 0},
                               {is_starved() ? -1 : device_.descriptor(), POLLIN, 0}}};
  if (::poll(files.data(), files.size(), milliseconds_until(deadline)) <= 0) return std::nullopt;
  if (files[0].revents != 0) {
    if (auto queued = queue_returned(); !queued) return tl::unexpected(queued.error());
  }
  if (files[1].revents == 0) return std::nullopt;
  auto captured = take();
  if (captured && !*captured && (files[1].revents & (POLLERR | POLLHUP)) != 0) {
    return tl::unexpected(FaultReport{Fault::ReadError, device_.path() + ": the stream broke off"});
  }
  return captured;
}

DeviceResult<std::optional<V4l2Stream::Captured>> V4l2Stream::take() {
  const auto buffer = device_.dequeue();
  if (!buffer) return tl::unexpected(buffer.error());
  if (!*buffer) return std::nullopt;
  const std::uint32_t index = (*buffer)->index;
  auto frame = index < pool_->size() ? pool_->acquire(index) : nullptr;
  if (!frame || queued_ == 0) {
    return tl::unexpected(FaultReport{
        Fault::ReadError,
        device_.path() + ": filled buffer " + std::to_string(index) + ", which it was not given"});
  }
  --queued_;
  return Captured{std::move(frame), **buffer};
}

}  // namespace orbwatch::hal
