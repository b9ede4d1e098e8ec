// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "app/cli/command.h"
#include "app/cli/describe/describe_programs.h"
#include "app/cli/options/options.h"
#include "app/files/configuration.h"
#include "app/files/recipe/recipe_file.h"
#include "app/files/rig/rig_file.h"
#include "app/ports/modbus/map/handbook.h"
#include "app/ports/web/described_routes.h"

namespace orbwatch::app::cli {
namespace {

/// Runs a subject that takes no options.
template <std::string (*manual)()>
CliResult<std::string> describe_manual(const Arguments& arguments) {
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch describe " + arguments.words.front() + "\n\n", .options = {}},
      [](const auto&) { return manual(); });
}

CliResult<std::string> describe_registers(const Arguments& arguments) {
  static constexpr std::array kFormats{Word{"markdown", false}, Word{"csv", true}};
  bool csv = false;
  return run_command(arguments,
                     {.usage = "Usage: orbwatch describe registers [options]\n\n",
                      .options = {{"format", 0, joined(kFormats), "(default markdown)",
                                   word_option("format", kFormats, csv)}}},
                     [&](const auto&) { return csv ? registers_csv() : registers_markdown(); });
}

std::string man();
std::string completion();

constexpr std::array kSubjects{
    Subcommand{"config", "manual of the configuration file",
               describe_manual<files::configuration_manual>},
    Subcommand{"rig", "manual of the rig file: cameras, ball and machine",
               describe_manual<files::rig_manual>},
    Subcommand{"recipe", "manual of a recipe's file: what is measured",
               describe_manual<files::recipe_manual>},
    Subcommand{"registers", "manual of the Modbus registers", describe_registers},
    Subcommand{"http", "manual of the HTTP interface", describe_manual<web::manual_of_all_routes>},
    Subcommand{"view", "what cameras resolve in a view", describe_view},
    Subcommand{"camera", "what follows from a rig for one camera; its calibration",
               describe_camera},
    Subcommand{"man", "manual page of orbwatch", describe_manual<man>},
    Subcommand{"completion", "completion of orbwatch's command line by bash",
               describe_manual<completion>},
};

std::string man() { return man_page(all_commands(), kSubjects); }
std::string completion() { return bash_completion(all_commands(), kSubjects); }

}  // namespace

CliResult<std::string> describe_command(const Arguments& arguments) {
  const std::vector<std::string>& words = arguments.words;
  const std::string name = words.size() > 1 ? words[1] : "";
  if (name == "--help" || name == "-h") {
    return "Usage: orbwatch describe SUBJECT [options]\n\nPrints to standard output.\n\n" +
           subcommands_help(kSubjects) +
           "\n`orbwatch describe SUBJECT --help` explains its options.\n";
  }
  const auto* const subject = std::ranges::find(kSubjects, name, &Subcommand::name);
  if (subject != kSubjects.end()) return subject->run({{words.begin() + 1, words.end()}});
  std::string known;
  for (const Subcommand& s : kSubjects) known += (known.empty() ? "" : ", ") + std::string(s.name);
  return usage_error("say what to describe: " + known);
}

}  // namespace orbwatch::app::cli
