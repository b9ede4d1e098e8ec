#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// Passwords and tokens by libsodium. All reentrant.
namespace orbwatch::app::web {

inline constexpr std::size_t kLeastPasswordCharacters = 12;
inline constexpr std::size_t kMostPasswordBytes = 512;

/// Error: it is too short or too long, in words for the person who chose it.
Result<> check_password(std::string_view password);

/// Argon2id with a random salt, as text: takes 64 MiB and a tenth of a second or more. Error: there
/// is no memory for it.
Result<std::string> hash_password(std::string_view password);

/// Whether hash_password() made `hash` of it; takes as long, whatever `hash` is.
bool is_password(const std::string& hash, std::string_view password);

/// 256 random bits, of letters, digits, - and _.
std::string random_token();

/// 0 to `end` - 1, each as likely.
std::uint32_t random_below(std::uint32_t end);

/// Takes as long wherever they differ.
bool equal_secrets(std::string_view a, std::string_view b);

/// By which a token is kept. Reveals nothing of it, since all of its bits are random.
std::string token_hash(std::string_view token);

}  // namespace orbwatch::app::web
