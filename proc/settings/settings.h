// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <ratio>
#include <string>
#include <string_view>

/// Building blocks with which settings structs declare their keys; README.md has an example.
namespace orbwatch {

/// The numbers that a key allows; NaN is never allowed.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool low_allowed = true;
  bool high_allowed = true;

  static constexpr Range above(double low, double high = std::numeric_limits<double>::max()) {
    return {low, high, false, true};
  }
  static constexpr Range between(double low, double high) { return {low, high, true, true}; }
  static constexpr Range inside(double low, double high) { return {low, high, false, false}; }

  bool contains(double value) const {
    return std::isfinite(value) && (low_allowed ? value >= low : value > low) &&
           (high_allowed ? value <= high : value < high);
  }

  /// Text such as "above 180, at most 360".
  std::string text() const {
    const auto number = [](double value) {
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, "%.10g", value);
      return std::string(buffer);
    };
    const bool has_low = low > -std::numeric_limits<double>::max();
    const bool has_high = high < std::numeric_limits<double>::max();
    if (has_low && has_high && low_allowed && high_allowed)
      return number(low) + " to " + number(high);
    std::string text;
    if (has_low) text += (low_allowed ? "at least " : "above ") + number(low);
    if (has_low && has_high) text += ", ";
    if (has_high) text += (high_allowed ? "at most " : "below ") + number(high);
    return text.empty() ? "any number" : text;
  }
};

inline constexpr Range kAnyNumber{};

/// The durations that a key allows, stated as a number of `Period`s; the member is a
/// std::chrono::duration.
template <class Period>
struct DurationRange {
  Range range;
};
using Seconds = DurationRange<std::ratio<1>>;
using Milliseconds = DurationRange<std::milli>;
using Microseconds = DurationRange<std::micro>;

/// Reference to another table's entry by its name in the file. `index` is set once all files are
/// loaded.
struct Reference {
  std::string name;
  std::size_t index = 0;
};

/// A table's settings and the line of the table in its file, for messages.
template <class Settings>
struct Located : Settings {
  int line = 0;
};

template <class Visitor, class Settings>
void visit(Visitor& v, Located<Settings>& located) {
  v.line(located.line);
  visit(v, static_cast<Settings&>(located));
}

/// A word that a key allows, and its value.
template <class T>
struct Word {
  std::string_view name;
  T value;
};
template <class T>
Word(const char*, T) -> Word<T>;

/// The value of the word `name`, or nullptr.
template <class T, std::size_t N>
const T* find_word(const std::array<Word<T>, N>& words, std::string_view name) {
  for (const Word<T>& word : words) {
    if (word.name == name) return &word.value;
  }
  return nullptr;
}

/// The word for `value`, or an empty text.
template <class T, std::size_t N>
std::string_view word_for(const std::array<Word<T>, N>& words, const T& value) {
  for (const Word<T>& word : words) {
    if (word.value == value) return word.name;
  }
  return {};
}

/// Text such as "exact, paper, classical".
template <class T, std::size_t N>
std::string joined(const std::array<Word<T>, N>& words) {
  std::string text;
  for (const Word<T>& word : words) text += (text.empty() ? "" : ", ") + std::string(word.name);
  return text;
}

}  // namespace orbwatch
