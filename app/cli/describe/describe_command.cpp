#include <array>
#include <iostream>
#include <string_view>

#include "app/cli/command.h"
#include "app/cli/describe/describe.h"
#include "app/cli/options/options.h"
#include "app/files/configuration.h"
#include "app/files/recipe_file.h"
#include "app/files/rig_file.h"
#include "app/ports/modbus/map/handbook.h"

namespace orbwatch::app {
namespace {

/// A subject that takes no options.
template <std::string (*manual)()>
Result<std::string> describe_manual(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1) return manual();
  return fail("unexpected argument " + arguments[1] + "; see orbwatch describe --help");
}

struct Subject {
  std::string_view name;
  std::string_view text;
  Result<std::string> (*describe)(const std::vector<std::string>& arguments);
};

constexpr std::array kSubjects{
    Subject{"config", "manual of the configuration file", describe_manual<configuration_manual>},
    Subject{"rig", "manual of the rig file: cameras, ball and machine",
            describe_manual<rig_manual>},
    Subject{"recipe", "manual of a recipe's file: what is measured",
            describe_manual<recipe_manual>},
    Subject{"registers", "manual of the Modbus registers", describe_registers},
    Subject{"view", "what cameras resolve in a view", describe_view},
    Subject{"camera", "what follows from a rig for one camera; its calibration", describe_camera},
};

std::string help() {
  std::string text = "Usage: orbwatch describe SUBJECT [options]\n\nPrints to standard output.\n\n";
  for (const Subject& subject : kSubjects) {
    text += "  " + std::string(subject.name) + std::string(12 - subject.name.size(), ' ') +
            std::string(subject.text) + "\n";
  }
  return text + "\n`orbwatch describe SUBJECT --help` explains its options.\n";
}

}  // namespace

Result<std::string> describe_registers(const std::vector<std::string>& arguments) {
  static constexpr std::array kFormats{Word{"markdown", false}, Word{"csv", true}};
  bool csv = false, asks_help = false;
  const std::vector<Option> options{
      {"format", 0, joined(kFormats), "(default markdown)", word_option("format", kFormats, csv)},
      {"help", 'h', "", "this text", flag_option(asks_help)}};
  const auto rest = parse_options(arguments, options);
  if (!rest) return tl::unexpected(rest.error());
  if (asks_help) return "Usage: orbwatch describe registers [options]\n\n" + options_help(options);
  if (!rest->empty()) return fail("unexpected argument " + rest->front() + "; see --help");
  return csv ? registers_csv() : registers_markdown();
}

Result<> describe_command(const std::vector<std::string>& arguments) {
  const std::string name = arguments.size() > 1 ? arguments[1] : "";
  if (name == "--help" || name == "-h") {
    std::cout << help();
    return {};
  }
  for (const Subject& subject : kSubjects) {
    if (subject.name != name) continue;
    const auto text = subject.describe({arguments.begin() + 1, arguments.end()});
    if (!text) return tl::unexpected(text.error());
    std::cout << *text;
    return {};
  }
  std::string known;
  for (const Subject& s : kSubjects) known += (known.empty() ? "" : ", ") + std::string(s.name);
  return fail("say what to describe: " + known + "; see --help");
}

}  // namespace orbwatch::app
