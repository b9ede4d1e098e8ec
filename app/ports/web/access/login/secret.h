// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// Passwords and tokens by libsodium. All reentrant.
namespace orbwatch::app::web {

inline constexpr std::size_t kLeastPasswordCharacters = 12;
inline constexpr std::size_t kMostPasswordBytes = 512;

/// Checks the length. Error: too short or too long, with a text for the user.
Result<> check_password(std::string_view password);

/// Argon2id with a random salt, as text: takes 64 MiB and a tenth of a second or more. Error: out
/// of memory.
Result<std::string> hash_password(std::string_view password);

/// Result of a comparison of a password. OutOfMemory: it could not be compared.
enum class PasswordMatch { Right, Wrong, OutOfMemory };

/// Compares `password` with a hash_password(), which takes as much time and memory. An empty
/// `hash`, that of an unknown user, takes the same time and matches none.
PasswordMatch match_password(const std::string& hash, std::string_view password);

/// 256 random bits as letters, digits, - and _.
std::string random_token();

/// Uniform random number from 0 to `end` - 1.
std::uint32_t random_below(std::uint32_t end);

/// Compares in constant time.
bool equal_secrets(std::string_view a, std::string_view b);

/// Hash under which a token is stored. It does not reveal the token, because all bits of the token
/// are random.
std::string token_hash(std::string_view token);

}  // namespace orbwatch::app::web
