// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/request.h"

#include <algorithm>
#include <array>

namespace orbwatch::app::modbus {
namespace {

using Pdu = std::span<const std::uint8_t>;
using Parsed = tl::expected<Request, Exception>;

// Largest quantities, so that request and answer fit into 253 bytes (V1.1b3, 6).
constexpr int kMaxReadBits = 2000;
constexpr int kMaxWriteBits = 1968;
constexpr int kMaxWriteRegisters = 123;
constexpr int kMaxReadWriteRegisters = 121;

constexpr auto kBadValue = tl::unexpected(Exception::IllegalDataValue);

std::uint16_t word(Pdu bytes, std::size_t offset) {
  return static_cast<std::uint16_t>(bytes[offset] << 8 | bytes[offset + 1]);
}

std::vector<std::uint16_t> words(Pdu bytes) {
  std::vector<std::uint16_t> values;
  for (std::size_t i = 0; i < bytes.size(); i += 2) values.push_back(word(bytes, i));
  return values;
}

bool in_range(int count, int maximum) { return count >= 1 && count <= maximum; }

template <Table table, int maximum>
Parsed read_request(Pdu pdu) {
  if (!in_range(word(pdu, 3), maximum)) return kBadValue;
  return Request{.read = Range{table, word(pdu, 1), word(pdu, 3)}};
}

Parsed write_single_coil(Pdu pdu) {
  const int value = word(pdu, 3);
  if (value != 0 && value != 0xff00) return kBadValue;
  return Request{.write = Write{{Table::Coil, word(pdu, 1), 1}, {value != 0}}};
}

Parsed write_single_register(Pdu pdu) {
  return Request{.write = Write{{Table::Holding, word(pdu, 1), 1}, {word(pdu, 3)}}};
}

Parsed write_multiple_coils(Pdu pdu) {
  const int count = word(pdu, 3);
  if (!in_range(count, kMaxWriteBits) || pdu[5] != (count + 7) / 8) return kBadValue;
  Write write{{Table::Coil, word(pdu, 1), count}, {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    write.values.push_back(pdu[6 + i / 8] >> i % 8 & 1);
  }
  return Request{.write = std::move(write)};
}

Parsed write_multiple_registers(Pdu pdu) {
  const int count = word(pdu, 3);
  if (!in_range(count, kMaxWriteRegisters) || pdu[5] != 2 * count) return kBadValue;
  return Request{.write = Write{{Table::Holding, word(pdu, 1), count}, words(pdu.subspan(6))}};
}

Parsed mask_write_register(Pdu pdu) {
  return Request{.mask = MaskWrite{word(pdu, 1), word(pdu, 3), word(pdu, 5)}};
}

Parsed read_write_registers(Pdu pdu) {
  const int reads = word(pdu, 3);
  const int writes = word(pdu, 7);
  if (!in_range(reads, kMaxReadRegisters) || !in_range(writes, kMaxReadWriteRegisters) ||
      pdu[9] != 2 * writes) {
    return kBadValue;
  }
  return Request{.read = Range{Table::Holding, word(pdu, 1), reads},
                 .write = Write{{Table::Holding, word(pdu, 5), writes}, words(pdu.subspan(10))}};
}

/// A supported function.
struct Function {
  std::uint8_t code;
  std::size_t fixed;         ///< length of the fixed fields, bytes
  bool is_counted;           ///< the last of them is the number of following bytes
  Parsed (*parse)(Pdu pdu);  ///< called for a request of the right length
};

constexpr std::array kFunctions{
    Function{0x01, 5, false, read_request<Table::Coil, kMaxReadBits>},
    Function{0x02, 5, false, read_request<Table::Discrete, kMaxReadBits>},
    Function{0x03, 5, false, read_request<Table::Holding, kMaxReadRegisters>},
    Function{0x04, 5, false, read_request<Table::Input, kMaxReadRegisters>},
    Function{0x05, 5, false, write_single_coil},
    Function{0x06, 5, false, write_single_register},
    Function{0x0f, 6, true, write_multiple_coils},
    Function{0x10, 6, true, write_multiple_registers},
    Function{0x16, 7, false, mask_write_register},
    Function{0x17, 10, true, read_write_registers},
    Function{0x2b, 4, false, nullptr},  // Read Device Identification, which identify() parses
};

/// The function of a protocol data unit; nullptr: not supported.
const Function* function_of(Pdu pdu) {
  const auto* const found = std::ranges::find(kFunctions, pdu[0], &Function::code);
  return found == kFunctions.end() ? nullptr : found;
}

/// Value for the row whose first register is value `first` of the write.
std::uint32_t written(const Write& write, std::size_t first, const Row& row) {
  if (row.count == 1) return write.values[first];
  return std::uint32_t{write.values[first]} << 16 | write.values[first + 1];
}

double in_unit(std::uint32_t code, const Row& row) {
  if (row.type == Type::Dint) return row.quantity.scale * static_cast<std::int32_t>(code);
  return row.quantity.scale * code;
}

}  // namespace

Parsed parse(Pdu pdu) {
  const Function* function = function_of(pdu);
  if (!function || !function->parse) return tl::unexpected(Exception::IllegalFunction);
  if (pdu.size() != request_length(pdu)) return kBadValue;
  return function->parse(pdu);
}

std::optional<std::size_t> request_length(Pdu pdu) {
  const Function* function = function_of(pdu);
  if (!function) return std::nullopt;
  const std::size_t fixed = function->fixed;
  return function->is_counted && pdu.size() >= fixed ? fixed + pdu[fixed - 1] : fixed;
}

Write resolved(const MaskWrite& mask, const RegisterMap& map, const ProcessImage& image) {
  const Row* row = map.find(Table::Holding, mask.address);
  const auto old = static_cast<std::uint16_t>(row && row->read ? row->read(image) : 0);
  const int value = (old & mask.and_mask) | (mask.or_mask & ~mask.and_mask);
  return {{Table::Holding, mask.address, 1}, {static_cast<std::uint16_t>(value)}};
}

std::optional<Exception> check(const Range& read, const RegisterMap& map) {
  for (int address = read.address; address < read.address + read.count;) {
    const Row* row = map.find(read.table, address);
    if (!row) return Exception::IllegalDataAddress;
    address = row->address + row->count;
  }
  return std::nullopt;
}

bool writes_machine_state(const Range& range) {
  return range.table == Table::Holding && range.address < kMachineState.end &&
         range.address + range.count > kMachineState.begin;
}

std::optional<Exception> check(const Write& write, const RegisterMap& map) {
  const auto& [table, address, count] = write.range;
  const bool is_whole =
      address <= kWholeMachineState.begin && address + count >= kWholeMachineState.end;
  if (writes_machine_state(write.range) && !is_whole) return Exception::IllegalDataAddress;
  for (int i = 0; i < count;) {
    const Row* row = map.find(table, address + i);
    const bool whole = row && row->address == address + i && i + row->count <= count;
    if (!whole || !row->write) return Exception::IllegalDataAddress;
    i += row->count;
  }
  // The standard's state diagrams check all addresses before any value.
  for (int i = 0; i < count;) {
    const Row* row = map.find(table, address + i);
    const double value = in_unit(written(write, static_cast<std::size_t>(i), *row), *row);
    i += row->count;
    if (writes_machine_state({table, row->address, row->count})) continue;
    if (value < row->quantity.minimum || value > row->quantity.maximum)
      return Exception::IllegalDataValue;
  }
  return std::nullopt;
}

void apply(const Write& write, const RegisterMap& map, PlcRegisters& registers) {
  for (int i = 0; i < write.range.count;) {
    const Row* row = map.find(write.range.table, write.range.address + i);
    row->write(registers, written(write, static_cast<std::size_t>(i), *row));
    i += row->count;
  }
}

}  // namespace orbwatch::app::modbus
