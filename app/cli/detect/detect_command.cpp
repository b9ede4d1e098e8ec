// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>

#include "app/cli/command.h"
#include "app/cli/detect/detect_text.h"
#include "app/cli/detect/overlay.h"
#include "app/cli/options/options.h"
#include "app/cli/progress.h"
#include "app/files/rig/camera_calibration.h"
#include "app/pictures/picture_file.h"
#include "hal/replay/picture_decoder.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kDetectUsage =
    "Usage: orbwatch detect IMAGE [options]\n"
    "\n"
    "Finds the mirror ball in a picture: the outline of its limb, also where the picture cuts it.\n"
    "IMAGE is a JPEG or PNG, 8 or 16 bit, grey, colour or thermal.\n"
    "\n";

constexpr const char* kDetectNotes =
    "\n"
    "Pixels have their centres at integers. A confidence of 0.5 or more is seldom wrong; below, "
    "the\n"
    "reason is said, and --overlay shows whether the outline is right. Domes and other bulging\n"
    "mirrors look like a ball.\n"
    "\n"
    "--json prints one object: picture {width, height}, outline {centre [u, v], radii [rx, ry] in\n"
    "pixels, angle of rx from u towards v in degrees}, confidence [0, 1], confident, reason "
    "(empty\n"
    "when confident), and with --calibration ball {centre [x, y, z] in the camera frame, "
    "distance,\n"
    "both in ball radii, alpha in degrees}.\n";

struct DetectOptions {
  bool json = false;
  std::filesystem::path overlay;
  std::filesystem::path calibration;
};

std::vector<Option> declare(DetectOptions& o) {
  return {
      {"json", 0, "", "for programs", flag_option(o.json)},
      {"overlay", 0, "OUT", "picture to write: IMAGE with the outline drawn into it",
       text_option(o.overlay)},
      {"calibration", 0, "FILE",
       "of the camera, as OpenCV or ROS write it: tells where the\nball is",
       text_option(o.calibration)},
  };
}

/// The ball's place, from the lens that a calibration file states.
/// `size_note`: see hal::exif_note().
Result<optics::BallSight> sight(const std::filesystem::path& calibration, const DetectedBall& ball,
                                const std::string& size_note) {
  files::TextFiles files;
  const auto intrinsics = read_calibration(calibration, files);
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  if (intrinsics->width != ball.width || intrinsics->height != ball.height) {
    return fail(calibration.string() + " is for pictures of " + std::to_string(intrinsics->width) +
                "x" + std::to_string(intrinsics->height) + ", this one has " +
                std::to_string(ball.width) + "x" + std::to_string(ball.height) + size_note);
  }
  const auto lens = optics::Lens::make(*intrinsics);
  if (!lens) return tl::unexpected(lens.error());
  return optics::sight_from_outline(ball.detection.outline, *lens);
}

Result<std::string> detect(const DetectOptions& o, const std::filesystem::path& file) {
  const auto decoded = hal::read_picture(file);
  if (!decoded) return tl::unexpected(decoded.error());
  const Picture& picture = decoded->picture;
  if (!o.overlay.empty()) {
    const auto named = check_picture_name(o.overlay, PixelFormat::Rgb, false);
    if (!named) return tl::unexpected(named.error());
  }
  Progress progress;
  progress.begin("looking for the ball in " + file.filename().string());
  const auto detection = align::detect_ball(picture);
  progress.erase();
  if (!detection) return fail(file.string() + ": " + detection.error().message);
  DetectedBall ball{picture.width, picture.height, *detection, std::nullopt};
  if (!o.calibration.empty()) {
    const auto place = sight(o.calibration, ball, exif_note(*decoded));
    if (!place) return tl::unexpected(place.error());
    ball.sight = *place;
  }
  if (!o.overlay.empty()) {
    const auto written = write_overlay(o.overlay, picture, ball.detection.outline);
    if (!written) return tl::unexpected(written.error());
  }
  return o.json ? detect_json(ball) : detect_text(ball);
}

}  // namespace

CliResult<std::string> detect_command(const Arguments& arguments) {
  DetectOptions o;
  return run_command(
      arguments,
      {.usage = kDetectUsage, .options = declare(o), .takes_words = true, .notes = kDetectNotes},
      [&](const auto& words) -> CliResult<std::string> {
        if (words.size() == 1) return detect(o, words.front());
        return usage_error("name one picture");
      });
}

}  // namespace orbwatch::app::cli
