#include "hal/v4l2/buffer_stamps.h"

namespace orbwatch::hal {
namespace {

/// Older than any frame that a driver of six buffers can still hold: a stamp of another clock.
constexpr std::chrono::seconds kOldest{60};

}  // namespace

std::uint64_t FrameCounter::number(std::uint32_t driver_sequence) {
  const std::uint32_t step = driver_sequence - last_;
  const bool forward = step != 0 && step <= UINT32_MAX / 2;
  if (!fresh_ && forward) next_ += step - 1;
  fresh_ = false;
  last_ = driver_sequence;
  return next_++;
}

TimePoint exposure_start(const v4l2_buffer& buffer, TimePoint arrival) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return arrival;
  }
  const TimePoint stamp{std::chrono::seconds(buffer.timestamp.tv_sec) +
                        std::chrono::microseconds(buffer.timestamp.tv_usec)};
  return stamp > arrival || stamp < arrival - kOldest ? arrival : stamp;
}

}  // namespace orbwatch::hal
