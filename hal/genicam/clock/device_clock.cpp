// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/clock/device_clock.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::hal {
namespace {

constexpr double to_ns(std::chrono::nanoseconds duration) {
  return static_cast<double>(duration.count());
}

std::chrono::nanoseconds from_ns(double duration) {
  return std::chrono::nanoseconds(std::llround(duration));
}

}  // namespace

double DeviceClock::lateness(const Moment& moment) const {
  const double x = to_ns(moment.device - origin_.device);
  return to_ns(moment.steady - origin_.steady) - x - drift_ * x;
}

bool DeviceClock::continues(const Moment& moment) const {
  if (!has_line_) return true;
  const double late = lateness(moment);
  return moment.device >= newest_ && late >= -to_ns(kFast) && late <= to_ns(kSlow);
}

void DeviceClock::start_anew() {
  const std::size_t jumps = jumps_ + 1;
  *this = {};
  jumps_ = jumps;
}

void DeviceClock::add_latched(nanoseconds device, TimePoint before, TimePoint after) {
  const Moment moment{device, before + (after - before) / 2};
  if (!continues(moment) || (has_line_ && lateness(moment) > to_ns(kFast))) start_anew();
  newest_ = device;
  add(moment);
}

void DeviceClock::add_arrival(nanoseconds device, TimePoint steady) {
  const Moment moment{device, steady};
  if (!continues(moment)) start_anew();
  newest_ = device;
  if (!has_line_) {
    has_line_ = true;
    origin_ = moment;
  }
  if (has_block_ && device - block_begin_ >= kBlock) {
    add(fastest_);
    has_block_ = false;
  }
  if (!has_block_) block_begin_ = device;
  if (!has_block_ || lateness(moment) < lateness(fastest_)) fastest_ = moment;
  has_block_ = true;
  // Before there are moments, the line passes through the fastest frame so far.
  if (count_ == 0) origin_ = fastest_;
}

void DeviceClock::add(Moment moment) {
  far_ = has_line_ && std::abs(lateness(moment)) > to_ns(kStep) ? far_ + 1 : 0;
  if (far_ >= 2) {
    const nanoseconds newest = newest_;
    start_anew();
    newest_ = newest;
  }
  moments_[count_++ % kMoments] = moment;
  fit();
}

/// Least squares, relative to the newest moment so that no sum is large.
void DeviceClock::fit() {
  const Moment& newest = moments_[(count_ - 1) % kMoments];
  const double n = static_cast<double>(known());
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (std::size_t i = 0; i < known(); ++i) {
    const double x = to_ns(moments_[i].device - newest.device);
    const double y = to_ns(moments_[i].steady - newest.steady) - x;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const double spread = n * sum_xx - sum_x * sum_x;
  if (spread > 0) {
    drift_ = std::clamp((n * sum_xy - sum_x * sum_y) / spread, -kMostDrift, kMostDrift);
  }
  origin_ = {newest.device, newest.steady + from_ns((sum_y - drift_ * sum_x) / n)};
  has_line_ = true;
}

std::optional<TimePoint> DeviceClock::to_steady(nanoseconds device) const {
  if (!has_line_) return std::nullopt;
  const nanoseconds since = device - origin_.device;
  return origin_.steady + since + from_ns(drift_ * to_ns(since));
}

std::optional<std::chrono::nanoseconds> DeviceClock::residual() const {
  if (known() < 3) return std::nullopt;
  double squares = 0;
  for (std::size_t i = 0; i < known(); ++i) squares += std::pow(lateness(moments_[i]), 2);
  return from_ns(std::sqrt(squares / static_cast<double>(known())));
}

}  // namespace orbwatch::hal
