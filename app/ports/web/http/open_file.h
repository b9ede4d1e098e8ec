// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// A regular file that is open for reading. It may be deleted meanwhile.
struct OpenFile {
  hal::FileDescriptor file;
  std::uint64_t size = 0;  ///< bytes when it was opened
};

/// Error: file and reason; also for what is not a regular file, such as a pipe. Reentrant.
Result<std::shared_ptr<const OpenFile>> open_file(const std::filesystem::path& path);

}  // namespace orbwatch::app::web
