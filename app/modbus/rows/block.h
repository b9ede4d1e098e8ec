#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/modbus/register_map.h"
#include "app/modbus/register_values.h"

namespace orbwatch::app::modbus {

inline constexpr double kMaxU16 = 65535;
inline constexpr double kMaxU32 = 4294967295;
inline constexpr double kMaxI32 = 2147483647;
inline constexpr Quantity kWord{1, "", 0, kMaxU16};
inline constexpr Quantity kCounter{1, "", 0, kMaxU32};
inline constexpr Quantity kRate{0.01, "1/s", 0, 655.35};
inline constexpr Quantity kLatency{0.1, "ms", 0, 6553.5};
inline constexpr Quantity kAge{1, "ms", 0, kMaxI32};

/// Declares the rows of one entry of a block, in the order of their addresses, without gaps. What
/// they read is found in the snapshot by `source`; `read` takes it to a value: a member's pointer,
/// or a function of the source, or of source and snapshot.
template <class Source>
class Block {
 public:
  using Find = std::function<const Source&(const Snapshot&)>;

  Block(Table table, int address, std::string prefix, Find source)
      : table_(table), next_(address), prefix_(std::move(prefix)), source_(std::move(source)) {}

  template <class Read>
  Block& u16(const std::string& name, const Quantity& quantity, std::string description,
             Read read) {
    return add(Type::U16, name, quantity, std::move(description), std::move(read));
  }
  template <class Read>
  Block& u32(const std::string& name, const Quantity& quantity, std::string description,
             Read read) {
    return add(Type::U32, name, quantity, std::move(description), std::move(read));
  }
  template <class Read>
  Block& i32(const std::string& name, const Quantity& quantity, std::string description,
             Read read) {
    return add(Type::I32, name, quantity, std::move(description), std::move(read));
  }
  template <class Read>
  Block& bit(const std::string& name, std::string description, Read read) {
    return add(Type::Bool, name, {1, "", 0, 1}, std::move(description), std::move(read));
  }

  /// Makes the row before writable.
  Block& written(std::function<void(PlcRegisters&, std::uint32_t)> write) {
    rows_.back().access = Access::ReadWrite;
    rows_.back().write = std::move(write);
    return *this;
  }

  /// Reserves what is left before `end`.
  Block& reserved_to(int end) {
    if (next_ == end) return *this;
    const bool bits = table_ == Table::Coil || table_ == Table::Discrete;
    rows_.push_back({.table = table_,
                     .address = next_,
                     .count = end - next_,
                     .type = bits ? Type::Bool : Type::U16,
                     .name = "reserved_" + std::to_string(next_),
                     .description = "Reserved for growth; reads 0"});
    next_ = end;
    return *this;
  }

  std::vector<Row> rows() { return std::move(rows_); }

 private:
  template <class Read>
  Block& add(Type type, const std::string& name, const Quantity& quantity, std::string description,
             Read read) {
    const int count = type == Type::U32 || type == Type::I32 ? 2 : 1;
    rows_.push_back({.table = table_,
                     .address = next_,
                     .count = count,
                     .type = type,
                     .name = prefix_ + name,
                     .scale = quantity.scale,
                     .unit = std::string(quantity.unit),
                     .minimum = quantity.minimum,
                     .maximum = quantity.maximum,
                     .description = std::move(description)});
    rows_.back().read = [source = source_, read = std::move(read), type,
                         quantity](const Snapshot& snapshot) {
      if constexpr (std::is_invocable_v<Read, const Source&, const Snapshot&>) {
        return encoded(std::invoke(read, source(snapshot), snapshot), type, quantity);
      } else {
        return encoded(std::invoke(read, source(snapshot)), type, quantity);
      }
    };
    next_ += count;
    return *this;
  }

  Table table_;
  int next_;
  std::string prefix_;
  Find source_;
  std::vector<Row> rows_;
};

/// The rows of entries 0 to count - 1.
template <class RowsOf>
std::vector<Row> joined(std::size_t count, RowsOf rows_of) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < count; ++i) {
    for (Row& row : rows_of(i)) rows.push_back(std::move(row));
  }
  return rows;
}

/// No value in range reads as kNotValidCode or leaves 32 bits.
template <class Info>
constexpr bool fits(const Info& info) {
  return info.minimum / info.scale >= -kMaxI32 && info.maximum / info.scale <= kMaxI32;
}

/// For rows that read here and there.
inline const Snapshot& whole_snapshot(const Snapshot& snapshot) { return snapshot; }

}  // namespace orbwatch::app::modbus
