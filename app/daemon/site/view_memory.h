// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "app/files/resolve.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Bytes that are resident at least when every display view is published and the recipe with the
/// largest views is measured: one buffer of each. Interfaces that keep views add to it. Reentrant.
std::uint64_t view_memory(const files::Resolved& site);

/// Memory of this computer, bytes; 0: unknown. Reentrant.
std::uint64_t computer_memory();

/// Checks that the views of a site fit into `memory` bytes; 0: unknown, which is not checked.
/// Error: what they need, and what would be right. Reentrant.
Result<> check_view_memory(const files::Resolved& site, std::uint64_t memory = computer_memory());

}  // namespace orbwatch::app::daemon
