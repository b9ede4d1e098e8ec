#pragma once

#include <cstdint>

namespace orbwatch::app {

/// Samples that Cyclone DDS took for damaged, as its log says: it has no counter of them, and
/// nobody else gets to see them. Of the whole process since limit_dds_log(); thread-safe.
std::uint64_t malformed_samples();

/// Sends the log of Cyclone DDS to stderr, a few lines a minute at most: the loss of a link writes
/// more than a thousand. For the whole process; thread-safe, repeating it does nothing.
void limit_dds_log();

}  // namespace orbwatch::app
