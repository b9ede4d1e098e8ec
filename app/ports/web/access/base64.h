// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace orbwatch::app::web {

/// Bytes of a text in Base64 with padding (RFC 4648, 4); nullopt: malformed. Reentrant.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace orbwatch::app::web
