#include "app/modbus/register_manual.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/commands.h"
#include "app/modbus/register_map.h"
#include "hal/fault.h"

namespace orbwatch::app {
namespace {

std::string committed(const std::string& name) {
  const std::ifstream file(std::string(ORBWATCH_SOURCE_DIR) + "/app/modbus/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The fields of one line as RFC 4180 has them.
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

TEST(RegisterManual, TheCommittedTableIsTheMap) {
  EXPECT_TRUE(committed("registers.csv") == registers_csv())
      << "stale: orbwatch describe registers --format csv > app/modbus/registers.csv";
}

TEST(RegisterManual, TheCommittedManualIsTheMap) {
  EXPECT_TRUE(committed("registers.md") == registers_markdown())
      << "stale: orbwatch describe registers --format markdown > app/modbus/registers.md";
}

TEST(RegisterManual, TheTableHoldsEveryRowInItsColumns) {
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
    EXPECT_EQ(std::stod(cells[6]), row.scale);
    EXPECT_EQ(cells[7], row.unit);
    EXPECT_EQ(std::stod(cells[8]), row.minimum);
    EXPECT_EQ(std::stod(cells[9]), row.maximum);
    EXPECT_EQ(cells[10], row.description);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(RegisterManual, TheManualExplainsEveryCode) {
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
  EXPECT_EQ(manual.find('@'), manual.npos) << "a fact of the introduction was not filled in";
}

}  // namespace
}  // namespace orbwatch::app
