// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_stream.h"

#include <libcamera/control_ids.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace orbwatch::hal {

template <class Change>
void CaptureEvents::post(const Change& change) {
  {
    const std::lock_guard lock(mutex_);
    change(pending_);
  }
  changed_.notify_one();
}

void CaptureEvents::complete(std::size_t request) {
  post([request](Pending& pending) {
    assert(pending.completed_count < kMaxRequests);
    pending.completed[pending.completed_count++] = static_cast<std::uint8_t>(request);
  });
}

void CaptureEvents::return_buffer(std::size_t buffer) {
  post([buffer](Pending& pending) { pending.returned |= 1U << buffer; });
}

void CaptureEvents::remove_camera() {
  post([](Pending& pending) { pending.removed = true; });
}

void CaptureEvents::wake() {
  post([](Pending& pending) { pending.woken = true; });
}

CaptureEvents::Pending CaptureEvents::wait(TimePoint deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] {
    return pending_.completed_count != 0 || pending_.returned != 0 || pending_.removed ||
           pending_.woken;
  });
  return std::exchange(pending_, {});
}

LibcameraStream::LibcameraStream(AcquiredCamera camera, ControlSettings& controls)
    : camera_(std::move(camera)),
      controls_(controls),
      removal_(camera_.share(), [events = events_] { events->remove_camera(); }),
      allocator_(camera_.share()) {}

DeviceResult<std::unique_ptr<LibcameraStream>> LibcameraStream::start(
    AcquiredCamera camera, const NegotiatedConfiguration& negotiated, ControlSettings& controls,
    const std::vector<DmaBufferSource>& sources) {
  std::unique_ptr<LibcameraStream> stream(new LibcameraStream(std::move(camera), controls));
  const auto named = [&stream](const Error& error) {
    return fail(Fault::ReadError, stream->camera_->id() + ": " + error.message);
  };
  if (auto made = stream->make_buffers(negotiated, sources); !made) return named(made.error());
  if (auto made = stream->make_requests(); !made) return named(made.error());
  if (auto runs = stream->run(negotiated.stream.frame_rate); !runs) {
    return tl::unexpected(runs.error());
  }
  return stream;
}

LibcameraStream::~LibcameraStream() {
  if (!ended_) end();
}

bool LibcameraStream::end() {
  ended_ = true;
  // libcamera permits stopping a camera whose removal it detected itself.
  const bool gone = !removed_ && has_lost_its_nodes(*camera_);
  if (gone) return false;
  // Cancels queued requests.
  camera_->stop();
  camera_->requestCompleted.disconnect(events_.get());
  return true;
}

/// The camera's own buffers show how a driver lays out their planes; imported ones replace them.
Result<> LibcameraStream::make_buffers(const NegotiatedConfiguration& negotiated,
                                       const std::vector<DmaBufferSource>& sources) {
  stream_ = negotiated.picture().stream();
  requested_ = negotiated.requested_buffers;
  if (const int made = allocator_.allocate(stream_); made <= 0) {
    return fail("has no buffers: " + std::generic_category().message(-made));
  }
  memory_ = choose_memory(sources, [&](const DmaBufferSource& source) {
    return import_buffers(source).and_then([&] { return map_buffers(negotiated); });
  });
  if (!memory_.source.empty()) {
    allocator_.free(stream_);
    return {};
  }
  imported_.clear();
  return map_buffers(negotiated);
}

Result<> LibcameraStream::import_buffers(const DmaBufferSource& source) {
  std::vector<std::unique_ptr<libcamera::FrameBuffer>> buffers;
  for (const auto& own : allocator_.buffers(stream_)) {
    auto buffer = make_buffer_like(*own, source);
    if (!buffer) return tl::unexpected(buffer.error());
    buffers.push_back(std::move(*buffer));
  }
  imported_ = std::move(buffers);
  return {};
}

