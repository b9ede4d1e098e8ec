// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/genicam_stream.h"

#include <poll.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hal/frame/exposure_start.h"
#include "hal/thread/scheduling.h"

namespace orbwatch::hal {
namespace {

/// Marks a buffer without the id that a first packet states.
constexpr std::uint64_t kNoId = std::numeric_limits<std::uint64_t>::max();

/// Bytes that the kernel keeps while this process does not run: some pictures. The kernel limits
/// them to net.core.rmem_max.
int socket_buffer(std::size_t payload) {
  constexpr std::size_t kPictures = 4;
  constexpr std::size_t kLeast = std::size_t{1} << 20;
  constexpr std::size_t kMost = std::size_t{1} << 25;
  return static_cast<int>(std::clamp(kPictures * payload, kLeast, kMost));
}

}  // namespace

TimePoint arrival_of(std::uint64_t system_time, TimePoint now) {
  using std::chrono::nanoseconds;
  const auto system_now = std::chrono::system_clock::now().time_since_epoch();
  const auto age = std::chrono::duration_cast<nanoseconds>(system_now) -
                   nanoseconds(static_cast<std::int64_t>(system_time));
  // An implausible arrival means that the system's clock was set since.
  return is_plausible(now - age, now) ? now - age : now;
}

GenicamFrame::GenicamFrame(std::size_t bytes) {
  capacity = bytes;
  storage = std::make_unique<std::byte[]>(bytes);
  memory = storage.get();
  buffer.reset(arv_buffer_new_full(bytes, memory, this, nullptr));
}

DeviceResult<std::unique_ptr<GenicamStream>> GenicamStream::start(ArvCamera* camera,
                                                                  const GenicamStreamFormat& format,
                                                                  std::size_t buffers) {
  std::unique_ptr<GenicamStream> stream(
      new GenicamStream(camera, text_of(arv_camera_get_device_serial_number(camera, nullptr))));
  Events* const events = stream->events_.get();
  if (!events->returned.is_open()) return stream->failed("too many open files");
  AravisError error;
  stream->stream_.reset(arv_camera_create_stream(camera, on_stream_event, events, error.out()));
  if (error || !stream->stream_) return stream->failed(error.message());
  if (ARV_IS_GV_STREAM(stream->stream_.get())) {
    g_object_set(stream->stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED,
                 "socket-buffer-size", socket_buffer(format.payload), nullptr);
  }
  // The handler may still run after its disconnection, so it owns a reference of its own.
  stream->control_handler_ = g_signal_connect_data(
      arv_camera_get_device(camera), "control-lost", reinterpret_cast<GCallback>(on_control_lost),
      new std::shared_ptr<Events>(stream->events_),
      [](void* share, GClosure*) { delete static_cast<std::shared_ptr<Events>*>(share); },
      G_CONNECT_DEFAULT);
  stream->make_buffers(format.payload, buffers);
  arv_camera_start_acquisition(camera, error.out());
  if (error) return stream->failed("does not start: " + error.message());
  stream->is_started_ = true;
  return stream;
}

GenicamStream::~GenicamStream() {
  // This fails when the camera is gone; nothing is left to do then.
  if (is_started_ && !is_lost_) arv_camera_stop_acquisition(camera_, nullptr);
  if (control_handler_ != 0) {
    g_signal_handler_disconnect(arv_camera_get_device(camera_), control_handler_);
  }
}

void GenicamStream::make_buffers(std::size_t bytes, std::size_t count) {
  std::vector<std::unique_ptr<GenicamFrame>> frames;
  for (std::size_t i = 0; i < std::min(count, kMaxBuffers); ++i) {
    frames.push_back(std::make_unique<GenicamFrame>(bytes));
    frames_.push_back(frames.back().get());
  }
  pool_.emplace(std::move(frames),
                [events = events_](std::size_t index) { events->returned.put(index); });
  for (std::size_t i = 0; i < frames_.size(); ++i) queue(i);
}

/// Aravis keeps a reference to the buffer until take().
void GenicamStream::queue(std::size_t index) {
  ArvBuffer* const buffer = frames_[index]->buffer.get();
  arv_buffer_set_frame_id(buffer, kNoId);
  arv_buffer_set_system_timestamp(buffer, 0);
  g_object_ref(buffer);
  arv_stream_push_buffer(stream_.get(), buffer);
  ++queued_;
}

void GenicamStream::on_stream_event(void* share, ArvStreamCallbackType type, ArvBuffer*) {
  Events& events = *static_cast<Events*>(share);
  if (type == ARV_STREAM_CALLBACK_TYPE_INIT) schedule_this_thread(ThreadRole::Capture);
  if (type == ARV_STREAM_CALLBACK_TYPE_START_BUFFER) events.begun.put(Clock::now());
  if (type == ARV_STREAM_CALLBACK_TYPE_BUFFER_DONE) events.returned.wake();
}

void GenicamStream::on_control_lost(ArvDevice*, void* share) {
  Events& events = **static_cast<std::shared_ptr<Events>*>(share);
  events.control_lost = true;
  events.returned.wake();
}

DeviceResult<std::optional<GenicamStream::Captured>> GenicamStream::next(TimePoint deadline) {
  pollfd file{events_->returned.descriptor(), POLLIN, 0};
  if (auto captured = take()) return captured;
  if (::poll(&file, 1, poll_timeout(deadline)) > 0) {
    const std::uint32_t returned = events_->returned.take();
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if ((returned >> i & 1U) != 0) queue(i);
    }
  }
  if (events_->control_lost) {
    is_lost_ = true;
    return failed("was disconnected, or another host took control of it");
  }
  return take();
}

std::optional<GenicamStream::Captured> GenicamStream::take() {
  const OwnedObject<ArvBuffer> buffer(arv_stream_try_pop_buffer(stream_.get()));
  if (!buffer) return std::nullopt;
  --queued_;
  const auto* const of = static_cast<const GenicamFrame*>(arv_buffer_get_user_data(buffer.get()));
  const auto index = static_cast<std::size_t>(std::ranges::find(frames_, of) - frames_.begin());
  const std::uint64_t id = arv_buffer_get_frame_id(buffer.get());
  const TimePoint now = Clock::now();
  // Aravis closes frames of GigE Vision in the order in which they begin. It announces those of
  // USB3 Vision early, or not at all.
  const auto begun = ARV_IS_GV_STREAM(stream_.get()) ? events_->begun.try_take() : std::nullopt;
  return Captured{
      pool_->acquire(index), arv_buffer_get_status(buffer.get()),
      id == kNoId ? std::nullopt : std::optional(id),
      std::chrono::nanoseconds(static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer.get()))),
      id == kNoId ? begun.value_or(now)
                  : arrival_of(arv_buffer_get_system_timestamp(buffer.get()), now)};
}

LinkCounts GenicamStream::link_counts() const {
  LinkCounts counts;
  guint64 completed = 0, failures = 0, underruns = 0;
  arv_stream_get_statistics(stream_.get(), &completed, &failures, &underruns);
  counts.underruns = underruns;
  if (ARV_IS_GV_STREAM(stream_.get())) {
    guint64 resent = 0, missing = 0;
    arv_gv_stream_get_statistics(ARV_GV_STREAM(stream_.get()), &resent, &missing);
    counts.resent_packets = resent;
    counts.missing_packets = missing;
  }
  return counts;
}

tl::unexpected<FaultReport> GenicamStream::failed(const std::string& reason) const {
  return fail(Fault::Unplugged, "genicam: camera " + id_ + ": " + reason);
}

}  // namespace orbwatch::hal
