// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "proc/image/result.h"

/// Encryption by a passphrase: Argon2id with 64 MiB and a random salt, then XChaCha20-Poly1305, by
/// libsodium. All reentrant; they take a tenth of a second or more.
namespace orbwatch::app::cli::backup {

/// The encrypted bytes. `context` is not encrypted, but unseal() demands the same. Error: out of
/// memory.
Result<std::string> seal(std::string_view bytes, std::string_view passphrase,
                         std::string_view context);

/// The bytes. Errors: another passphrase or context, changed bytes; out of memory.
Result<std::string> unseal(std::string_view sealed, std::string_view passphrase,
                           std::string_view context);

}  // namespace orbwatch::app::cli::backup
