// SPDX-License-Identifier: Apache-2.0
#include "app/cli/options/options.h"

#include <getopt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace orbwatch::app::cli {
namespace {

constexpr int kFirstLong = 1000;

/// Calls the options' set(); returns the arguments that are not options.
CliResult<std::vector<std::string>> parse(std::vector<std::string> arguments,
                                          const std::vector<Option>& options, OptionOrder order) {
  std::vector<option> table;
  table.reserve(options.size() + 1);
  // The colon makes getopt leave the reporting of errors to this function.
  std::string letters = order == OptionOrder::First ? "+:" : ":";
  for (std::size_t i = 0; i < options.size(); ++i) {
    const int takes = options[i].argument.empty() ? no_argument : required_argument;
    table.push_back({options[i].name.c_str(), takes, nullptr, kFirstLong + static_cast<int>(i)});
    if (options[i].letter != '\0') letters += options[i].letter + std::string(takes ? ":" : "");
  }
  table.push_back({nullptr, 0, nullptr, 0});
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  optind = 0;
  const int argc = static_cast<int>(arguments.size());
  for (int found = 0;
       (found = getopt_long(argc, argv.data(), letters.c_str(), table.data(), nullptr)) != -1;) {
    if (found == '?') return usage_error(std::string("unknown option ") + argv[optind - 1]);
    if (found == ':') return usage_error(std::string(argv[optind - 1]) + " needs a value");
    const auto chosen = std::find_if(options.begin(), options.end(), [&](const Option& o) {
      return o.letter == found || kFirstLong + (&o - options.data()) == found;
    });
    if (auto set = chosen->set(optarg ? optarg : ""); !set) {
      return tl::unexpected(CliError(set.error().message, ExitStatus::WrongUsage));
    }
  }
  return std::vector<std::string>(argv.begin() + optind, argv.begin() + argc);
}

/// The options as lines of --help.
std::string options_help(const std::vector<Option>& options) {
  constexpr std::size_t kColumn = 36;
  std::string help;
  for (const Option& o : options) {
    std::string line = o.letter != '\0' ? std::string("  -") + o.letter + ", --" : "  --";
    line += o.name + (o.argument.empty() ? "" : " " + o.argument);
    line += line.size() + 2 <= kColumn ? std::string(kColumn - line.size(), ' ')
                                       : "\n" + std::string(kColumn, ' ');
    for (const char c : o.text)
      line += c == '\n' ? "\n" + std::string(kColumn, ' ') : std::string(1, c);
    help += line + "\n";
  }
  return help;
}

}  // namespace

CliResult<std::string> run_command(
    const Arguments& arguments, CommandLine line,
    const std::function<CliResult<std::string>(const std::vector<std::string>& words)>& run) {
  bool asks_help = false;
  line.options.push_back({"help", 'h', "", "this text", flag_option(asks_help)});
  if (arguments.declaration != nullptr) {
    *arguments.declaration = std::move(line);
    return std::string();
  }
  const auto words = parse(arguments.words, line.options, line.order);
  if (!words) return tl::unexpected(words.error());
  if (asks_help) return line.usage + options_help(line.options) + line.notes;
  if (!words->empty() && !line.takes_words) {
    return usage_error("unexpected argument " + words->front());
  }
  return run(*words);
}

Result<double> parse_number(std::string_view name, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value))
    return value;
  return fail("--" + std::string(name) + " is \"" + std::string(text) +
              "\"; it must be a finite number");
}

Result<int> parse_whole(std::string_view name, std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  return fail("--" + std::string(name) + " is \"" + std::string(text) +
              "\"; it must be a whole number");
}

Result<std::vector<double>> parse_numbers(std::string_view name, std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = text.find(',');
    const auto number = parse_number(name, text.substr(0, comma));
    if (!number) return tl::unexpected(number.error());
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

Result<Size> parse_size(std::string_view name, std::string_view text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = parse_whole(name, text.substr(0, cross));
  const auto height = parse_whole(name, text.substr(std::min(cross + 1, text.size())));
  if (width && height) return Size{*width, *height};
  return fail("--" + std::string(name) + " is \"" + std::string(text) +
              "\"; it must be WxH, like 1280x720");
}

std::function<Result<>(const std::string&)> flag_option(bool& target) {
  return [&target](const std::string&) -> Result<> {
    target = true;
    return {};
  };
}

std::function<Result<>(const std::string&)> list_option(std::vector<std::string>& target) {
  return [&target](const std::string& value) -> Result<> {
    target.push_back(value);
    return {};
  };
}

}  // namespace orbwatch::app::cli
