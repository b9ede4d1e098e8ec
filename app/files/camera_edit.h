// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::files {

/// The text of a configuration file in which the camera `name` has another device: `key` of its
/// table `back_end` becomes `address`. Everything else is kept. Error: no such camera with such a
/// table of its own; as TomlEdit.
Result<std::string> with_camera_address(const std::string& text, const std::string& name,
                                        std::string_view back_end, std::string_view key,
                                        const std::string& address);

}  // namespace orbwatch::app::files
