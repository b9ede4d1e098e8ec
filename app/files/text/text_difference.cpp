// SPDX-License-Identifier: Apache-2.0
#include "app/files/text/text_difference.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <vector>

namespace orbwatch::app::files {
namespace {

/// Limit for the pairs of lines that are compared; the difference of longer texts would not be
/// readable.
constexpr std::size_t kMostPairs = 4'000'000;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::string text_difference(const std::string& before, const std::string& after,
                            const std::string& name) {
  const auto old_lines = lines_of(before), new_lines = lines_of(after);
  if (before == after) return {};
  const std::size_t rows = old_lines.size(), columns = new_lines.size();
  if (rows * columns > kMostPairs) {
    return name + "\n" + std::to_string(rows) + " lines become " + std::to_string(columns) + "\n";
  }
  // Lengths of the longest common sequence of the remainders from (i, j) on.
  std::vector<std::size_t> common((rows + 1) * (columns + 1), 0);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
    return common[i * (columns + 1) + j];
  };
  for (std::size_t i = rows; i-- > 0;) {
    for (std::size_t j = columns; j-- > 0;) {
      at(i, j) = old_lines[i] == new_lines[j] ? at(i + 1, j + 1) + 1
                                              : std::max(at(i + 1, j), at(i, j + 1));
    }
  }
  std::string text;
  for (std::size_t i = 0, j = 0; i < rows || j < columns;) {
    if (i < rows && j < columns && old_lines[i] == new_lines[j]) {
      ++i;
      ++j;
    } else if (j == columns || (i < rows && at(i + 1, j) >= at(i, j + 1))) {
      text += "-" + old_lines[i++] + "\n";
    } else {
      text += "+" + new_lines[j++] + "\n";
    }
  }
  if (text.empty()) text = "another end of the last line\n";
  return name + "\n" + text;
}

}  // namespace orbwatch::app::files
