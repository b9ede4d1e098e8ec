// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace orbwatch::app::files {

/// The lines that differ between two texts, prefixed by "-" and "+", after a line with `name`;
/// empty if none does. Lines of a longest common sequence are omitted.
std::string text_difference(const std::string& before, const std::string& after,
                            const std::string& name);

}  // namespace orbwatch::app::files
