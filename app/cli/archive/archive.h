// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// A regular file in an archive.
struct ArchivedFile {
  std::string name;  ///< relative path, see check_archived_name()
  std::string bytes;
  mode_t mode = 0600;

  bool operator==(const ArchivedFile&) const = default;
};

/// The files of an archive, in order.
using Archive = std::vector<ArchivedFile>;

/// Error: not a relative path of at most 255 bytes without empty parts, "." and "..", or with a
/// control character. Reentrant.
Result<> check_archived_name(std::string_view name);

}  // namespace orbwatch::app::cli
