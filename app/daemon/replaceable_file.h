#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Checks that a text which a client sends may take the place of `file`, before the file is read:
/// a difference or a refusal would tell its content. Allowed are files that the present
/// configuration `site` names (`named`) and that not only their owner may read, and new ones that
/// end with .toml, .yaml or .yml; none below a folder of `state`, where users, logins and keys are
/// kept. Error: why not, and what would be right. Reentrant.
Result<> check_replaceable(const std::filesystem::path& file, const std::filesystem::path& site,
                           const std::set<std::filesystem::path>& named,
                           const std::vector<std::filesystem::path>& state);

}  // namespace orbwatch::app
