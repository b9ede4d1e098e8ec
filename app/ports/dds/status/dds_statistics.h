#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "app/model/field.h"
#include "app/ports/dds/topics/topic_writer.h"

namespace orbwatch::app {

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

/// Everything published and received since construction.
struct DdsStatistics {
  std::vector<TopicStatistics> topics;
  std::uint64_t joins = 0;           ///< of the domain: 1, and one for each change of addresses
  std::uint64_t dropped_states = 0;  ///< replaced by a newer one
  std::uint64_t dropped_events = 0;  ///< the queue was full
  std::uint64_t unknown_views = 0;   ///< View::index beyond the list of names
  std::uint64_t mistyped = 0;        ///< foreign writers and readers of our topics, of other types
  std::uint64_t malformed = 0;       ///< samples that are not valid CDR of their type
  CommandCounts commands;
};

}  // namespace orbwatch::app
