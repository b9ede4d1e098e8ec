#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orbwatch::app {

using TableRow = std::vector<std::string>;

/// Columns padded to the widest cell, a line per row; columns in which all rows from
/// `first_content` on are empty are left out. Every row has as many cells as the first. Reentrant.
std::string aligned(const std::vector<TableRow>& rows, std::size_t first_content,
                    const std::string& indent);

/// A field's name for people: without underscores. Reentrant.
std::string title(std::string name);

}  // namespace orbwatch::app
