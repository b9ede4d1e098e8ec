#pragma once

#include <cstdint>

namespace orbwatch::app {

/// What became of the requests on the command topic.
struct CommandCounts {
  std::uint64_t done = 0;
  std::uint64_t refused = 0;   ///< answered with another result than done
  std::uint64_t repeated = 0;  ///< not carried out again
  std::uint64_t dropped = 0;   ///< not answered: too many at once

  bool operator==(const CommandCounts&) const = default;
};

/// Its fields, for the visitors of app/json/status_fields.h.
template <class Visitor>
void visit(Visitor& v, const CommandCounts& counts) {
  v.field("done", counts.done);
  v.field("refused", counts.refused);
  v.field("repeated", counts.repeated);
  v.field("dropped", counts.dropped);
}

}  // namespace orbwatch::app
