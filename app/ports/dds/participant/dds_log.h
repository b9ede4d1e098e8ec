// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::app::dds {

/// Samples that Cyclone DDS dropped because they are not valid CDR of their type or too large,
/// counted by its log lines, because it has no counter and does not deliver them. The count covers
/// the whole process since limit_dds_log(); thread-safe.
std::uint64_t malformed_samples();

/// Forwards the log of Cyclone DDS to that of the process, limited to a few lines per minute,
/// because the loss of a link writes more than a thousand. Applies to the whole process;
/// thread-safe, repeating it does nothing.
void limit_dds_log();

}  // namespace orbwatch::app::dds
