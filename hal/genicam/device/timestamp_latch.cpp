// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/device/timestamp_latch.h"

#include <array>
#include <cstdint>

namespace orbwatch::hal {
namespace {

constexpr std::uint64_t kNanoseconds = 1'000'000'000;  // per second

/// Converts ticks like Aravis converts the stamps of frames: whole seconds first, so that no digit
/// is lost.
std::chrono::nanoseconds to_ns(std::uint64_t ticks, std::uint64_t frequency) {
  const std::uint64_t rest = ticks % frequency * kNanoseconds / frequency;
  return std::chrono::seconds(ticks / frequency) +
         std::chrono::nanoseconds(static_cast<std::int64_t>(rest));
}

}  // namespace

std::optional<TimestampLatch> TimestampLatch::find(ArvCamera* camera) {
  constexpr std::array kKinds{
      Names{"TimestampLatch", "TimestampLatchValue", false},
      Names{"GevTimestampControlLatch", "GevTimestampValue", true},
  };
  ArvDevice* const device = arv_camera_get_device(camera);
  for (const Names& names : kKinds) {
    if (!ARV_IS_GC_COMMAND(arv_device_get_feature(device, names.command)) ||
        !arv_device_is_feature_available(device, names.value, nullptr)) {
      continue;
    }
    if (!names.in_ticks) return TimestampLatch(device, names, kNanoseconds);
    if (!ARV_IS_GV_DEVICE(device)) continue;
    const guint64 frequency =
        arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(device), nullptr);
    // A frequency beyond 10 GHz is not plausible, and would overflow the conversion.
    if (frequency > 0 && frequency <= 10 * kNanoseconds) {
      return TimestampLatch(device, names, frequency);
    }
  }
  return std::nullopt;
}

std::optional<TimestampLatch::Reading> TimestampLatch::read() const {
  AravisError error;
  Reading reading{};
  reading.before = Clock::now();
  arv_device_execute_command(device_, names_.command, error.out());
  reading.after = Clock::now();
  if (error) return std::nullopt;
  const gint64 value = arv_device_get_integer_feature_value(device_, names_.value, error.out());
  if (error || value <= 0) return std::nullopt;
  reading.device = to_ns(static_cast<std::uint64_t>(value), frequency_);
  return reading;
}

}  // namespace orbwatch::hal
