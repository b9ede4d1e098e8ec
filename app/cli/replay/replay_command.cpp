// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/replay/replay_run.h"

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
    "the last column, counted apart, and are no reason for exit status 1: such as 0.25 mm or 2 %\n"
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

CliResult<std::string> replay(const ReplayOptions& o) {
  if (!(o.run.tolerance >= 0 && o.run.tolerance < 1)) {
    return usage_error("--tolerance must be at least 0 and below 1");
  }
  std::ofstream file;
  if (!o.output.empty()) file.open(o.output);
  if (!o.output.empty() && !file) return fail(o.output.string() + ": cannot be written");
  std::ostream& csv = o.output.empty() ? std::cout : file;
  Progress progress;
  const auto figures = run_replay(o.run, csv, progress);
  if (!figures) return tl::unexpected(figures.error());
  csv.flush();
  if (!csv) return fail("the CSV cannot be written completely");
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
