// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/files/resolve.h"

namespace orbwatch::app::daemon {

/// Removes temporary files that a power cut or SIGKILL left in the folders that orbwatchd writes:
/// its state folders and those of the configuration's files. Failures are logged. Not while the
/// environment is changed.
void remove_leftovers(const files::Resolved& site);

/// Records the outputs that are about to be opened; see driven_lines(). A failure is logged. Not
/// while the environment is changed.
void record_outputs(const files::Resolved& site);

}  // namespace orbwatch::app::daemon
