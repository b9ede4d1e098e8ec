// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// Read access to a file.
enum class Readable { Owner, Everybody };

/// Creates a file that does not exist yet and flushes it to the disk. A file for its owner only is
/// never readable by others, not even while it is written. Error: names file and reason.
Result<> write_key_file(const std::filesystem::path& file, std::string_view text,
                        Readable readable);

}  // namespace orbwatch::app::dds
