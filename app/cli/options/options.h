// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/cli_result.h"
#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::cli {

/// Option of a command: declared once, for parsing and for --help.
struct Option {
  std::string name;      ///< name without the dashes
  char letter = '\0';    ///< short form, or none
  std::string argument;  ///< placeholder of its value, in capitals; empty for a flag
  std::string text;
  std::function<Result<>(const std::string& value)> set;
};

/// Place of options among the arguments.
enum class OptionOrder {
  Anywhere,
  First  ///< before the first other argument, which then may be a number such as -40
};

/// Syntax of a command; --help is added to its options.
struct CommandLine {
  std::string usage;  ///< printed by --help before the options
  std::vector<Option> options;
  bool takes_words = false;  ///< accepts arguments that are not options
  OptionOrder order = OptionOrder::Anywhere;
  std::string notes{};  ///< printed by --help after the options
};

/// Arguments of a command.
struct Arguments {
  std::vector<std::string> words;  ///< its name first
  /// Set: run_command() stores the declaration there and does nothing else.
  std::optional<CommandLine>* declaration = nullptr;
};

/// Parses the arguments, calls the options' set(), and returns the result of `run` for the words
/// that are not options; or the help. Errors: unknown option, missing value, unexpected argument
/// and those of set(), which are of WrongUsage; those of `run`. Thread-bound: it uses getopt(3).
CliResult<std::string> run_command(
    const Arguments& arguments, CommandLine line,
    const std::function<CliResult<std::string>(const std::vector<std::string>& words)>& run);

/// Parses `text` as a finite number. The error names the option `name`.
Result<double> parse_number(std::string_view name, std::string_view text);
/// Parses `text` as a whole number.
Result<int> parse_whole(std::string_view name, std::string_view text);
/// Parses `text` as numbers separated by commas.
Result<std::vector<double>> parse_numbers(std::string_view name, std::string_view text);

/// Size of a picture, pixels.
struct Size {
  int width = 0;
  int height = 0;
};

/// Parses `text` as WIDTHxHEIGHT.
Result<Size> parse_size(std::string_view name, std::string_view text);

/// set() for a flag.
std::function<Result<>(const std::string&)> flag_option(bool& target);

/// set() for an option that may be repeated; each value is appended.
std::function<Result<>(const std::string&)> list_option(std::vector<std::string>& target);

/// set() for an option whose text is stored unchanged: a name, a file.
template <class Text>
std::function<Result<>(const std::string&)> text_option(Text& target) {
  return [&target](const std::string& value) -> Result<> {
    target = value;
    return {};
  };
}

/// set() for an option that is one of some words.
template <class Value, class T, std::size_t N>
std::function<Result<>(const std::string&)> word_option(std::string name,
                                                        const std::array<Word<T>, N>& words,
                                                        Value& target) {
  return [name = std::move(name), &words, &target](const std::string& value) -> Result<> {
    if (const T* found = find_word(words, value)) {
      target = *found;
      return {};
    }
    return fail("--" + name + " is \"" + value + "\"; use one of: " + joined(words));
  };
}

/// set() for an option that is a finite number.
template <class Number>
std::function<Result<>(const std::string&)> number_option(std::string name, Number& target) {
  return [name = std::move(name), &target](const std::string& value) -> Result<> {
    return parse_number(name, value).map([&target](double number) { target = number; });
  };
}

}  // namespace orbwatch::app::cli
