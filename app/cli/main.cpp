// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/program.h"
#include "app/exit_status.h"
#include "app/version.h"

namespace orbwatch::app::cli {
namespace {

constexpr std::array kCommandTable{
    Subcommand{"project", "turn pictures of a mirror ball into an undistorted view",
               project_command},
    Subcommand{"advise", "what a camera, a lens and a ball would show, before you buy them",
               advise_command},
    Subcommand{"setup", "write a site for the cameras that are connected", setup_command},
    Subcommand{"detect", "find the mirror ball in a picture", detect_command},
    Subcommand{"register", "find how one camera of a rig stands to another", register_command},
    Subcommand{"place", "find out where cameras stand, by points that the ball shows",
               place_command},
    Subcommand{"drift", "whether a camera or the ball has moved against the rig", drift_command},
    Subcommand{"replay", "measure a recording again, also with another recipe", replay_command},
    Subcommand{"calibration", "show and restore the alignments that orbwatchd accepted",
               calibration_command},
    Subcommand{"subscribe", "read views and process state of a running orbwatchd over DDS",
               subscribe_command},
    Subcommand{"state", "show the process state of a running orbwatchd", state_command},
    Subcommand{"command", "send a command to a running orbwatchd", command_command},
    Subcommand{"password", "set a password of the page, or replace a forgotten one",
               password_command},
    Subcommand{"dds-keys", "make the keys of a secured DDS domain", dds_keys_command},
    Subcommand{"list",
               "show the cameras and GPIO lines that are connected, or a domain's appliances",
               list_command},
    Subcommand{"doctor", "check this board: what is wrong, and what mends it", doctor_command},
    Subcommand{"support", "write one file for technical support, without secrets", support_command},
    Subcommand{"backup", "write configuration, alignments, users and keys into one file",
               backup_command},
    Subcommand{"restore", "restore a backup, also on another device", restore_command},
    Subcommand{"reset", "put the delivered configuration back", reset_command},
    Subcommand{"update", "install an update on a device that runs an image", update_command},
    Subcommand{"configure", "check, try and keep a new configuration", configure_command},
    Subcommand{"events", "list, show, pin, delete and export recorded events", events_command},
    Subcommand{"lines", "set the GPIO outputs of a configuration inactive", lines_command},
    Subcommand{"bench", "whether this computer does the work of a configuration", bench_command},
    Subcommand{"describe", "print manuals, and what follows from a rig or a view",
               describe_command},
};

std::string exit_statuses_help() {
  std::string help;
  for (const ExitStatusInfo& info : kExitStatuses) {
    if (info.of_orbwatch.empty()) continue;
    help += "  " + std::to_string(static_cast<int>(info.status)) + "  " +
            std::string(info.of_orbwatch) + "\n";
  }
  return help;
}

std::string help() {
  return "Usage: orbwatch COMMAND [options]\n\n"
         "Tools around mirror balls and the orbwatchd service.\n\n" +
         subcommands_help(kCommandTable) +
         "\n`orbwatch COMMAND --help` explains a command; --version names the libraries.\n\n"
         "Exit status:\n" +
         exit_statuses_help();
}

CliResult<std::string> dispatch(const Arguments& arguments) {
  const std::string name = arguments.words.empty() ? "" : arguments.words.front();
  if (name == "--help" || name == "-h" || name == "help") return help();
  if (name == "--version") return version_text("orbwatch");
  const auto* const command = std::ranges::find(kCommandTable, name, &Subcommand::name);
  if (command != kCommandTable.end()) return command->run(arguments);
  return usage_error(name.empty() ? "say what to do" : "there is no command " + name);
}

}  // namespace

std::span<const Subcommand> all_commands() { return kCommandTable; }

std::string subcommands_help(std::span<const Subcommand> subcommands) {
  constexpr std::size_t kColumn = 12;
  std::string help;
  for (const Subcommand& subcommand : subcommands) {
    std::string name(subcommand.name);
    name.resize(kColumn, ' ');
    help += "  " + name + std::string(subcommand.text) + "\n";
  }
  return help;
}

}  // namespace orbwatch::app::cli

int main(int argc, char** argv) {
  return orbwatch::app::cli::run_program("orbwatch", {{argv + 1, argv + argc}},
                                         orbwatch::app::cli::dispatch);
}
