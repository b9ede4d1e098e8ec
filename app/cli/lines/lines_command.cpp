// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/files/resolve.h"
#include "app/files/runtime/driven_lines.h"
#include "app/files/runtime/site_file.h"
#include "app/ports/lines/safe_state.h"
#include "app/state/state_folder.h"
#include "hal/lines/gpio/gpio_lines.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

/// Folder with the record of outputs by the orbwatchd of this file. Error: the state folder belongs
/// to another machine.
Result<fs::path> record_folder(const fs::path& file) {
  if (auto folder = runtime_directory()) return std::move(*folder);
  return state_folder({}, file);
}

/// Lines of the file, or of the configuration that ran last if the file is wrong.
Result<std::vector<LineSettings>> lines_of_file(const fs::path& file) {
  const auto read = files::read_site(file);
  if (read) return std::vector<LineSettings>(read->lines.begin(), read->lines.end());
  const auto folder = state_folder({}, file);
  if (!folder) return tl::unexpected(folder.error());
  const auto last_good = files::resolve_last_good(*folder, file);
  if (!last_good) return fail(read.error().message + "; " + last_good.error().message);
  const auto& lines = last_good->site.lines;
  return std::vector<LineSettings>(lines.begin(), lines.end());
}

Result<std::string> set_safe(const fs::path& file) {
  const auto folder = record_folder(file);
  if (!folder) return tl::unexpected(folder.error());
  const auto driven = files::driven_lines(*folder);
  const auto lines =
      driven && *driven ? Result<std::vector<LineSettings>>(**driven) : lines_of_file(file);
  if (!lines) return tl::unexpected(lines.error());
  hal::GpioLines gpio;
  std::string text;
  std::string errors = driven ? "" : driven.error().message;
  for (const SafeOutput& output : make_safe(*lines, gpio)) {
    if (output.error.empty()) {
      text += output.name + ": inactive\n";
    } else {
      errors += (errors.empty() ? "" : "; ") + output.name + ": " + output.error;
    }
  }
  if (!errors.empty()) return fail(errors);
  files::forget_driven_lines(*folder);
  return text.empty() ? "the configuration has no output\n" : text;
}

}  // namespace

CliResult<std::string> lines_command(const Arguments& arguments) {
  std::filesystem::path config;
  bool safe = false;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch lines --safe [--config FILE]\n\n"
                "Sets the GPIO outputs that orbwatchd drove inactive and releases them, after it\n"
                "was killed. Without its record of them they are those of the configuration. The\n"
                "service runs it at its end.\n\n",
       .options = {{"safe", 0, "", "set all outputs inactive", flag_option(safe)},
                   {"config", 'c', "FILE", "that of orbwatchd (default: as orbwatchd)",
                    text_option(config)}}},
      [&](const auto&) -> CliResult<std::string> {
        if (!safe) return usage_error("say --safe");
        return set_safe(files::site_file(config));
      });
}

}  // namespace orbwatch::app::cli
