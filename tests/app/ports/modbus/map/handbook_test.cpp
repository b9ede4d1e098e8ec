// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/handbook.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "app/model/command/command.h"
#include "app/ports/modbus/map/register_map.h"
#include "hal/fault.h"

namespace orbwatch::app {
namespace {

std::string committed(const std::string& name) {
  const std::ifstream file(std::string(ORBWATCH_SOURCE_DIR) + "/app/ports/modbus/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Parses the fields of one line by RFC 4180.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> list(1);
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '"') {
      quoted = !quoted;
    } else if (letter == ',' && !quoted) {
      list.emplace_back();
    } else {
      list.back() += letter;
    }
  }
  EXPECT_FALSE(quoted) << line;
  return list;
}

/// Reserved places of the committed map may get rows; everything else is promised to PLC programs.
TEST(Handbook, NoCommittedRowMovesWithinAMapVersion) {
  std::istringstream lines(committed("registers.csv"));
  std::string line;
  std::getline(lines, line);
  const modbus::RegisterMap map;
  std::map<std::pair<std::string, std::string>, const modbus::Row*> rows;
  for (const modbus::Row& row : map.rows()) {
    rows[{std::string(name_of(row.table)), row.name}] = &row;
  }
  int promised = 0;
  while (std::getline(lines, line)) {
    const auto cells = fields(line);
    if (cells[5].starts_with("reserved_")) continue;
    const modbus::Row* row = rows[{cells[0], cells[5]}];
    ASSERT_NE(row, nullptr) << cells[5] << " has gone: that needs another map version";
    EXPECT_EQ(std::stoi(cells[1]), row->address) << cells[5] << " moved: append fields, or raise "
                                                 << "the map version";
    EXPECT_EQ(cells[3], name_of(row->type)) << cells[5];
    EXPECT_EQ(cells[4], name_of(row->access)) << cells[5];
    EXPECT_EQ(std::stod(cells[6]), row->quantity.scale) << cells[5];
    EXPECT_EQ(cells[7], row->quantity.unit) << cells[5];
    ++promised;
  }
  EXPECT_GT(promised, 1000);
}

TEST(Handbook, TheCommittedTableIsTheMap) {
  EXPECT_TRUE(committed("registers.csv") == registers_csv())
      << "stale: orbwatch describe registers --format csv > app/ports/modbus/registers.csv";
}

TEST(Handbook, TheCommittedManualIsTheMap) {
  EXPECT_TRUE(committed("registers.md") == registers_markdown())
      << "stale: orbwatch describe registers --format markdown > app/ports/modbus/registers.md";
}

TEST(Handbook, TheTableHoldsEveryRowInItsColumns) {
  std::istringstream lines(registers_csv());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "table,address,count,type,access,name,scale,unit,min,max,description");
  const modbus::RegisterMap map;
  for (const modbus::Row& row : map.rows()) {
    ASSERT_TRUE(std::getline(lines, line));
    const auto cells = fields(line);
    ASSERT_EQ(cells.size(), 11U) << line;
    EXPECT_EQ(cells[0], name_of(row.table));
    EXPECT_EQ(std::stoi(cells[1]), row.address);
    EXPECT_EQ(std::stoi(cells[2]), row.count);
    EXPECT_EQ(cells[3], name_of(row.type));
    EXPECT_EQ(cells[4], name_of(row.access));
    EXPECT_EQ(cells[5], row.name);
    EXPECT_EQ(std::stod(cells[6]), row.quantity.scale);
    EXPECT_EQ(cells[7], row.quantity.unit);
    EXPECT_EQ(std::stod(cells[8]), row.quantity.minimum);
    EXPECT_EQ(std::stod(cells[9]), row.quantity.maximum);
    EXPECT_EQ(cells[10], row.description);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(Handbook, TheManualExplainsEveryCode) {
  const std::string manual = registers_markdown();
  for (int fault = 0; fault <= static_cast<int>(hal::Fault::WrongFormat); ++fault) {
    const auto text = hal::operator_text(static_cast<hal::Fault>(fault));
    const std::string line = "| " + std::to_string(fault) + " | " + std::string(text) + " |";
    EXPECT_NE(manual.find(line), manual.npos) << line;
  }
  for (const CommandInfo& command : kCommands) {
    EXPECT_NE(manual.find(" | " + std::string(command.name) + " | "), manual.npos);
  }
  EXPECT_NE(manual.find("| 3 | fault: "), manual.npos);
  EXPECT_NE(manual.find("| 2 | argument out of range |"), manual.npos);
  EXPECT_EQ(manual.find('@'), manual.npos) << "a placeholder was not filled in";
}

}  // namespace
}  // namespace orbwatch::app
