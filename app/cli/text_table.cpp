// SPDX-License-Identifier: Apache-2.0
#include "app/cli/text_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>

#include "app/files/toml/finding.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kIndent = "  ";

using Row = std::vector<std::string>;

std::string title(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return files::one_line(name);
}

bool is_content(const std::string& cell) { return !cell.empty() && cell != kNoValue; }

/// Pads columns to the widest cell. Every row has as many cells as the first.
std::string aligned(const std::vector<Row>& rows, const std::string& indent) {
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line = indent;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i] + std::string(widths[i] + 2 - row[i].size(), ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// One row per field: its name, then its cell of each record. The first row is kept, the others if
/// they have content.
std::vector<Row> rows_of(const std::vector<Fields>& records) {
  std::vector<std::string> names;
  for (const Fields& record : records) {
    for (const auto& [name, cell] : record) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  std::vector<Row> rows;
  for (const std::string& name : names) {
    Row row{title(name)};
    bool has_content = rows.empty();
    for (const Fields& record : records) {
      const auto found = std::ranges::find(record, name, &Fields::value_type::first);
      row.push_back(found == record.end() ? kNoValue : files::one_line(found->second));
      has_content = has_content || is_content(row.back());
    }
    if (has_content) rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> transposed(const std::vector<Row>& rows) {
  std::vector<Row> result(rows.empty() ? 0 : rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) result[i].push_back(row[i]);
  }
  return result;
}

}  // namespace

std::string fixed_text(double value, int digits) {
  if (!std::isfinite(value)) return kNoValue;
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string field_lines(const Fields& fields) {
  std::vector<Row> rows;
  for (const auto& [name, cell] : fields) {
    if (!cell.empty()) rows.push_back({title(name), files::one_line(cell)});
  }
  return aligned(rows, "");
}

std::string record_lines(const std::vector<Fields>& records) {
  return aligned(transposed(rows_of(records)), kIndent);
}

std::string record_columns(const std::vector<Fields>& records) {
  return aligned(rows_of(records), kIndent);
}

}  // namespace orbwatch::app::cli
