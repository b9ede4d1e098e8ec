#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// The numbers that a key may have. Not-a-number is never among them.
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

  /// "above 180, at most 360"
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

/// One of the words that a key may have, and what it stands for.
template <class T>
struct Word {
  std::string_view name;
  T value;
};
template <class T>
Word(const char*, T) -> Word<T>;

/// What `name` stands for; nullptr when it is none of the words.
template <class T, std::size_t N>
const T* find_word(const std::array<Word<T>, N>& words, std::string_view name) {
  for (const Word<T>& word : words) {
    if (word.name == name) return &word.value;
  }
  return nullptr;
}

/// The word for `value`; empty when there is none.
template <class T, std::size_t N>
std::string_view word_for(const std::array<Word<T>, N>& words, const T& value) {
  for (const Word<T>& word : words) {
    if (word.value == value) return word.name;
  }
  return {};
}

/// "exact, paper, classical"
template <class T, std::size_t N>
std::string joined(const std::array<Word<T>, N>& words) {
  std::string text;
  for (const Word<T>& word : words) text += (text.empty() ? "" : ", ") + std::string(word.name);
  return text;
}

}  // namespace orbwatch::app
