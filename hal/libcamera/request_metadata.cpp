#include "hal/libcamera/request_metadata.h"

#include <libcamera/control_ids.h>

#include <ctime>

namespace orbwatch::hal {
namespace {

using std::chrono::nanoseconds;

/// Six buffers hold no older frame: the stamp is of another clock.
constexpr std::chrono::seconds kOldest{60};

}  // namespace

ClockReading ClockReading::now() {
  timespec boot{};
  ::clock_gettime(CLOCK_BOOTTIME, &boot);
  return {Clock::now(), std::chrono::seconds(boot.tv_sec) + nanoseconds(boot.tv_nsec)};
}

std::optional<TimePoint> to_steady(nanoseconds stamp, const ClockReading& arrival) {
  const nanoseconds now = arrival.steady.time_since_epoch();
  if (stamp > now) stamp -= arrival.boot - now;
  if (stamp > now || stamp < now - kOldest) return std::nullopt;
  return TimePoint(stamp);
}

FrameMetadata metadata_of(const libcamera::ControlList& request, std::uint64_t buffer_stamp,
                          const ClockReading& arrival) {
  namespace controls = libcamera::controls;
  const nanoseconds of_buffer(static_cast<std::int64_t>(buffer_stamp));
  const nanoseconds stamp(request.get(controls::SensorTimestamp).value_or(of_buffer.count()));
  FrameMetadata metadata;
  metadata.exposure_start = to_steady(stamp, arrival).value_or(arrival.steady);
  metadata.exposure_time =
      std::chrono::microseconds(request.get(controls::ExposureTime).value_or(0));
  metadata.gain = static_cast<double>(request.get(controls::AnalogueGain).value_or(1.0F)) *
                  static_cast<double>(request.get(controls::DigitalGain).value_or(1.0F));
  metadata.lux = static_cast<double>(request.get(controls::Lux).value_or(0.0F));
  return metadata;
}

}  // namespace orbwatch::hal
