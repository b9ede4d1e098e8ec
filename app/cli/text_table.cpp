#include "app/cli/text_table.h"

#include <algorithm>

namespace orbwatch::app {

std::string title(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string aligned(const std::vector<TableRow>& rows, std::size_t first_content,
                    const std::string& indent) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (std::size_t column = 0; column < widths.size(); ++column) {
    const bool used =
        std::any_of(rows.begin() + static_cast<std::ptrdiff_t>(first_content), rows.end(),
                    [&](const TableRow& r) { return !r[column].empty(); });
    for (const TableRow& row : rows) {
      if (used) widths[column] = std::max(widths[column], row[column].size());
    }
  }
  std::string text;
  for (const TableRow& row : rows) {
    std::string line = indent;
    for (std::size_t column = 0; column < widths.size(); ++column) {
      if (widths[column] == 0) continue;
      line += row[column] + std::string(widths[column] + 2 - row[column].size(), ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace orbwatch::app
