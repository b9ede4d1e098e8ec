#include "hal/v4l2/buffer_stamps.h"

namespace orbwatch::hal {
namespace {

/// A driver with six buffers holds no older frame: the stamp is of another clock.
constexpr std::chrono::seconds kOldest{60};

}  // namespace

FrameStamp frame_stamp(const FilledBuffer& buffer, TimePoint arrival) {
  const FrameStamp none{arrival, StampSource::Arrival};
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return none;
  }
  const TimePoint stamp{std::chrono::seconds(buffer.timestamp.tv_sec) +
                        std::chrono::microseconds(buffer.timestamp.tv_usec)};
  if (stamp > arrival || stamp < arrival - kOldest) return none;
  const bool start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  return {stamp, start ? StampSource::ExposureStart : StampSource::FrameEnd};
}

}  // namespace orbwatch::hal
