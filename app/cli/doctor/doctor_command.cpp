// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/doctor/checks.h"
#include "app/cli/doctor/doctor_text.h"
#include "app/cli/doctor/gather.h"
#include "app/cli/options/options.h"
#include "app/files/runtime/site_file.h"

namespace orbwatch::app::cli {
namespace {

Result<std::string> examine(const std::filesystem::path& file, bool json) {
  const auto facts = doctor::gather(doctor::this_computer(), file);
  const auto diagnoses = doctor::diagnose(facts);
  std::string text = json ? doctor::doctor_json(diagnoses) : doctor::doctor_table(diagnoses);
  if (doctor::worst(diagnoses) != doctor::Level::Fault) return text;
  std::cout << text << std::flush;
  return fail(doctor::summary(diagnoses));
}

}  // namespace

CliResult<std::string> doctor_command(const Arguments& arguments) {
  std::filesystem::path config;
  bool json = false;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch doctor [--config FILE] [--json]\n\n"
                "Checks this board for the installer: configuration, kernel, cameras, lines, real "
                "time,\nclock, network, disk, watchdog, heat. Each line says ok, warning or fault, "
                "what was found,\nand what mends it. Changes nothing. As root it sees all; as "
                "another user it says what that\nuser may not.\n\n",
       .options = {{"config", 'c', "FILE", "that of orbwatchd (default: as orbwatchd)",
                    text_option(config)},
                   {"json", 0, "",
                    "for programs: {\"worst\": LEVEL, \"checks\": [...]}; a check has\n"
                    "\"check\", \"level\", \"text\" and \"remedy\"",
                    flag_option(json)}},
       .notes = "\nA fault keeps orbwatchd from what its configuration says; with a warning it "
                "runs, at a\nrisk. Exit status 1: there is a fault.\n"},
      [&](const auto&) { return examine(files::site_file(config), json); });
}

}  // namespace orbwatch::app::cli
