// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "hal/clock.h"
#include "proc/signals/signals.h"

/// Description of the parts of a status. A part is a struct whose members are declared in one list
/// of lines like these, from which both the members and their descriptions are made:
///   FIELD(type, name, quantity, description): a count (std::uint64_t), a measured number (double),
///     a flag (bool), or a code: an enumeration with an operator_text() for each of its numbers;
///   AGE(name, description): a moment of this process' clock, reported as "<name>_age" in seconds.
/// A line may be appended, never moved or removed: interfaces number them by their place.
namespace orbwatch::app {

/// Unit, resolution and range of a number. Interfaces of integers send value / scale; minimum and
/// maximum are in the unit.
struct Quantity {
  std::string_view unit{};
  double scale = 1;
  double minimum = 0;
  double maximum = 0;
};

inline constexpr Quantity kFlag{"", 1, 0, 1};
inline constexpr Quantity kCode{"", 1, 0, 65535};
inline constexpr Quantity kCount{"", 1, 0, 4294967295};  ///< wraps where an interface has 32 bits
inline constexpr Quantity kRate{"1/s", 0.01, 0, 100000};
inline constexpr Quantity kLatency{"ms", 0.1, 0, 100000};
inline constexpr Quantity kAge{"s", 0.001, 0, 2147483.647};

/// The facts about a field, without its value.
struct FieldInfo : Quantity {
  std::string_view name;
  std::string_view description;
  std::string_view title{};  ///< name for people; empty: none
};

/// One field of a `Part`. `get` is a member's pointer or a function of the part.
template <class Get>
struct Field : FieldInfo {
  Get get;
};

template <class Get>
constexpr Field<Get> make_field(std::string_view name, const Quantity& quantity,
                                std::string_view description, Get get,
                                std::string_view title = {}) {
  return {{quantity, name, description, title}, get};
}

template <class Value>
concept Enumeration = std::is_enum_v<Value>;

/// Age of `moment`, s; NaN for the epoch, which stands for "never".
inline double age_s(hal::TimePoint moment, hal::TimePoint now) {
  if (moment == hal::TimePoint{}) return signals::kNotValid;
  return std::chrono::duration<double>(now - moment).count();
}

/// One number of a closed list, and its meaning.
struct CodeText {
  std::uint16_t number = 0;
  std::string_view text;
};

/// All numbers of an enumeration that has no gaps, ascending. Reentrant.
template <Enumeration Enum>
std::vector<CodeText> code_texts() {
  std::vector<CodeText> all;
  for (std::uint16_t number = 0;; ++number) {
    const std::string_view text = operator_text(static_cast<Enum>(number));
    if (text.empty()) return all;
    all.push_back({number, text});
  }
}

}  // namespace orbwatch::app

// Expansions of a list of lines: the members of the part, or a call of visit() for each field.
#define ORBWATCH_FIELD_MEMBER(type, name, quantity, description) type name{};
#define ORBWATCH_AGE_MEMBER(name, description) ::orbwatch::hal::TimePoint name{};
#define ORBWATCH_VISIT_FIELD(type, name, quantity, description) \
  visit(make_field(#name, quantity, description, &Part::name));
#define ORBWATCH_VISIT_AGE(name, description) \
  visit(make_field(#name "_age", kAge, description, &Part::name));
