// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Writes the messages of a range as a new recording `output`: bytes, stamps and sequence numbers
/// as they are, and all attachments and metadata. Channels and schemas keep their order; those
/// without a message are left out. Errors: those of hal::mcap::Reader and Writer; cancelled.
Result<> copy_range(const std::filesystem::path& recording, const StampRange& range,
                    const std::filesystem::path& output, const ExportSteps& steps);

}  // namespace orbwatch::app::recorder
