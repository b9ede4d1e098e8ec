// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// `text` as one line of UTF-8 (RFC 3629) that is safe to show: a question mark replaces each byte
/// that is not valid UTF-8, and each character that controls a terminal or the writing direction.
/// Cut between characters to `most` bytes. Reentrant.
std::string plain_text(std::string_view text, std::size_t most);

}  // namespace orbwatch::app
