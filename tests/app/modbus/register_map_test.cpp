#include "app/modbus/register_map.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace orbwatch::app::modbus {
namespace {

const RegisterMap& registers() {
  static const RegisterMap map;
  return map;
}

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
    EXPECT_EQ(row.write != nullptr, row.access == Access::ReadWrite) << row.name;
    if (!row.read) continue;  // reserved
    const bool is_double = row.type == Type::U32 || row.type == Type::I32;
    EXPECT_EQ(row.count, is_double ? 2 : 1) << row.name;
    EXPECT_GT(row.scale, 0) << row.name;
    EXPECT_LT(row.minimum, row.maximum) << row.name;
  }
}

TEST(RegisterMap, EveryInputIsMirrored) {
  int mirrored = 0;
  for (const Row& row : registers().rows()) {
    if (row.table != Table::Input && row.table != Table::Discrete) continue;
    const Table table = row.table == Table::Input ? Table::Holding : Table::Coil;
    const Row* mirror = registers().find(table, row.address + 1000);
    ASSERT_NE(mirror, nullptr) << row.name;
    EXPECT_EQ(mirror->name, row.name);
    EXPECT_EQ(mirror->address, row.address + 1000);
    EXPECT_EQ(mirror->count, row.count);
    EXPECT_EQ(mirror->type, row.type);
    EXPECT_EQ(mirror->read, row.read);
    EXPECT_EQ(mirror->index, row.index);
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
    EXPECT_TRUE(names.contains(std::string(signal.name))) << signal.name;
    EXPECT_TRUE(names.contains(std::string(signal.name) + "_quality")) << signal.name;
  }
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    EXPECT_TRUE(names.contains("camera_" + std::to_string(camera) + "_fault"));
    EXPECT_TRUE(names.contains("camera_" + std::to_string(camera) + "_delivers"));
  }
  for (std::size_t view = 0; view < kMaxViews; ++view) {
    EXPECT_TRUE(names.contains("view_" + std::to_string(view) + "_latency_p99"));
  }
}

}  // namespace
}  // namespace orbwatch::app::modbus
