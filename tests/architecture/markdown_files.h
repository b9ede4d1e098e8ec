// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace orbwatch::tests {

/// All Markdown files of the project, without those of builds.
std::vector<std::filesystem::path> markdown_files();

}  // namespace orbwatch::tests
