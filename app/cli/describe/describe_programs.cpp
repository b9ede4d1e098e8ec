// SPDX-License-Identifier: Apache-2.0
#include "app/cli/describe/describe_programs.h"

#include <optional>

#include "app/cli/options/options.h"
#include "app/exit_status.h"
#include "app/model/command/command.h"

namespace orbwatch::app::cli {
namespace {

/// Escapes text for man(7): no line is a request, no hyphen a dash.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((out.empty() || out.back() == '\n') && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string trimmed(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

/// Keeps the lines of a text unchanged.
std::string verbatim(const std::string& text) {
  return ".nf\n" + escaped(trimmed(text)) + "\n.fi\n";
}

std::string option_entry(const Option& option) {
  std::string entry = ".TP\n\\fB";
  if (option.letter != '\0') entry += "\\-" + std::string(1, option.letter) + "\\fR, \\fB";
  entry += escaped("--" + option.name) + "\\fR";
  if (!option.argument.empty()) entry += " \\fI" + escaped(option.argument) + "\\fR";
  return entry + "\n" + escaped(trimmed(option.text)) + "\n";
}

/// Declaration that a command passes to run_command(); nullopt: it takes no options.
std::optional<CommandLine> declaration_of(const Subcommand& command) {
  std::optional<CommandLine> declared;
  // A command without options prints or refuses; its result is dropped.
  static_cast<void>(command.run({{std::string(command.name)}, &declared}));
  return declared;
}

std::string section(const std::string& before, const Subcommand& command) {
  std::string text = ".SS \"" + before + std::string(command.name) + "\"\n" +
                     escaped(std::string(command.text)) + ".\n";
  const auto declared = declaration_of(command);
  if (!declared) return text;
  text += ".PP\n" + verbatim(declared->usage);
  for (const Option& option : declared->options) text += option_entry(option);
  if (!declared->notes.empty()) text += ".PP\n" + verbatim(declared->notes);
  return text;
}

constexpr const char* kHead =
    R"(.\" Made by: orbwatch describe man
.TH ORBWATCH 1 "" "orbwatch" "User Commands"
.SH NAME
orbwatch \- tools around mirror balls and the orbwatchd service
.SH SYNOPSIS
.B orbwatch
.I COMMAND
.RI [ options ]
.SH COMMANDS
)";

std::string exit_statuses() {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitStatusInfo& info : kExitStatuses) {
    if (info.of_orbwatch.empty()) continue;
    text += ".TP\n" + std::to_string(static_cast<int>(info.status)) + "\n" +
            escaped(info.of_orbwatch) + "\n";
  }
  return text;
}

constexpr const char* kTail = R"(.SH ENVIRONMENT
.TP
.B ORBWATCH_CONFIG
The configuration file, where none is given.
.TP
.B STATE_DIRECTORY
The folder of what must outlast a restart, where the configuration names none. With
.B \-\-config
of another machine on this board it need not be set: its orbwatchd records there which
configuration it runs.
.TP
.B RUNTIME_DIRECTORY
The folder in which a service records the outputs that it drives.
.TP
.B ORBWATCH_RESTORE_FOLDER
The folder whose backup \fBrestore \-\-pending\fR restores, once: restore.tar.zst, with its
passphrase, and lines NAME=ADDRESS in cameras, beside it.
.SH FILES
.TP
.I /etc/orbwatch/site.toml
The configuration, which names the files of rig and recipes.
.TP
.IR /var/lib/orbwatch ", " /var/lib/orbwatch\-NAME
What must outlast a restart: commands, alignments, the last good configuration.
.SH SEE ALSO
.BR systemctl (1),
.BR journalctl (1)
)";

void add_word(std::string& words, std::string_view word) {
  if (!words.empty()) words += ' ';
  words += word;
}

std::string names(std::span<const Subcommand> subcommands) {
  std::string words;
  for (const Subcommand& subcommand : subcommands) add_word(words, subcommand.name);
  return words;
}

std::string option_words(const Subcommand& command) {
  std::string words;
  if (const auto declared = declaration_of(command)) {
    for (const Option& option : declared->options) add_word(words, "--" + option.name);
  }
  return words;
}

std::string branch(const std::string& pattern, const std::string& words) {
  return words.empty() ? "" : "    " + pattern + ") words=\"" + words + "\" ;;\n";
}

}  // namespace

std::string man_page(std::span<const Subcommand> commands, std::span<const Subcommand> subjects) {
  std::string text = kHead;
  for (const Subcommand& command : commands) {
    text += section("", command);
    if (command.name != "describe") continue;
    for (const Subcommand& subject : subjects) text += section("describe ", subject);
  }
  return text + exit_statuses() + kTail;
}

std::string bash_completion(std::span<const Subcommand> commands,
                            std::span<const Subcommand> subjects) {
  std::string branches;
  for (const Subcommand& command : commands) {
    const std::string name(command.name);
    if (name == "describe") {
      for (const Subcommand& subject : subjects) {
        branches +=
            branch("\"describe " + std::string(subject.name) + "\"*", option_words(subject));
      }
      branches += branch("\"describe \"*", names(subjects));
      continue;
    }
    std::string words = option_words(command);
    if (name == "command") {
      for (const CommandInfo& info : kCommands) add_word(words, info.name);
    }
    branches += branch("\"" + name + " \"*", words);
  }
  return "# Made by: orbwatch describe completion\n"
         "_orbwatch() {\n"
         "  local words=\"\" line=\"${COMP_WORDS[*]:1:COMP_CWORD-1} \"\n"
         "  case $line in\n"
         "    \" \") words=\"" +
         names(commands) + " --help --version\" ;;\n" + branches +
         "  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\")\n"
         "}\n"
         "complete -o bashdefault -o default -F _orbwatch orbwatch\n";
}

}  // namespace orbwatch::app::cli
