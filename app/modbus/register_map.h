#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/modbus/plc_registers.h"
#include "app/modbus/snapshot.h"

namespace orbwatch::app::modbus {

enum class Table : std::uint8_t { Coil, Discrete, Input, Holding };
enum class Type : std::uint8_t { Bool, U16, U32, I32 };
enum class Access : std::uint8_t { Read, ReadWrite };

/// The words of the manual's CSV for them.
std::string_view name_of(Table table);
std::string_view name_of(Type type);
std::string_view name_of(Access access);

/// Grows by one with every change that an existing PLC program could notice; new rows in reserved
/// places are not such a change.
inline constexpr int kMapVersion = 2;

/// Discrete input n is also coil n + 5000, and input register n holding register n + 5000: some
/// PLCs can read only coils and holding registers.
inline constexpr int kMirrorOffset = 5000;

/// What one request reads at most.
inline constexpr int kMaxReadRegisters = 125;

/// Where the blocks of input registers begin, and how far apart their entries stand.
inline constexpr int kSystemBlock = 0;
inline constexpr int kHealthBlock = 100;
inline constexpr int kCameraBlock = 200;
inline constexpr int kCameraStride = 32;
inline constexpr int kViewBlock = 400;
inline constexpr int kViewStride = 16;
inline constexpr int kAlarmBlock = 700;
inline constexpr int kFirstAlarm = 720;
inline constexpr int kAlarmStride = 8;
inline constexpr int kLiveBlock = 1000;
inline constexpr int kResultBlock = 2000;
inline constexpr int kRegionStride = 128;

/// In an entry of either block of regions: the first signal, two registers each.
inline constexpr int kRegionSignals = 20;

/// One row of the map: a value, or a stretch that is reserved for later and reads 0.
struct Row {
  Table table = Table::Input;
  int address = 0;  ///< zero-based, as in the request
  int count = 1;    ///< registers or bits it takes; 2 for 32-bit values, high word first
  Type type = Type::U16;
  Access access = Access::Read;
  std::string name{};
  double scale = 1;  ///< value in the unit = register * scale
  std::string unit{};
  double minimum = 0;  ///< in the unit; what is written must lie between them
  double maximum = 0;
  std::string description{};

  /// The register's content; 16-bit values in the low half. Empty for reserved rows.
  std::function<std::uint32_t(const Snapshot& snapshot)> read{};
  /// Empty for rows that are only read.
  std::function<void(PlcRegisters& registers, std::uint32_t value)> write{};
};

/// The one declaration of what PLCs read and write. Immutable; reentrant.
class RegisterMap {
 public:
  RegisterMap();
  RegisterMap(const RegisterMap&) = delete;
  RegisterMap& operator=(const RegisterMap&) = delete;

  /// By table, then by address.
  std::span<const Row> rows() const { return rows_; }

  /// The row that holds this register or bit, or nullptr when nothing is mapped there.
  const Row* find(Table table, int address) const;

  /// One more than the highest mapped address of the table.
  int size(Table table) const;

 private:
  std::vector<Row> rows_;
  std::vector<const Row*> by_address_[4];
};

}  // namespace orbwatch::app::modbus
