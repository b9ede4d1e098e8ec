// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "app/ports/dds/generated/time.h"

namespace orbwatch::app::dds {

/// UTC since 1970-01-01, in the form of ROS 2.
using TimeMessage = builtin_interfaces_msg_dds__Time_;

/// Converts a moment between 1901 and 2038 to a message.
inline TimeMessage to_message(std::chrono::system_clock::time_point utc) {
  const auto second = std::chrono::floor<std::chrono::seconds>(utc);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(utc - second);
  return {static_cast<std::int32_t>(second.time_since_epoch().count()),
          static_cast<std::uint32_t>(rest.count())};
}

/// Time since 1970-01-01; defined for any message.
inline std::chrono::nanoseconds since_epoch(const TimeMessage& message) {
  return std::chrono::seconds(message.sec) + std::chrono::nanoseconds(message.nanosec);
}

/// Converts any message to a moment.
inline std::chrono::system_clock::time_point to_utc(const TimeMessage& message) {
  return std::chrono::system_clock::time_point(since_epoch(message));
}

}  // namespace orbwatch::app::dds
