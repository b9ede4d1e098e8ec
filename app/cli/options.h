#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// One option of a command: declared once, for parsing and for --help.
struct Option {
  std::string name;      ///< without the dashes
  char letter = '\0';    ///< short form, or none
  std::string argument;  ///< what it takes, in capitals; empty for a flag
  std::string text;
  std::function<Result<>(const std::string& value)> set;
};

/// Reads `arguments` (the command's name first) and calls the options' set(). Returns the arguments
/// that are no option. Errors: unknown option, missing value, whatever set() says.
Result<std::vector<std::string>> parse_options(std::vector<std::string> arguments,
                                               const std::vector<Option>& options);

/// The options as lines of --help.
std::string options_help(const std::vector<Option>& options);

/// `text` as a finite number; `name` stands in the error.
Result<double> parse_number(std::string_view name, std::string_view text);
/// `text` as a whole number.
Result<int> parse_whole(std::string_view name, std::string_view text);
/// `text` as numbers with commas between.
Result<std::vector<double>> parse_numbers(std::string_view name, std::string_view text);

/// set() for an option that is a finite number.
template <class Number>
std::function<Result<>(const std::string&)> number_option(std::string name, Number& target) {
  return [name = std::move(name), &target](const std::string& value) -> Result<> {
    return parse_number(name, value).map([&target](double number) { target = number; });
  };
}

}  // namespace orbwatch::app
