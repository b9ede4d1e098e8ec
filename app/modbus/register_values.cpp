#include "app/modbus/register_values.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::app::modbus {
namespace {

static_assert(int{kFirstCamera} + int{kMaxCameras} <= int{kStatusBits});

bool delivers(const Status& status, std::size_t camera) {
  return camera < status.camera_count && status.cameras[camera].fault == hal::Fault::None;
}

}  // namespace

std::uint32_t low_word(std::uint64_t count) { return static_cast<std::uint32_t>(count); }

std::uint32_t saturated(double value, double scale) {
  const double code = std::round(value / scale);
  return code > 0 ? static_cast<std::uint32_t>(std::min(code, 65535.0)) : 0;
}

std::uint32_t scaled(double value, const signals::SignalInfo& signal) {
  if (!std::isfinite(value)) return kNotValidCode;
  const double code = std::round(std::clamp(value, signal.minimum, signal.maximum) / signal.scale);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(code));
}

std::uint32_t age_code(std::chrono::milliseconds age) {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(age.count(), 0, 0x7fffffff));
}

std::uint32_t status_bits(const Snapshot& snapshot) {
  const Status& status = snapshot.status;
  std::uint32_t bits = 0;
  const auto set = [&bits](std::size_t bit, bool value) { bits |= (value ? 1U : 0U) << bit; };
  set(kRunning, status.state == SystemState::Running);
  set(kDegraded, status.state == SystemState::Degraded);
  set(kFault, status.state == SystemState::Fault);
  set(kHotSpotPresent, status.signals.hot_spot_area > 0);  // false for "not valid", which is NaN
  set(kStale, snapshot.stale);
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    set(kFirstCamera + camera, !snapshot.stale && delivers(status, camera));
  }
  return bits;
}

}  // namespace orbwatch::app::modbus
