#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Who may read a file besides its owner.
enum class Readable { Owner, Everybody };

/// The whole file. Error: names file and reason; larger than 1 MiB, which none of these is.
Result<std::string> read_key_file(const std::filesystem::path& file);

/// Makes a file that must not be there yet and brings it to the disk; nobody else ever sees what is
/// for the owner only. Error: names file and reason.
Result<> write_key_file(const std::filesystem::path& file, std::string_view text,
                        Readable readable);

}  // namespace orbwatch::app
