// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace orbwatch::app::daemon {

/// Puts the files of a restore or factory reset in place that was asked for before this start, and
/// logs it. Does nothing without one. Before the state folder is reserved; waits for the disk and
/// for another program. Not while the environment is changed.
void complete_restore(const std::filesystem::path& config);

}  // namespace orbwatch::app::daemon
