// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cli/drift/drift_run.h"
#include "proc/optics/outline.h"

namespace orbwatch::app::cli {

/// For people: whether the alignment still holds, what moved by how much, and what would be right.
/// `stored`: the outline of the alignment.
std::string drift_text(const DriftRun& run, const optics::Outline& stored);

/// One JSON object (RFC 8259), as documented in `orbwatch drift --help`.
std::string drift_json(const DriftRun& run, const optics::Outline& stored);

}  // namespace orbwatch::app::cli
