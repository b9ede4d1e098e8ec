#pragma once

#include <cstdint>

namespace orbwatch::app {

/// Samples that Cyclone DDS dropped because they are not valid CDR of their type or too large,
/// counted by its log lines: it has no counter and does not deliver them. Of the whole process
/// since limit_dds_log(); thread-safe.
std::uint64_t malformed_samples();

/// Sends the log of Cyclone DDS to that of the process, a few lines a minute at most: the loss of a
/// link writes more than a thousand. For the whole process; thread-safe, repeating it does nothing.
void limit_dds_log();

}  // namespace orbwatch::app
