// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/utc_text.h"

#include <cstdio>
#include <ctime>

#include "hal/calendar_time.h"

namespace orbwatch::app {

std::optional<std::string> utc_text(std::chrono::system_clock::time_point moment) {
  if (moment == std::chrono::system_clock::time_point{}) return std::nullopt;
  const auto second = std::chrono::floor<std::chrono::seconds>(moment);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(moment - second).count();
  const std::tm fields = hal::calendar_time(second);
  char text[64];
  const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &fields);
  std::snprintf(text + length, sizeof text - length, ".%09lldZ", static_cast<long long>(rest));
  return text;
}

}  // namespace orbwatch::app
