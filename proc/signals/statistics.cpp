// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/statistics.h"

#include <cmath>

namespace orbwatch::signals {

void Statistics::Moments::join(const Moments& other) {
  const double both = count + other.count;
  if (!(both > 0)) return;
  const double share = other.count / both;
  const double between = count * share;
  const double dt = other.time - time, dv = other.value - value;
  time += share * dt;
  value += share * dv;
  time_time += other.time_time + between * dt * dt;
  time_value += other.time_value + between * dt * dv;
  value_value += other.value_value + between * dv * dv;
  count = both;
}

void Statistics::add(double now, double value) {
  bins_.advance(now);
  if (is_valid(value)) bins_.at(now).join({1, now, value, 0, 0, 0});
}

Statistics::Figures Statistics::figures() const {
  Moments all;
  bins_.for_each([&](const Moments& bin) { all.join(bin); });
  Figures figures;
  if (all.count < 1) return figures;
  figures.mean = all.value;
  if (all.count < 2) return figures;
  figures.deviation = std::sqrt(all.value_value / (all.count - 1));
  if (all.time_time > 0) figures.trend = all.time_value / all.time_time;
  return figures;
}

}  // namespace orbwatch::signals
