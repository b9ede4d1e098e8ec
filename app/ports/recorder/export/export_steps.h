// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Follows an export: called with the parts that are done, their number and their name, such as
/// "pictures". False cancels the export.
using ExportSteps = std::function<bool(std::size_t done, std::size_t of, const char* unit)>;

/// Error of an export that was cancelled.
inline tl::unexpected<Error> cancelled_export() { return fail("cancelled; no file is written"); }

}  // namespace orbwatch::app::recorder
