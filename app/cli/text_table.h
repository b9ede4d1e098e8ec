// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

/// Aligned text for people. Underscores in names become spaces, control characters question marks.
/// Rows and columns with only empty cells and kNoValue are omitted. All reentrant.
namespace orbwatch::app::cli {

inline constexpr const char* kNoValue = "-";

/// A number with `digits` digits after the point; kNoValue for values that are not finite.
std::string fixed_text(double value, int digits);

/// Fields of one object: names and cells.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// One line per field that is not empty, with name and cell.
std::string field_lines(const Fields& fields);

/// Indented table with a line per record, and a column per field under its name. Records may differ
/// in their fields.
std::string record_lines(const std::vector<Fields>& records);

/// Indented table with a line per field, and a column per record under its first field.
std::string record_columns(const std::vector<Fields>& records);

}  // namespace orbwatch::app::cli
