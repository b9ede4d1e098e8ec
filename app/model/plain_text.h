#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// `text` as one line of UTF-8 (RFC 3629) that is safe to show: a question mark stands for each
/// byte that is no part of it, and for each character that controls a terminal or the direction of
/// writing. Cut between characters to `most` bytes. Reentrant.
std::string plain_text(std::string_view text, std::size_t most);

}  // namespace orbwatch::app
