#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// The whole of a regular file with at most `most` bytes. Never waits for another process, as a
/// pipe would. Error: file and reason. Reentrant.
Result<std::string> read_regular_file(const std::filesystem::path& file,
                                      std::size_t most = std::size_t{1} << 20);

}  // namespace orbwatch::hal
