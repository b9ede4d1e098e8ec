#include "hal/v4l2/buffer_stamps.h"

namespace orbwatch::hal {
namespace {

/// Older than any frame that a driver of six buffers can still hold: a stamp of another clock.
constexpr std::chrono::seconds kOldest{60};

}  // namespace

TimePoint exposure_start(const v4l2_buffer& buffer, TimePoint arrival) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return arrival;
  }
  const TimePoint stamp{std::chrono::seconds(buffer.timestamp.tv_sec) +
                        std::chrono::microseconds(buffer.timestamp.tv_usec)};
  return stamp > arrival || stamp < arrival - kOldest ? arrival : stamp;
}

}  // namespace orbwatch::hal
