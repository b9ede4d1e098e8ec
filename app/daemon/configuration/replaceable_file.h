// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// True for a file that is there and that only its owner may use, as a secret: a file of the
/// configuration is none. Reentrant.
bool is_private(const std::filesystem::path& file);

/// The text in place of a private one, for those who read a configuration.
inline constexpr const char* kPrivateText =
    "# not shown: only its owner may read it, as a secret; a file of the configuration has mode "
    "0640 "
    "or 0644\n";

/// True for a name with the ending of a file of the configuration: .toml, .yaml or .yml. Reentrant.
bool is_configuration_name(const std::filesystem::path& file);

/// Checks that a text which a client sends, or which comes from another folder, may take the place
/// of `file`, before the file is read: a difference or a refusal would tell its content. Allowed
/// are files that the present configuration `site` names (`named`) and that not only their owner
/// may read, and new ones that end with .toml, .yaml or .yml; none below a folder of `state`, where
/// users, logins and keys are kept. Error: why not, and what would be right. Reentrant.
Result<> check_replaceable(const std::filesystem::path& file, const std::filesystem::path& site,
                           const std::set<std::filesystem::path>& named,
                           const std::vector<std::filesystem::path>& state);

}  // namespace orbwatch::app::daemon
