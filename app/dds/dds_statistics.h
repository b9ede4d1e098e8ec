#pragma once

#include <cstdint>
#include <vector>

#include "app/dds/command_counts.h"
#include "app/dds/topic_writer.h"

namespace orbwatch::app {

/// What became of everything handed over or taken in, since construction.
struct DdsStatistics {
  std::vector<TopicStatistics> topics;
  std::uint64_t joins = 0;            ///< of the domain: 1, and one for each change of addresses
  std::uint64_t dropped_states = 0;   ///< replaced by a newer one
  std::uint64_t dropped_notices = 0;  ///< refused: too many at once
  std::uint64_t unknown_views = 0;    ///< View::index beyond the list of names
  std::uint64_t mistyped = 0;         ///< writers and readers of others with our topic, other type
  std::uint64_t malformed = 0;        ///< samples that are not what their type says
  CommandCounts commands;
};

}  // namespace orbwatch::app
