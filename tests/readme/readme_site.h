// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace orbwatch::tests {

/// Writes into `folder` the files that the READMEs' commands read, under the names used there: a
/// photographed ball, cameras that see printed tags, a simulated machine.
void write_readme_files(const std::filesystem::path& folder);

}  // namespace orbwatch::tests
