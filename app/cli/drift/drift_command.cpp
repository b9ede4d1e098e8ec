// SPDX-License-Identifier: Apache-2.0
#include "app/cli/command.h"
#include "app/cli/drift/drift_run.h"
#include "app/cli/drift/drift_text.h"
#include "app/cli/options/camera_options.h"
#include "app/cli/options/options.h"
#include "app/files/rig/rig_file.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kDriftUsage =
    "Usage: orbwatch drift --rig RIG CAMERA=PATH [options]\n"
    "\n"
    "Says whether a camera or the ball has moved against the rig file: how far the ball's picture\n"
    "moved, and by how much the directions of the camera's views are wrong for it. PATH is a\n"
    "folder of the camera's pictures, JPEG or PNG, in the order of their names, or a recording\n"
    "(.mcap) with pictures of the camera, which has their times.\n"
    "\n";

constexpr const char* kDriftNotes =
    "\n"
    "The direction error is the rms over all directions up to 150 degrees from the one towards "
    "the\n"
    "camera, of the last 0.8 s (up to 2.4 s for a ball of less than 300 px radius); a jump counts\n"
    "in its own picture. Without --reference the zero is learnt first: the ball's mean place in\n"
    "the first 2.4 s, in 12 pictures at least. Drift is not measured meanwhile; a jump ends it.\n"
    "Pictures that are too dark, overexposed, or show another scene are not measured.\n"
    "\n"
    "--json prints one object about the sequence's end: frames, measured, not_measured {reason:\n"
    "pictures}, state (not measured, good, warning, alarm), reason (if not measured; the figures\n"
    "are those measured last then),\n"
    "first_warning_frame (or alarm) and first_alarm_frame (from 0; null: none), shift {u, v, "
    "radius}\n"
    "(pixels), shift_percent {centre, radius} (of the radius), roll (degrees), "
    "direction_error_deg,\n"
    "direction_sigma_deg (its standard deviation), cause (unknown, the camera turned, the ball\n"
    "moved), outline {centre [u, v], radii [rx, ry], angle}: the corrected one, and turn when a\n"
    "camera with intrinsics turned: 3x3, x_camera = turn rotation (X - position) now.\n";

struct DriftOptions {
  std::filesystem::path rig;
  DriftSequence sequence;
  align::DriftLimits limits;
  bool json = false;
};

std::vector<Option> declare(DriftOptions& o) {
  return {
      {"rig", 0, "RIG", "the rig file", text_option(o.rig)},
      {"rate", 0, "FPS", "pictures per second of a folder (default: 30)",
       number_option("rate", o.sequence.rate)},
      {"reference", 0, "IMAGE",
       "picture on which the rig's alignment was made\n(default: the first pictures of PATH)",
       text_option(o.sequence.reference)},
      {"warning", 0, "DEG", "limit of the direction error (default: 0.3)",
       number_option("warning", o.limits.warning)},
      {"alarm", 0, "DEG", "limit of the direction error (default: 0.6)",
       number_option("alarm", o.limits.alarm)},
      {"json", 0, "", "for programs", flag_option(o.json)},
  };
}

CliResult<std::string> drift(DriftOptions o, const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals + 1 == word.size()) {
    return usage_error("\"" + word + "\" must be CAMERA=PATH");
  }
  o.sequence.source = word.substr(equals + 1);
  o.sequence.camera = word.substr(0, equals);
  if (o.rig.empty()) return usage_error("--rig is missing");
  if (!(o.sequence.rate > 0)) return usage_error("--rate must be above 0");
  const auto rig = files::load_rig(o.rig);
  if (!rig) return tl::unexpected(rig.error());
  const auto camera = find_camera(*rig, o.sequence.camera);
  if (!camera) return fail(o.rig.string() + ": " + camera.error().message);
  const auto subject = align::drift_subject(*rig, *camera);
  if (!subject) return fail(o.rig.string() + ": " + subject.error().message);
  Progress progress;
  const auto run = watch(*subject, o.limits, o.sequence, progress);
  if (!run) return tl::unexpected(run.error());
  return o.json ? drift_json(*run, subject->outline) : drift_text(*run, subject->outline);
}

}  // namespace

CliResult<std::string> drift_command(const Arguments& arguments) {
  DriftOptions o;
  return run_command(
      arguments,
      {.usage = kDriftUsage, .options = declare(o), .takes_words = true, .notes = kDriftNotes},
      [&](const auto& words) -> CliResult<std::string> {
        if (words.size() == 1) return drift(o, words.front());
        return usage_error("name one CAMERA=PATH");
      });
}

}  // namespace orbwatch::app::cli
