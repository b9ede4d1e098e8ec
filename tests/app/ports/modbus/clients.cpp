// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/modbus/clients.h"

#include <modbus.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "tests/support/require.h"

namespace orbwatch::app::tests {
namespace {

using orbwatch::tests::require;

constexpr std::chrono::seconds kGuard{60};

}  // namespace

ModbusSettings loopback() {
  ModbusSettings settings;
  settings.address = "127.0.0.1";
  settings.port = 0;
  settings.frame_timeout = settings.idle_time = settings.status_timeout = std::chrono::hours(1);
  return settings;
}

CommandResult accept_all(const Command&) { return CommandResult::Done; }

Status example_status() {
  Status status;
  status.state = SystemState::Degraded;
  status.heartbeat = 0x1'0102;
  status.frame_set = 0x1'8001'0203;
  status.stamp = hal::Clock::now();
  status.overruns = 0x0011'0304;
  status.trigger = 0x0012'0015;
  status.result = 0x0013'0016;
  status.recipe = 7;
  status.configuration_checksum = 0x89ab'cdef;
  status.process_active = true;
  status.unmatched = 0x0022'0405;
  status.load = 0.4567;
  status.selected_view = 2;
  status.camera_count = 2;
  status.view_count = 3;
  status.cameras[0].frames_per_second = 29.974;
  status.cameras[0].frames = 0x0033'0506;
  status.cameras[0].lost = 0x0044'0607;
  status.cameras[0].dropped = 0x0055'0708;
  status.cameras[1].fault = hal::Fault::Stalled;
  status.cameras[1].frames_per_second = 12.5;
  status.cameras[1].frames = 0x0066'0809;
  status.cameras[1].lost = 0x0077'090a;
  status.cameras[1].dropped = 0x0088'0a0b;
  status.views[2] = {.published = 0x0099'0b0c,
                     .skipped = 0x00aa'0c0d,
                     .frames_per_second = 24.996,
                     .latency_p50_ms = 41.26,
                     .latency_p99_ms = 87.64};
  status.region_count = 1;
  status.regions[0].quality = Quality::Good;
  status.regions[0].signals.hot_spot_yaw = -123.456;
  status.regions[0].signals.hot_spot_pitch = 12.344;
  status.regions[0].signals.hot_spot_solid_angle = 0.7;
  status.regions[0].signals.hot_spot_peak_temperature = -20.04;
  return status;
}

namespace {

int place_in(std::initializer_list<modbus::Table> tables, std::string_view name) {
  static const modbus::RegisterMap map;
  for (const modbus::Row& row : map.rows()) {
    const bool is_there = std::ranges::find(tables, row.table) != tables.end();
    if (is_there && row.name == name && !is_mirror(row)) return row.address;
  }
  throw std::out_of_range(std::string(name));
}

}  // namespace

int address_of(std::string_view name) {
  return place_in({modbus::Table::Holding, modbus::Table::Input}, name);
}

int bit_of(std::string_view name) { return place_in({modbus::Table::Discrete}, name); }

Plc::Plc(int port, int unit, const std::string& server)
    : context_(modbus_new_tcp(server.c_str(), port)) {
  connect(unit);
}

Plc::Plc(const std::string& line, int unit)
    : context_(modbus_new_rtu(line.c_str(), 19200, 'N', 8, 1)) {
  connect(unit);
}

void Plc::connect(int unit) {
  require(context_ && modbus_set_slave(context_.get(), unit) == 0 &&
          modbus_set_response_timeout(context_.get(), 60, 0) == 0 &&
          modbus_connect(context_.get()) == 0);
}

void Plc::Close::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

int Plc::outcome(int result) const {
  if (result >= 0) return 0;
  const bool exception = errno > MODBUS_ENOBASE && errno < MODBUS_ENOBASE + MODBUS_EXCEPTION_MAX;
  return exception ? errno - MODBUS_ENOBASE : -1;
}

int Plc::read_bits(int address, int count) {
  bits.resize(static_cast<std::size_t>(count));
  return outcome(modbus_read_bits(context_.get(), address, count, bits.data()));
}

int Plc::read_discrete(int address, int count) {
  bits.resize(static_cast<std::size_t>(count));
  return outcome(modbus_read_input_bits(context_.get(), address, count, bits.data()));
}

int Plc::read_holding(int address, int count) {
  words.resize(static_cast<std::size_t>(count));
  return outcome(modbus_read_registers(context_.get(), address, count, words.data()));
}

int Plc::read_input(int address, int count) {
  words.resize(static_cast<std::size_t>(count));
  return outcome(modbus_read_input_registers(context_.get(), address, count, words.data()));
}

int Plc::write(int address, std::uint16_t value) {
  return outcome(modbus_write_register(context_.get(), address, value));
}

int Plc::write(int address, const Words& values) {
  return outcome(modbus_write_registers(context_.get(), address, static_cast<int>(values.size()),
                                        values.data()));
}

int Plc::command(int address, const Words& values) {
  if (const int exception = write(address, values); exception != 0) return exception;
  const bool is_acknowledged = eventually([&] {
    return read_holding(address_of("acknowledged_sequence"), 1) == 0 && words[0] == values.back();
  });
  return is_acknowledged ? 0 : -1;
}

int Plc::mask_write(int address, std::uint16_t and_mask, std::uint16_t or_mask) {
  return outcome(modbus_mask_write_register(context_.get(), address, and_mask, or_mask));
}

int Plc::write_and_read(int write_address, const Words& values, int read_address, int count) {
  words.resize(static_cast<std::size_t>(count));
  return outcome(modbus_write_and_read_registers(context_.get(), write_address,
                                                 static_cast<int>(values.size()), values.data(),
                                                 read_address, count, words.data()));
}

int Plc::write_coil(int address) { return outcome(modbus_write_bit(context_.get(), address, 1)); }

int Plc::write_coils(int address, int count) {
  const std::vector<std::uint8_t> values(static_cast<std::size_t>(count), 1);
  return outcome(modbus_write_bits(context_.get(), address, count, values.data()));
}

std::uint32_t Plc::u32(std::size_t place) const {
  return std::uint32_t{words.at(place)} << 16 | words.at(place + 1);
}

Bytes receive_pdu(RawClient& client) {
  const Bytes header = client.receive(7);
  if (header.size() < 7) return {};
  return client.receive(static_cast<std::size_t>(header[4] << 8 | header[5]) - 1);
}

Bytes frame(const Bytes& pdu, std::uint8_t unit, std::uint16_t transaction) {
  const std::size_t length = pdu.size() + 1;
  Bytes bytes(6 + length);
  bytes[0] = static_cast<std::uint8_t>(transaction >> 8);
  bytes[1] = static_cast<std::uint8_t>(transaction);
  bytes[4] = static_cast<std::uint8_t>(length >> 8);
  bytes[5] = static_cast<std::uint8_t>(length);
  bytes[6] = unit;
  std::ranges::copy(pdu, bytes.begin() + 7);
  return bytes;
}

Bytes rtu_frame(int unit, const Bytes& pdu) {
  Bytes bytes(1 + pdu.size());
  bytes[0] = static_cast<std::uint8_t>(unit);
  std::ranges::copy(pdu, bytes.begin() + 1);
  // Checksum by Modbus over Serial Line V1.02, 6.2.2.
  unsigned checksum = 0xffff;
  for (const unsigned byte : bytes) {
    checksum ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (checksum & 1) != 0;
      checksum >>= 1;
      if (carry) checksum ^= 0xa001;
    }
  }
  bytes.push_back(static_cast<std::uint8_t>(checksum));
  bytes.push_back(static_cast<std::uint8_t>(checksum >> 8));
  return bytes;
}

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kGuard;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::yield();
  }
  return true;
}

}  // namespace orbwatch::app::tests
