// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app::cli::support {

/// Values that must not leave the appliance, and the places that could not be searched for them.
struct KnownSecrets {
  std::vector<std::string> values;
  std::vector<std::string> unread;  ///< reasons, each with its file
};

/// Secrets in a file or in the files below a folder: lines of private keys, texts that are named
/// password, hash, token and the like in JSON, the code for the first password. A missing place has
/// none. Reentrant; waits for the disk.
void find_secrets(const std::filesystem::path& place, KnownSecrets& secrets);

/// Values of secret variables in an environment, whose entries NAME=VALUE end with zeros.
/// Reentrant.
void find_secrets_of_environment(std::string_view environment, KnownSecrets& secrets);

}  // namespace orbwatch::app::cli::support
