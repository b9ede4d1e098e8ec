// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include "app/model/status/field.h"
#include "app/model/status/readings.h"

namespace orbwatch::app::web {

inline constexpr Quantity kDays{"d", 0.01, -100000, 100000};

#define ORBWATCH_WEB_FIGURES(FIELD)                                                                \
  FIELD(std::uint64_t, connections, kCount, "Open connections")                                    \
  FIELD(std::uint64_t, streams, kCount, "Open streams of pictures")                                \
  FIELD(std::uint64_t, requests, kCount, "Requests received completely")                           \
  FIELD(std::uint64_t, refused, kCount, "Requests refused for their form, size or host name")      \
  FIELD(std::uint64_t, overdue, kCount, "Connections ended because the client was too slow")       \
  FIELD(std::uint64_t, pictures_sent, kCount,                                                      \
        "Pictures whose transmission in a stream was started")                                     \
  FIELD(std::uint64_t, pictures_skipped, kCount, "Pictures not sent to slower readers of streams") \
  FIELD(std::uint64_t, pictures_replaced, kCount, "Pictures replaced before they were compressed") \
  FIELD(std::uint64_t, pictures_compressed, kCount,                                                \
        "Pictures compressed, each once in every size that has readers")                           \
  FIELD(std::uint64_t, commands_done, kCount, "Commands carried out")                              \
  FIELD(std::uint64_t, commands_refused, kCount,                                                   \
        "Commands answered with another result than done")                                         \
  FIELD(std::uint64_t, turned_away, kCount,                                                        \
        "Connections closed because their address had max_connections_per_address")                \
  FIELD(double, certificate_days, kDays,                                                           \
        "Time until the HTTPS certificate expires; NaN: no HTTPS")                                 \
  FIELD(std::uint64_t, streams_refused, kCount, "Streams refused because max_streams were open")   \
  FIELD(std::uint64_t, logins_failed, kCount,                                                      \
        "Wrong passwords, and wrong codes for the first password")                                 \
  FIELD(std::uint64_t, alarm_events, kCount,                                                       \
        "Events of alarms: raised, acknowledged, cleared, see /api/v1/history/alarms")

inline const Component kWebComponent{"web"};

/// Counters of the web interface itself, since the start. Reported as kWebComponent.
struct WebStatistics {
  ORBWATCH_WEB_FIGURES(ORBWATCH_FIELD_MEMBER)
};

template <class Visit>
constexpr void for_each_field(std::type_identity<WebStatistics>, Visit&& visit) {
  using Part = WebStatistics;
  ORBWATCH_WEB_FIGURES(ORBWATCH_VISIT_FIELD)
}

}  // namespace orbwatch::app::web