Result<> LibcameraStream::map_buffers(const NegotiatedConfiguration& negotiated) {
  const StreamFormat& format = negotiated.stream;
  frames_.clear();
  std::vector<std::unique_ptr<LibcameraFrame>> frames;
  for (const auto& buffer : buffers()) {
    if (frames.size() == CaptureEvents::kMaxRequests) break;
    auto frame = LibcameraFrame::map(*buffer, *negotiated.pixels, format.width, format.height,
                                     negotiated.stride);
    if (!frame) return tl::unexpected(frame.error());
    (*frame)->picture.colour_space = format.colour_space;
    frames_.push_back(frame->get());
    frames.push_back(std::move(*frame));
  }
  pool_.emplace(std::move(frames),
                [events = events_](std::size_t buffer) { events->return_buffer(buffer); });
  return {};
}

Result<> LibcameraStream::make_requests() {
  for (std::size_t number = 0; number < pool_->size(); ++number) {
    auto request = camera_->createRequest(number);
    if (!request) return fail("creates no request");
    const int error = request->addBuffer(stream_, buffers()[number].get());
    if (error < 0) return fail("refuses a buffer: " + std::generic_category().message(-error));
    requests_.push_back(std::move(request));
  }
  CaptureEvents* const events = events_.get();
  camera_->requestCompleted.connect(
      events, [events](libcamera::Request* request) { events->complete(request->cookie()); });
  return {};
}

DeviceResult<> LibcameraStream::run(double frame_rate) {
  libcamera::ControlList controls = controls_.all();
  put_frame_rate(frame_rate, controls);
  if (const int error = camera_->start(&controls); error < 0) return failed("start", error);
  for (std::size_t number = 0; number < requests_.size(); ++number) {
    if (auto queued = queue(number); !queued) return queued;
  }
  return {};
}

DeviceResult<> LibcameraStream::queue(std::size_t number) {
  libcamera::Request& request = *requests_[number];
  controls_.add_changes(request.controls());
  if (const int error = camera_->queueRequest(&request); error < 0) {
    return failed("accept a request", error);
  }
  ++queued_;
  return {};
}

DeviceResult<> LibcameraStream::queue_returned(std::uint32_t returned) {
  for (std::size_t number = 0; number < requests_.size(); ++number) {
    if ((returned >> number & 1U) == 0) continue;
    if (auto ended = frames_[number]->end_read(); !ended) {
      return fail(Fault::ReadError, camera_->id() + ": " + ended.error().message);
    }
    requests_[number]->reuse(libcamera::Request::ReuseBuffers);
    if (auto queued = queue(number); !queued) return queued;
  }
  return {};
}

DeviceResult<LibcameraStream::Captured> LibcameraStream::take(std::size_t number) {
  const libcamera::Request& request = *requests_[number];
  --queued_;
  if (request.status() != libcamera::Request::RequestComplete) {
    return fail(Fault::ReadError, camera_->id() + ": libcamera cancelled a request");
  }
  auto frame = pool_->acquire(number);
  if (auto begun = frame->begin_read(); !begun) {
    return fail(Fault::ReadError, camera_->id() + ": " + begun.error().message);
  }
  return Captured{std::move(frame), requests_[number]->metadata(),
                  request.findBuffer(stream_)->metadata()};
}

DeviceResult<std::size_t> LibcameraStream::wait(TimePoint deadline, const OnCaptured& on_captured) {
  const CaptureEvents::Pending pending = events_->wait(deadline);
  if (pending.removed) {
    removed_ = true;
    return fail(Fault::Unplugged, camera_->id() + ": was removed");
  }
  if (auto queued = queue_returned(pending.returned); !queued)
    return tl::unexpected(queued.error());
  for (std::size_t i = 0; i < pending.completed_count; ++i) {
    const auto captured = take(pending.completed[i]);
    if (!captured) return tl::unexpected(captured.error());
    on_captured(*captured);
  }
  return pending.completed_count;
}

tl::unexpected<FaultReport> LibcameraStream::failed(const std::string& action, int error) const {
  return fail(
      error == -ENODEV ? Fault::Unplugged : Fault::ReadError,
      camera_->id() + ": does not " + action + ": " + std::generic_category().message(-error));
}

}  // namespace orbwatch::hal
