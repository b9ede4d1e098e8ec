// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/register_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/app/ports/modbus/map/registers.h"

namespace orbwatch::app::modbus {
namespace {

TEST(RegisterMap, RowsNeitherOverlapNorLeaveTheAddressSpace) {
  std::map<std::pair<Table, int>, std::string> owners;
  for (const Row& row : registers().rows()) {
    ASSERT_GE(row.count, 1) << row.name;
    ASSERT_GE(row.address, 0) << row.name;
    ASSERT_LE(row.address + row.count, 65536) << row.name;
    for (int address = row.address; address < row.address + row.count; ++address) {
      const auto [owner, is_new] = owners.emplace(std::pair(row.table, address), row.name);
      EXPECT_TRUE(is_new) << row.name << " and " << owner->second << " at " << address;
    }
  }
}

TEST(RegisterMap, FindsEveryRowAtItsPlacesAndNothingElse) {
  std::map<Table, int> mapped;
  for (const Row& row : registers().rows()) {
    for (int address = row.address; address < row.address + row.count; ++address) {
      EXPECT_EQ(registers().find(row.table, address), &row);
    }
    mapped[row.table] += row.count;
  }
  for (const auto& [table, count] : mapped) {
    int found = 0;
    for (int address = 0; address < 65536; ++address) {
      found += registers().find(table, address) ? 1 : 0;
    }
    EXPECT_EQ(found, count) << name_of(table);
  }
}

TEST(RegisterMap, RowsAreConsistentInThemselves) {
  std::set<std::pair<Table, std::string>> names;
  for (const Row& row : registers().rows()) {
    EXPECT_TRUE(names.emplace(row.table, row.name).second) << row.name;
    EXPECT_FALSE(row.description.empty()) << row.name;
    const bool is_bit = row.table == Table::Coil || row.table == Table::Discrete;
    EXPECT_EQ(row.type == Type::Bool, is_bit) << row.name;
    EXPECT_EQ(bool{row.write}, row.access == Access::ReadWrite) << row.name;
    if (!row.read) continue;  // reserved
    const bool is_double = row.type == Type::Udint || row.type == Type::Dint;
    EXPECT_EQ(row.count, is_double ? 2 : 1) << row.name;
    EXPECT_TRUE(!is_double || row.address % 2 == 0) << row.name;
    EXPECT_GT(row.quantity.scale, 0) << row.name;
    EXPECT_LT(row.quantity.minimum, row.quantity.maximum) << row.name;
  }
}

TEST(RegisterMap, EveryInputIsMirrored) {
  int mirrored = 0;
  for (const Row& row : registers().rows()) {
    if (row.table != Table::Input && row.table != Table::Discrete) continue;
    const Table table = row.table == Table::Input ? Table::Holding : Table::Coil;
    const Row* mirror = registers().find(table, row.address + 5000);
    ASSERT_NE(mirror, nullptr) << row.name;
    EXPECT_EQ(mirror->name, row.name);
    EXPECT_EQ(mirror->address, row.address + 5000);
    EXPECT_EQ(mirror->count, row.count);
    EXPECT_EQ(mirror->type, row.type);
    EXPECT_EQ(mirror->access, Access::Read);
    ++mirrored;
  }
  EXPECT_GT(mirrored, 100);
}

TEST(RegisterMap, HasARowForEverySignalCameraAndView) {
  std::set<std::string> names;
  for (const Row& row : registers().rows()) {
    if (row.table == Table::Input || row.table == Table::Discrete) names.insert(row.name);
  }
  for (const auto& signal : signals::kSignals) {
    for (std::size_t region = 0; region < signals::kMaxRegions; ++region) {
      const std::string name = std::to_string(region) + "_" + std::string(signal.name);
      EXPECT_TRUE(names.contains("region_" + name)) << name;
      EXPECT_TRUE(names.contains("result_" + name)) << name;
    }
  }
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    EXPECT_TRUE(names.contains("camera_" + std::to_string(camera) + "_fault"));
    EXPECT_TRUE(names.contains("camera_" + std::to_string(camera) + "_delivers"));
  }
  for (std::size_t view = 0; view < kMaxViews; ++view) {
    EXPECT_TRUE(names.contains("view_" + std::to_string(view) + "_latency_p99_ms"));
  }
  for (const HealthField& figure : kHealthFigures) {
    EXPECT_TRUE(names.contains("health_" + std::string(figure.name))) << figure.name;
  }
  for (std::size_t alarm = 1; alarm <= signals::kMaxAlarms; ++alarm) {
    EXPECT_TRUE(names.contains("alarm_" + std::to_string(alarm) + "_state"));
    EXPECT_TRUE(names.contains("alarm_" + std::to_string(alarm) + "_active"));
    EXPECT_TRUE(names.contains("alarm_" + std::to_string(alarm) + "_unacknowledged"));
  }
}

const Row& row_named(const std::string& name) {
  const auto found = std::ranges::find_if(
      registers().rows(), [&](const Row& row) { return row.name == name && !is_mirror(row); });
  if (found == registers().rows().end()) throw std::out_of_range(name);
  return *found;
}

/// PLC programs rely on these addresses: moving a row needs another map version.
TEST(RegisterMap, BlocksStandWhereTheyWereDecidedToStand) {
  EXPECT_EQ(row_named("map_version").address, 0);
  EXPECT_EQ(row_named("status_bits").address, 2);
  EXPECT_EQ(row_named("result_count").address, 20);
  EXPECT_EQ(row_named("system_state").address, 28);
  EXPECT_EQ(row_named("health_board_temperature").address, 80);
  EXPECT_EQ(row_named("plc_silent").address, 129);
  EXPECT_EQ(row_named("modbus_uptime").address, 144);
  EXPECT_EQ(row_named("camera_0_fault").address, 600);
  EXPECT_EQ(row_named("camera_3_fault").address, 780);
  EXPECT_EQ(row_named("view_0_published").address, 1100);
  EXPECT_EQ(row_named("view_15_published").address, 1460);
  EXPECT_EQ(row_named("alarms_active").address, 1500);
  EXPECT_EQ(row_named("alarm_1_state").address, 1520);
  EXPECT_EQ(row_named("alarm_32_state").address, 2016);
  EXPECT_EQ(row_named("region_0_result").address, 2600);
  EXPECT_EQ(row_named("region_3_result").address, 2984);
  EXPECT_EQ(row_named("result_0_result").address, 3700);
  EXPECT_EQ(row_named("result_3_result").address, 4084);
  EXPECT_EQ(row_named("argument_0").address, 0);
  EXPECT_EQ(row_named("command_sequence").address, 12);
}

TEST(RegisterMap, OneRequestReadsWhatEachScanNeeds) {
  EXPECT_LE(row_named("health_commands_recorded").address + 2, kMaxReadRegisters);
  for (const std::string window : {"region_0_", "result_0_"}) {
    const Row& last = row_named(window + std::string(signals::kSignals[kFirstSignals - 1].name));
    EXPECT_LE(last.address + last.count - row_named(window + "result").address, kMaxReadRegisters);
  }
}

TEST(RegisterMap, LiveRegionsAndResultsAreTheSameStructure) {
  constexpr int kLive = 2600;
  constexpr int kResult = 3700;
  for (int place = 0; place < 512; ++place) {
    const Row* live = registers().find(Table::Input, kLive + place);
    const Row* result = registers().find(Table::Input, kResult + place);
    ASSERT_TRUE(live && result) << place;
    EXPECT_EQ(live->address + kResult - kLive, result->address);
    const bool is_reserved = !live->read;
    EXPECT_EQ(is_reserved, !result->read) << place;
    if (is_reserved) continue;
    EXPECT_EQ(live->count, result->count);
    EXPECT_EQ(live->type, result->type);
    EXPECT_EQ("result" + live->name.substr(6), result->name);
    EXPECT_EQ(live->quantity.scale, result->quantity.scale);
  }
}

}  // namespace
}  // namespace orbwatch::app::modbus
