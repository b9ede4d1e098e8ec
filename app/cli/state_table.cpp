#include <algorithm>
#include <array>
#include <concepts>
#include <cstdio>
#include <optional>

#include "app/cli/state_fields.h"
#include "app/cli/state_text.h"
#include "app/cli/text_table.h"
#include "app/config/finding.h"

namespace orbwatch::app {
namespace {

constexpr const char* kNothing = "-";
constexpr const char* kIndent = "  ";

std::string cell(std::string_view text) { return one_line(std::string(text)); }
std::string cell(bool truth) { return truth ? "yes" : "no"; }
std::string cell(std::integral auto number) { return std::to_string(number); }
std::string cell(double number) {
  if (!signals::is_valid(number)) return kNothing;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

template <class T>
std::string cell(const std::optional<T>& value) {
  return value ? cell(*value) : kNothing;
}

/// The fields of one object or entry as cells; objects in it are kept for a table of their own.
struct Fields {
  TableRow names, cells;
  std::string inner_name;
  std::vector<Fields> inner;

  template <class T>
  void field(std::string_view name, const T& value) {
    names.push_back(title(std::string(name)));
    cells.push_back(cell(value));
  }
  void field(std::string_view name, double value, std::string_view unit) {
    field(name, value);
    if (!unit.empty() && signals::is_valid(value)) cells.back() += " " + std::string(unit);
  }
  void code(std::string_view name, int, std::string_view text) { field(name, text); }

  template <class Fill>
  void object(std::string_view name, const Fill& fill) {
    inner_name = name;
    fill(inner.emplace_back());
  }
};

/// A line per field, a column per object, headed by `heads`; without the lines that say nothing.
std::string columns(const TableRow& heads, const std::vector<Fields>& objects) {
  std::vector<TableRow> rows{heads};
  for (std::size_t i = 0; i < objects.front().names.size(); ++i) {
    TableRow row{objects.front().names[i]};
    for (const Fields& object : objects) row.push_back(object.cells[i]);
    if (std::any_of(row.begin() + 1, row.end(), [](const auto& c) { return c != kNothing; })) {
      rows.push_back(row);
    }
  }
  return aligned(rows, 0, kIndent);
}

/// A line per entry, then a table for the objects in them, whose columns are headed by the entries'
/// first fields.
std::string lines(const std::vector<Fields>& entries) {
  std::vector<TableRow> rows{entries.front().names};
  TableRow heads{entries.front().inner_name};
  std::vector<Fields> inner;
  for (const Fields& entry : entries) {
    rows.push_back(entry.cells);
    heads.push_back(entry.cells.front());
    inner.insert(inner.end(), entry.inner.begin(), entry.inner.end());
  }
  const std::string table = aligned(rows, 1, kIndent);
  return inner.empty() ? table : table + "\n" + columns(heads, inner);
}

/// Writes the state: its own fields, then a table for each object and list.
class StateText {
 public:
  template <class T>
  void field(std::string_view name, const T& value) {
    fields_.field(name, value);
  }
  void code(std::string_view name, int number, std::string_view text) {
    fields_.code(name, number, text);
  }

  template <class Fill>
  void object(std::string_view name, const Fill& fill) {
    std::vector<Fields> object(1);
    fill(object.front());
    tables_ += "\n" + columns({std::string(name), ""}, object);
  }

  template <class Fill>
  void list(std::string_view, std::size_t count, const Fill& fill) {
    std::vector<Fields> entries(count);
    for (std::size_t i = 0; i < count; ++i) fill(entries[i], i);
    if (count > 0) tables_ += "\n" + lines(entries);
  }

  std::string text() const {
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < fields_.names.size(); ++i) {
      rows.push_back({fields_.names[i], fields_.cells[i]});
    }
    return aligned(rows, 0, "") + tables_;
  }

 private:
  Fields fields_;
  std::string tables_;
};

}  // namespace

std::string state_table(const ReceivedState& state) {
  StateText text;
  visit(text, state);
  return text.text();
}

}  // namespace orbwatch::app
