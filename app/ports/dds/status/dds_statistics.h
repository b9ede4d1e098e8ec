// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "app/model/status/field.h"
#include "app/ports/dds/topics/topic_writer.h"

namespace orbwatch::app::dds {

#define ORBWATCH_COMMAND_COUNTS(FIELD)                                                      \
  FIELD(std::uint64_t, done, kCount, "Requests carried out")                                \
  FIELD(std::uint64_t, refused, kCount, "Requests answered with another result than done")  \
  FIELD(std::uint64_t, repeated, kCount, "Repetitions of a request; not carried out again") \
  FIELD(std::uint64_t, dropped, kCount, "Requests lost unanswered because the queue was full")

/// Requests on the command topic since start. Reported as a component of kind "commands".
struct CommandCounts {
  ORBWATCH_COMMAND_COUNTS(ORBWATCH_FIELD_MEMBER)

  bool operator==(const CommandCounts&) const = default;
};

template <class Visit>
constexpr void for_each_field(std::type_identity<CommandCounts>, Visit&& visit) {
  using Part = CommandCounts;
  ORBWATCH_COMMAND_COUNTS(ORBWATCH_VISIT_FIELD)
}

#define ORBWATCH_DDS_COUNTS(FIELD)                                                          \
  FIELD(std::uint64_t, joins, kCount,                                                       \
        "Joins of the domain: 1, and one more for each change of addresses")                \
  FIELD(std::uint64_t, dropped_states, kCount,                                              \
        "States replaced by a newer one, and results beyond the eight that may wait")       \
  FIELD(std::uint64_t, dropped_events, kCount, "Events lost because the queue was full")    \
  FIELD(std::uint64_t, unknown_views, kCount, "Pictures of views beyond the list of names") \
  FIELD(std::uint64_t, mistyped, kCount,                                                    \
        "Foreign writers and readers of our topics with other types")                       \
  FIELD(std::uint64_t, malformed, kCount, "Received samples that are not valid CDR of their type")

/// Counts over all topics together, since construction.
struct DdsCounts {
  ORBWATCH_DDS_COUNTS(ORBWATCH_FIELD_MEMBER)
};

template <class Visit>
constexpr void for_each_field(std::type_identity<DdsCounts>, Visit&& visit) {
  using Part = DdsCounts;
  ORBWATCH_DDS_COUNTS(ORBWATCH_VISIT_FIELD)
}

/// Everything published and received since construction.
struct DdsStatistics : DdsCounts {
  std::vector<TopicStatistics> topics;
  CommandCounts commands;
};

}  // namespace orbwatch::app::dds
