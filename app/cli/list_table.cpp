#include <charconv>
#include <concepts>
#include <string_view>

#include "app/cli/list.h"
#include "app/cli/list_fields.h"
#include "app/cli/text_table.h"
#include "app/config/finding.h"

namespace orbwatch::app {
namespace {

std::string cell(const std::string& text) { return one_line(text); }
std::string cell(std::integral auto number) { return std::to_string(number); }
std::string cell(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

template <class T>
std::string cell(const std::vector<T>& values) {
  std::string list;
  for (const T& value : values) list += (list.empty() ? "" : ", ") + cell(value);
  return list;
}

/// The fields of one entry, by name and as text; its lists are left to EntryText.
struct Fields {
  TableRow names, cells;

  template <class T>
  void field(const char* name, const T& value) {
    names.push_back(title(name));
    cells.push_back(cell(value));
  }
  template <class Entry>
  void list(const char*, const std::vector<Entry>&) {}
};

/// Writes one entry: a line for each field that says something, a table for each list.
class EntryText {
 public:
  template <class T>
  void field(const char* name, const T& value) {
    if (std::string text = cell(value); !text.empty()) rows_.push_back({title(name), text});
  }

  template <class Entry>
  void list(const char*, const std::vector<Entry>& entries) {
    std::vector<TableRow> rows;
    for (const Entry& entry : entries) {
      Fields fields;
      visit(fields, entry);
      if (rows.empty()) rows.push_back(fields.names);
      rows.push_back(fields.cells);
    }
    if (!rows.empty()) tables_ += "\n" + aligned(rows, 1, "  ");
  }

  std::string text() const { return (rows_.empty() ? "" : aligned(rows_, 0, "")) + tables_; }

 private:
  std::vector<TableRow> rows_;
  std::string tables_;
};

/// Writes all entries of all kinds.
class InventoryText {
 public:
  template <class Entry>
  void list(const char* name, const std::vector<Entry>& entries) {
    for (const Entry& entry : entries) {
      EntryText text;
      visit(text, entry);
      text_ += text.text() + "\n";
    }
    if (entries.empty()) text_ += "no " + title(name) + "\n";
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

std::string list_table(const hal::Inventory& inventory) {
  InventoryText text;
  visit(text, inventory);
  return text.text();
}

}  // namespace orbwatch::app
