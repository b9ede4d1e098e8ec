#pragma once

#include <string>

namespace orbwatch::app {

/// The lines that differ between two texts, with "-" and "+" in front, below a line with `name`;
/// empty if none does. Lines that both have, in a longest common sequence, are left out.
std::string text_difference(const std::string& before, const std::string& after,
                            const std::string& name);

}  // namespace orbwatch::app
