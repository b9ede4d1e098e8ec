// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "app/ports/modbus/modbus_sink.h"
#include "tests/app/ports/modbus/clients.h"

/// Tests that the page shows the values that a PLC reads.
namespace orbwatch::app {
namespace {

using tests::accept_all;
using tests::address_of;
using tests::eventually;
using tests::loopback;
using tests::Plc;

const InterfaceTable& named(const std::vector<InterfaceTable>& tables, const std::string& name) {
  const auto found = std::ranges::find(tables, name, &InterfaceTable::name);
  if (found == tables.end()) throw std::out_of_range(name);
  return *found;
}

/// Maps the column `key` to the column `value`.
template <class Value>
std::map<std::string, Value> column(const InterfaceTable& table, const std::string& key,
                                    const std::string& value) {
  const auto place = [&table](const std::string& column) {
    return static_cast<std::size_t>(std::ranges::find(table.columns, column) -
                                    table.columns.begin());
  };
  std::map<std::string, Value> all;
  for (const auto& row : table.rows) {
    EXPECT_EQ(row.size(), table.columns.size());
    all[std::get<std::string>(row[place(key)])] = std::get<Value>(row[place(value)]);
  }
  return all;
}

/// Adds an alarm on the width of a hot spot, in thousandths of a millimetre over Modbus.
void add_alarm(Status& status, double width) {
  const auto signal = std::ranges::find(signals::kSignals, std::string_view("hot_spot_width"),
                                        &signals::SignalInfo::name);
  AlarmStatus& alarm = status.alarms[status.alarm_count++];
  alarm.signal = static_cast<SignalNumber>(signal - signals::kSignals.begin());
  alarm.value = width;
}

TEST(ShownTables, HaveTheValuesInTheirUnits) {
  ModbusSink sink(loopback(), accept_all);
  EXPECT_TRUE(sink.tables().empty()) << "it does not serve";
  ASSERT_TRUE(sink.start());
  Status status = tests::example_status();
  add_alarm(status, 3.2);
  add_alarm(status, signals::kNotValid);
  sink.accept(status);
  const auto tables = sink.tables();
  const auto values = column<double>(named(tables, "registers"), "name", "value");
  const auto units = column<std::string>(named(tables, "registers"), "name", "unit");
  EXPECT_EQ(values.at("system_configuration_checksum"), 0x89abcdefU);
  EXPECT_NEAR(values.at("region_0_hot_spot_yaw"), -123.46, 1e-9);
  EXPECT_NEAR(values.at("region_0_hot_spot_peak_temperature"), -20.0, 1e-9);
  EXPECT_TRUE(std::isnan(values.at("region_0_hot_spot_mean_temperature")));
  EXPECT_NEAR(values.at("alarm_1_value"), 3.2, 1e-9);
  EXPECT_EQ(units.at("alarm_1_value"), "mm") << "the unit of its signal";
  EXPECT_TRUE(std::isnan(values.at("alarm_2_value")));
  const modbus::RegisterMap map;
  std::size_t mapped = 0;
  for (const modbus::Row& row : map.rows()) mapped += row.read && !is_mirror(row) ? 1 : 0;
  EXPECT_EQ(named(tables, "registers").rows.size(), mapped);
  sink.stop();
  EXPECT_TRUE(sink.tables().empty());
}

TEST(ShownTables, HaveTheClientsThatAreConnected) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  const auto requests = [&sink] {
    const auto tables = sink.tables();
    return column<double>(named(tables, "clients"), "address", "requests");
  };
  const auto metric = [&sink](std::string_view name) {
    const auto metrics = sink.metrics();
    const auto found = std::ranges::find_if(metrics, [name](const InterfaceMetric& one) {
      return one.component.kind == "modbus" && one.field.name == name;
    });
    return found == metrics.end() ? -1 : found->value;
  };
  EXPECT_TRUE(requests().empty());
  {
    Plc plc(sink.port());
    for (int n = 0; n < 3; ++n) ASSERT_EQ(plc.read_input(address_of("system_recipe"), 1), 0);
    EXPECT_TRUE(eventually([&] {
      return requests() == std::map<std::string, double>{{"127.0.0.1", 3}};
    }));
    const auto tables = sink.tables();
    EXPECT_TRUE(std::get<bool>(named(tables, "clients").rows[0][1])) << "this host may write";
    EXPECT_EQ(metric("answered"), 3);
    EXPECT_EQ(metric("connections"), 1);
  }
  EXPECT_TRUE(eventually([&] { return requests().empty(); }));
}

}  // namespace
}  // namespace orbwatch::app
