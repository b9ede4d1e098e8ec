// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hal/mcap/file_result.h"

namespace orbwatch::hal::mcap {

/// Checks a topic or another name: 1 to kMostName bytes without control characters. `what` begins
/// the error.
FileResult<> check_name(const std::string& what, std::string_view name);

/// Checks the name of an attachment: also a relative path without "." and "..", so that it can be
/// unpacked below any folder.
FileResult<> check_attachment_name(const std::string& what, std::string_view name);

}  // namespace orbwatch::hal::mcap
