// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Reads the whole of a regular file with at most `most` bytes. Never waits for another process, as
/// a pipe would. Error: file and reason. Reentrant.
Result<std::string> read_regular_file(const std::filesystem::path& file,
                                      std::size_t most = std::size_t{1} << 20);
/// Reads a file that is open with O_NONBLOCK; `file` names it in the error.
Result<std::string> read_regular_file(const FileDescriptor& opened,
                                      const std::filesystem::path& file,
                                      std::size_t most = std::size_t{1} << 20);

/// Opens a file for reading, unless it is a link, and without waiting for the other end of a pipe.
/// Not open: errno has the reason, ELOOP for a link. Reentrant.
FileDescriptor open_no_link(const std::filesystem::path& file);

/// Writes all of it. False: errno has the reason. Reentrant.
bool write_all(const FileDescriptor& file, std::string_view text);

}  // namespace orbwatch::hal
