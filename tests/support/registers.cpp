// SPDX-License-Identifier: Apache-2.0
#include "tests/support/registers.h"

#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

namespace orbwatch::tests {
namespace {

struct Row {
  std::string table, type;
  int address = 0;
  int count = 0;
};

/// The first row called `name`: table,address,count,type,access,name,...
Row find_row(const std::string& name) {
  std::ifstream map(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/ports/modbus/registers.csv");
  for (std::string line; std::getline(map, line);) {
    std::istringstream fields(line);
    std::array<std::string, 6> field;
    for (auto& f : field) std::getline(fields, f, ',');
    if (field[5] == name && (field[0] == "input" || field[0] == "holding")) {
      return {field[0], field[3], std::stoi(field[1]), std::stoi(field[2])};
    }
  }
  ADD_FAILURE() << "no register " << name;
  return {};
}

struct Close {
  void operator()(modbus_t* context) const {
    modbus_close(context);
    modbus_free(context);
  }
};
using Connection = std::unique_ptr<modbus_t, Close>;

Connection connect_to(int port, const std::string& host = "127.0.0.1") {
  Connection context(modbus_new_tcp(host.c_str(), port));
  modbus_set_slave(context.get(), 1);
  // libmodbus waits for half a second, which a sanitized daemon on a busy machine takes at times.
  constexpr std::uint32_t kPatience = 10;
  modbus_set_response_timeout(context.get(), kPatience, 0);
  if (modbus_connect(context.get()) != 0) return nullptr;
  return context;
}

}  // namespace

std::int64_t read_register(int port, const std::string& name, const std::string& host) {
  constexpr auto kNothing = std::numeric_limits<std::int64_t>::min();
  const Row row = find_row(name);
  const Connection connection = connect_to(port, host);
  if (!connection) return kNothing;
  std::array<std::uint16_t, 2> words{};
  const auto read = row.table == "input" ? modbus_read_input_registers : modbus_read_registers;
  if (read(connection.get(), row.address, row.count, words.data()) != row.count) return kNothing;
  if (row.count == 1) return words[0];
  const std::uint32_t value = std::uint32_t{words[0]} << 16 | words[1];
  return row.type == "DINT" ? std::int64_t{static_cast<std::int32_t>(value)} : std::int64_t{value};
}

void write_command(int port, std::uint16_t code, const std::vector<std::int32_t>& arguments,
                   std::uint16_t sequence) {
  const Connection connection = connect_to(port);
  ASSERT_TRUE(connection);
  const auto address = [](const std::string& name) { return find_row(name).address; };
  std::vector<std::uint16_t> words;
  for (const std::int32_t argument : arguments) {
    const auto bits = static_cast<std::uint32_t>(argument);
    words.push_back(static_cast<std::uint16_t>(bits >> 16));
    words.push_back(static_cast<std::uint16_t>(bits));
  }
  const auto write = [&](int first) {
    const int count = static_cast<int>(words.size());
    EXPECT_EQ(modbus_write_registers(connection.get(), first, count, words.data()), count);
  };
  if (!words.empty()) write(address("argument_0"));
  ASSERT_EQ(address("command_sequence"), address("command") + 1);
  words = {code, sequence};
  write(address("command"));
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (read_register(port, "acknowledged_sequence") != sequence) {
    ASSERT_LT(std::chrono::steady_clock::now(), give_up) << "no answer to command " << code;
    std::this_thread::yield();
  }
}

}  // namespace orbwatch::tests
