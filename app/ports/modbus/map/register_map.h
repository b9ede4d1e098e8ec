// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/modbus/map/layout.h"
#include "app/ports/modbus/map/process_image.h"

namespace orbwatch::app::modbus {

enum class Table : std::uint8_t { Coil, Discrete, Input, Holding };

/// Data types of IEC 61131-3.
enum class Type : std::uint8_t { Bool, Uint, Udint, Dint };

enum class Access : std::uint8_t { Read, ReadWrite };

/// Names in the CSV.
std::string_view name_of(Table table);
std::string_view name_of(Type type);
std::string_view name_of(Access access);

/// One row of the map: a value, or reserved places, which read 0.
struct Row {
  Table table = Table::Input;
  int address = 0;  ///< zero-based, as in the request
  int count = 1;    ///< registers or bits; 2 for 32-bit values, high word first
  Type type = Type::Uint;
  Access access = Access::Read;
  std::string name{};
  /// Value in the unit = register * scale; writes outside the range are refused.
  Quantity quantity{};
  std::string description{};

  /// The register's content; 16-bit values in the low half. Empty: reserved.
  std::function<std::uint32_t(const ProcessImage& image)> read{};
  /// Present quantity of a value whose unit and scale depend on the state; empty: `quantity`.
  std::function<Quantity(const ProcessImage& image)> present_quantity{};
  /// Empty: read-only.
  std::function<void(PlcRegisters& registers, std::uint32_t value)> write{};
};

/// Returns whether the row repeats a row of another table, for PLCs that read only coils and
/// holding registers.
inline bool is_mirror(const Row& row) {
  return row.address >= kMirrorOffset && (row.table == Table::Coil || row.table == Table::Holding);
}

/// The only declaration of the places that PLCs read and write. Immutable; reentrant.
class RegisterMap {
 public:
  RegisterMap();
  RegisterMap(const RegisterMap&) = delete;
  RegisterMap& operator=(const RegisterMap&) = delete;

  /// Rows by table, then by address.
  std::span<const Row> rows() const { return rows_; }

  /// The row that holds this register or bit, or nullptr if the place is not mapped.
  const Row* find(Table table, int address) const;

  /// One more than the highest mapped address of the table.
  int size(Table table) const;

 private:
  std::vector<Row> rows_;
  std::array<std::vector<const Row*>, 4> by_address_;
};

}  // namespace orbwatch::app::modbus
