// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/ports/modbus/map/encoding.h"
#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

inline constexpr Quantity kWord{"", 1, 0, 65535};
inline constexpr Quantity kDoubleWord{"", 1, 0, 4294967295};

/// Number of registers that all fields of a part occupy; 32-bit values are at even places.
template <class Part>
constexpr int registers_of() {
  int next = 0;
  for_each_field(std::type_identity<Part>{}, [&next](const auto& field) {
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(field.get), const Part&>>;
    if constexpr (std::is_same_v<Value, PartName>) {
      next += kPartWords;
    } else {
      next = type_of<Value>() == Type::Uint ? next + 1 : next + next % 2 + 2;
    }
  });
  return next;
}

/// Returns whether the field is an alarm's value, whose quantity is its signal's.
template <class Part>
constexpr bool is_signal_value(const FieldInfo& field) {
  return std::is_same_v<Part, AlarmStatus> && field.name == "value";
}

/// The quantity of a field in a part; that of an alarm's value is its signal's.
template <class Part>
Quantity quantity_in(const Part& part, const FieldInfo& field) {
  if constexpr (std::is_same_v<Part, AlarmStatus>) {
    if (is_signal_value<Part>(field)) return quantity_of(part);
  }
  return field;
}

/// Appends the rows of one part to `rows`, in the order of their addresses; `find` returns the part
/// in a process image. 32-bit values are at even addresses.
template <class Part>
class Block {
 public:
  using Find = std::function<const Part&(const ProcessImage&)>;

  Block(std::vector<Row>& rows, Table table, Section section, std::string prefix, Find find)
      : rows_(rows),
        begin_(rows.size()),
        table_(table),
        section_(section),
        next_(section.begin),
        prefix_(std::move(prefix)),
        find_(std::move(find)) {}

  /// `read` returns the register's content: std::uint32_t(const Part&, const ProcessImage&).
  template <class Read>
  Block& row(Type type, std::string_view name, const Quantity& quantity,
             std::string_view description, Read read) {
    const bool is_double = type == Type::Udint || type == Type::Dint;
    if (is_double) next_ += next_ % 2;
    const std::uint32_t mask = is_double ? 0xffffffff : 0xffff;
    rows_.push_back({.table = table_,
                     .address = next_,
                     .count = is_double ? 2 : 1,
                     .type = type,
                     .name = prefix_ + std::string(name),
                     .quantity = quantity,
                     .description = std::string(description),
                     .read = [find = find_, read = std::move(read),
                              mask](const ProcessImage& image) -> std::uint32_t {
                       return static_cast<std::uint32_t>(read(find(image), image)) & mask;
                     }});
    next_ += rows_.back().count;
    assert(next_ <= section_.end);
    return *this;
  }

  /// A described field.
  template <class Get>
  Block& field(const Field<Get>& field) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Get, const Part&>>;
    if constexpr (std::is_same_v<Value, PartName>) {
      return words(field);
    } else {
      return number(field);
    }
  }

  /// A described number: type and range follow from the type of its value.
  template <class Get>
  Block& number(const Field<Get>& field) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Get, const Part&>>;
    Quantity quantity = field;
    std::string description(field.description);
    if constexpr (Enumeration<Value>) {
      quantity = code_range<Value>();
      // Longer lists are tables of the handbook.
      if (quantity.maximum < 16) description += ": " + listed_codes<Value>();
    } else if constexpr (std::is_same_v<Value, hal::TimePoint>) {
      description += "; 2147483647: longer ago, or never";
    }
    if (is_signal_value<Part>(field)) description += "; register = value / scale of its signal";
    row(type_of<Value>(), field.name, quantity, description,
        [field](const Part& part, const ProcessImage& image) {
          return encoded(std::invoke(field.get, part), quantity_in(part, field), image.now);
        });
    if (is_signal_value<Part>(field)) {
      rows_.back().present_quantity = [find = find_, field](const ProcessImage& image) {
        return quantity_in(find(image), field);
      };
    }
    return *this;
  }

  /// A described name, two bytes a register.
  template <class Get>
  Block& words(const Field<Get>& field) {
    for (int i = 0; i < kPartWords; ++i) {
      row(Type::Uint, std::string(field.name) + "_" + std::to_string(i), kWord,
          part_words_text(field.description, i), [field, i](const Part& part, const ProcessImage&) {
            return part_word(std::invoke(field.get, part).text(), static_cast<std::size_t>(i));
          });
    }
    return *this;
  }

  /// Appends all fields of the part.
  Block& fields() {
    for_each_field(std::type_identity<Part>{}, [this](const auto& one) { this->field(one); });
    return *this;
  }

  Block& bit(std::string_view name, std::string_view description,
             std::function<bool(const ProcessImage&)> is_set) {
    return row(Type::Bool, name, kFlag, description,
               [is_set = std::move(is_set)](const Part&, const ProcessImage& image) {
                 return is_set(image) ? 1U : 0U;
               });
  }

  /// Makes the newest row writable.
  Block& written(std::function<void(PlcRegisters&, std::uint32_t)> write) {
    rows_.back().access = Access::ReadWrite;
    rows_.back().write = std::move(write);
    return *this;
  }

  /// Continues at this address.
  Block& at(int address) {
    assert(address >= next_);
    next_ = address;
    return *this;
  }

  /// Makes the first row, a code, read kNone while `is_absent` holds for the entry.
  Block& absent(std::string_view thing, std::function<bool(const ProcessImage&)> is_absent) {
    Row& row = rows_[begin_];
    row.quantity.maximum = kNone;
    row.description += "; 65535 no such " + std::string(thing) + " is configured";
    row.read = [is_absent = std::move(is_absent),
                read = std::move(row.read)](const ProcessImage& image) -> std::uint32_t {
      return is_absent(image) ? kNone : read(image);
    };
    return *this;
  }

 private:
  std::vector<Row>& rows_;
  const std::size_t begin_;  ///< place of its first own row
  Table table_;
  Section section_;
  int next_;
  std::string prefix_;
  Find find_;
};

/// Identity, for rows that combine parts.
inline const ProcessImage& whole_image(const ProcessImage& image) { return image; }

}  // namespace orbwatch::app::modbus
