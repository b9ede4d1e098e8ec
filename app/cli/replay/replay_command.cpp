// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/replay/replay_run.h"
#include "app/ports/recorder/export/staged_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kReplayUsage =
    "Usage: orbwatch replay FILE [options]\n"
    "\n"
    "Measures all frame sets of a recording again, as fast as this computer can, with the\n"
    "configuration in the recording, and prints regions and alarms as CSV. With --compare it\n"
    "prints what differs from the recorded measurements; exit status 1: something does.\n"
    "\n";

constexpr const char* kReplayNotes =
    "\n"
    "FILE is an MCAP recording with pictures and states of the process. With --recipe a limit\n"
    "or a recipe is tried on what happened: everything else remains as recorded. No file of\n"
    "this computer takes the place of a recorded one.\n"
    "\n"
    "Lossless pictures, and those of cameras that send JPEG, give the same measurements bit by\n"
    "bit on the same kernel; for other processors set --tolerance. Of pictures that the recorder\n"
    "coded as JPEG of quality 90 or more, differences that JPEG explains are listed with jpeg in\n"
    "the last column, counted apart, and do not cause exit status 1: such as 0.25 mm or 2 %\n"
    "of a width, 2 % of full scale of a mean intensity. The state of an alarm has no such\n"
    "tolerance. The first seconds after the start of an event are\n"
    "not compared, because rates and delays of alarms need what was before; see --settle.\n"
    "hot_spot_confidence needs longer: the usual size of the hot spot before the event is not\n"
    "known. Regions that were not measured when they were recorded are not compared; an alarm\n"
    "may change a frame set earlier or later. Acknowledgements are not repeated.\n";

struct ReplayOptions {
  ReplaySettings run;
  std::filesystem::path output;
};

std::function<Result<>(const std::string&)> settle_option(std::optional<double>& target) {
  return [&target](const std::string& value) {
    return parse_number("settle", value).and_then([&](double seconds) -> Result<> {
      if (!(seconds >= 0 && seconds <= 3600)) return fail("--settle must be from 0 to 3600");
      target = seconds;
      return {};
    });
  };
}

std::vector<Option> declare(ReplayOptions& o) {
  return {
      {"recipe", 0, "OTHER",
       "recipe file in place of the recorded one; NUMBER=FILE if the\nrecording has several",
       text_option(o.run.recipe)},
      {"compare", 0, "", "print what differs from the recording", flag_option(o.run.compares)},
      {"tolerance", 0, "SHARE", "share of a value by which it may differ (default: 0)",
       number_option("tolerance", o.run.tolerance)},
      {"settle", 0, "SECONDS",
       "time at the start that is not compared (default: 2; 0 for a\nrecording from the first "
       "frame set on)",
       settle_option(o.run.settle)},
      {"output", 'o', "FILE", "file for the CSV (default: standard output)", text_option(o.output)},
  };
}

std::string sentence_of(const ReplayFigures& figures) {
  const daemon::ComparisonCounts& counts = figures.compared;
  std::string text = std::to_string(counts.differences) + " of " + std::to_string(counts.values) +
                     " values in " + std::to_string(counts.sets) + " frame sets differ";
  if (counts.of_jpeg > 0) {
    text += "; " + std::to_string(counts.of_jpeg) + " differ no more than JPEG explains";
  }
  if (counts.not_measured > 0) {
    text += "; " + std::to_string(counts.not_measured) + " regions were not measured at the time";
  }
  if (figures.without_pictures > 0) {
    text += "; " + std::to_string(figures.without_pictures) + " frame sets without pictures";
  }
  std::string separator = "; not on both sides: ";
  for (const std::string& name : counts.missing) {
    text += std::exchange(separator, ", ") + name;
  }
  return text;
}

Result<ReplayFigures> print_replay(const ReplaySettings& settings, std::ostream& csv,
                                   const std::atomic<bool>& is_cancelled) {
  Progress progress;
  auto figures = run_replay(settings, csv, progress, is_cancelled);
  csv.flush();
  if (figures && !csv) return fail("the CSV cannot be written completely");
  return figures;
}

/// True: a pipe or a device, which others read while it is written.
bool is_read_meanwhile(const std::filesystem::path& output) {
  std::error_code none;
  const auto status = std::filesystem::status(output, none);
  return std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status);
}

/// Moves the complete CSV to its place; both survive a power cut.
Result<> place_synced(std::ofstream& csv, recorder::StagedFile& staged) {
  csv.close();
  const hal::FileDescriptor file(::open(staged.path().c_str(), O_RDONLY | O_CLOEXEC));
  if (!csv || !file.is_open() || ::fsync(file.get()) != 0) {
    return fail(staged.path().string() +
                ": cannot be written: " + std::system_category().message(errno));
  }
  return staged.place();
}

/// Writes the file beside its place, and moves it there: an error or Ctrl-C leaves what was there
/// before. A link stays, and its file is replaced.
Result<ReplayFigures> replace_output(const ReplayOptions& o) {
  const std::atomic<bool>& is_cancelled = cancelled_by_signal();
  std::error_code none, error;
  const bool is_link = std::filesystem::is_symlink(o.output, none);
  const auto target = is_link ? std::filesystem::canonical(o.output, error) : o.output;
  if (error) return fail(o.output.string() + ": " + error.message());
  auto staged = recorder::StagedFile::beside(target, recorder::Existing::Replaced);
  if (!staged) return tl::unexpected(staged.error());
  std::ofstream csv(staged->path());
  if (!csv) return fail(o.output.string() + ": cannot be written");
  return print_replay(o.run, csv, is_cancelled).and_then([&](const ReplayFigures& figures) {
    return place_synced(csv, *staged).map([&] { return figures; });
  });
}

Result<ReplayFigures> write_replay(const ReplayOptions& o) {
  std::error_code none;
  if (std::filesystem::equivalent(o.run.recording, o.output, none)) {
    return fail(o.output.string() +
                ": this is the recording itself; name another file for the CSV");
  }
  if (!is_read_meanwhile(o.output)) return replace_output(o);
  std::ofstream csv(o.output);  // waits for the reader of a pipe; Ctrl-C ends the program
  if (!csv) return fail(o.output.string() + ": cannot be written");
  return print_replay(o.run, csv, cancelled_by_signal());
}

CliResult<std::string> replay(const ReplayOptions& o) {
  if (!(o.run.tolerance >= 0 && o.run.tolerance < 1)) {
    return usage_error("--tolerance must be at least 0 and below 1");
  }
  const auto figures =
      o.output.empty() ? print_replay(o.run, std::cout, cancelled_by_signal()) : write_replay(o);
  if (!figures) return tl::unexpected(figures.error());
  if (!o.run.compares) return std::string();
  const bool is_same = figures->compared.differences == 0 && figures->compared.missing.empty();
  if (figures->compared.values == 0) return fail("nothing to compare: " + sentence_of(*figures));
  if (!is_same) return fail(sentence_of(*figures));
  std::cerr << sentence_of(*figures) << '\n';
  return std::string();
}

}  // namespace

CliResult<std::string> replay_command(const Arguments& arguments) {
  ReplayOptions o;
  return run_command(
      arguments,
      {.usage = kReplayUsage, .options = declare(o), .takes_words = true, .notes = kReplayNotes},
      [&](const auto& words) -> CliResult<std::string> {
        if (words.size() != 1) return usage_error("name one recording");
        o.run.recording = words.front();
        return replay(o);
      });
}

}  // namespace orbwatch::app::cli
