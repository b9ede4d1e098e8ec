#pragma once

#include <string>
#include <utility>
#include <vector>

/// Aligned text for people. Underscores in names become spaces, control characters question marks.
/// Whatever holds nothing but empty cells and kNoValue is left out. All reentrant.
namespace orbwatch::app {

inline constexpr const char* kNoValue = "-";

/// With so many digits after the point; kNoValue for what is not finite.
std::string fixed_text(double value, int digits);

/// The fields of one thing: names and cells.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A line per field, name and cell; all that are not empty.
std::string field_lines(const Fields& fields);

/// An indented table with a line per record, and a column per field under its name. Records may
/// differ in their fields.
std::string record_lines(const std::vector<Fields>& records);

/// An indented table with a line per field, and a column per record under its first field.
std::string record_columns(const std::vector<Fields>& records);

}  // namespace orbwatch::app
