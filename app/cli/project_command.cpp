// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "app/alignment/picture_size.h"
#include "app/cli/command.h"
#include "app/cli/options/camera_options.h"
#include "app/cli/options/options.h"
#include "app/cli/options/view_options.h"
#include "app/cli/progress.h"
#include "app/files/rig/camera_calibration.h"
#include "app/pictures/picture_file.h"
#include "app/pipeline/views/still_view.h"
#include "app/pipeline/views/view_settings.h"
#include "hal/replay/picture_decoder.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kProjectUsage =
    "Usage: orbwatch project IN -o OUT --ball CX,CY,R (--alpha DEG | --distance RADII) [options]\n"
    "       orbwatch project IN -o OUT --rig RIG --camera NAME [options]\n"
    "       orbwatch project -o OUT --rig RIG --camera NAME=IN [--camera NAME=IN ...] [options]\n"
    "\n"
    "Turns pictures of a mirror ball into the view of a virtual camera in the ball's centre.\n"
    "Several cameras are merged by resolution: one fills the other's blind cone.\n"
    "IN is a JPEG or PNG, 8 or 16 bit, grey or colour; OUT a .png, .jpg or .jpeg.\n"
    "Without a rig and a rotation, yaw 0 looks back at the camera, positive yaw to the right of\n"
    "that view; the direction behind the ball (yaw 180) is blind.\n"
    "\n";

struct ProjectOptions {
  std::filesystem::path output;
  std::filesystem::path camera_info;
  CameraOptions cameras;
  optics::ViewSpec view = kDefaultView;
  bool match = true;
  bool transparent = false;
  remap::Interpolation interpolation = remap::Interpolation::Area;
  double sharpness = pipeline::kSharpness;
};

std::vector<Option> declare(ProjectOptions& o) {
  static constexpr std::array kUndefined{Word{"black", false}, Word{"transparent", true}};
  static constexpr std::array kMatches{Word{"photometric", true}, Word{"none", false}};
  std::vector<Option> options{
      {"output", 'o', "OUT", "picture to write", text_option(o.output)},
  };
  const auto append = [&options](std::vector<Option> more) {
    options.insert(options.end(), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
  };
  append(camera_options(o.cameras));
  append(view_options(o.view));
  append({
      {"undefined", 0, "black|transparent", "what no camera shows (default black)",
       word_option("undefined", kUndefined, o.transparent)},
      {"interpolation", 0, "area|bilinear|nearest", "between pixels (default area)",
       word_option("interpolation", remap::kInterpolations, o.interpolation)},
      {"sharpness", 0, "S",
       "of 8 bit colour, " + pipeline::kSharpnesses.text() +
           " (default 0.8); 0: pixels as they are",
       [&o](const std::string& value) {
         return parse_number("sharpness", value).and_then([&o](double sharpness) -> Result<> {
           if (!pipeline::kSharpnesses.contains(sharpness)) {
             return fail("--sharpness must be " + pipeline::kSharpnesses.text());
           }
           o.sharpness = sharpness;
           return {};
         });
       }},
      {"match", 0, "photometric|none",
       "bring the cameras to the first one's exposure and\nwhite balance (default photometric)",
       word_option("match", kMatches, o.match)},
      {"camera-info", 0, "FILE", "write a perspective view's calibration: ROS camera_info YAML",
       text_option(o.camera_info)},
  });
  return options;
}

/// Assigns a lone picture to the only camera, or checks that every camera has a picture.
CliResult<> assign_pictures(const std::vector<std::string>& alone,
                            std::vector<ChosenCamera>& cameras) {
  if (cameras.size() == 1 && cameras.front().picture.empty()) {
    if (alone.size() != 1) return usage_error("give exactly one picture IN");
    cameras.front().picture = alone.front();
    return {};
  }
  for (const ChosenCamera& camera : cameras) {
    if (camera.picture.empty()) {
      return usage_error("camera " + camera.name + " has no picture; use --camera " + camera.name +
                         "=IN");
    }
  }
  if (!alone.empty())
    return usage_error(alone.front() + " belongs to no camera; use --camera NAME=IN");
  return {};
}

std::string depth_and_channels(const Picture& picture) {
  return std::to_string(8 * info(picture.format).bytes_per_sample()) + " bit " +
         (info(picture.format).channels() == 1 ? "grey" : "colour");
}

/// Error: the picture does not have the rig's size, or does not contain the ball.
Result<> check_picture(const ChosenCamera& camera, const hal::DecodedPicture& decoded) {
  if (camera.rig_camera) return check_picture_size(decoded, *camera.rig_camera);
  const Picture& picture = decoded.picture;
  return optics::check_outline(*camera.outline, picture.width, picture.height)
      .map_error([&](const Error& error) { return Error{error.message + exif_note(decoded)}; });
}

Result<std::vector<hal::DecodedPicture>> read_pictures(const std::vector<ChosenCamera>& cameras,
                                                       Progress& progress) {
  std::vector<hal::DecodedPicture> pictures;
  for (const ChosenCamera& camera : cameras) {
    progress.count("reading", pictures.size() + 1, cameras.size(), "pictures");
    auto read = hal::read_picture(camera.picture);
    if (!read) return tl::unexpected(read.error());
    const Picture& picture = read->picture;
    if (auto fits = check_picture(camera, *read); !fits) {
      return fail(camera.picture.string() + ": " + fits.error().message);
    }
    pictures.push_back(std::move(*read));
    const Picture& first = pictures.front().picture;
    if (picture.format != first.format) {
      return fail(camera.picture.string() + " has " + depth_and_channels(picture) + ", " +
                  cameras.front().picture.string() + " " + depth_and_channels(first) +
                  "; cameras that are merged must be alike");
    }
  }
  return pictures;
}

/// Warns of cameras whose exposure stays as it is.
void report(const std::vector<remap::PhotometricMatch>& matches,
            const std::vector<ChosenCamera>& cameras) {
  using Outcome = remap::PhotometricMatch::Outcome;
  for (std::size_t n = 0; n < matches.size(); ++n) {
    const Outcome outcome = matches[n].outcome;
    if (outcome == Outcome::Reference || outcome == Outcome::Matched) continue;
    std::fprintf(stderr, "orbwatch: note: camera %s is not matched in exposure: %s\n",
                 cameras[n].name.c_str(),
                 outcome == Outcome::TooLittle
                     ? "it shares too little with the others"
                     : "it differs from the others more than exposures do");
  }
}

/// The cameras' pictures merged by resolution, as orbwatchd does it.
pipeline::StillView merged(const ProjectOptions& o, const optics::ViewProjection& projection,
                           const std::vector<ChosenCamera>& cameras,
                           const std::vector<hal::DecodedPicture>& pictures) {
  std::vector<pipeline::StillSource> sources;
  for (std::size_t n = 0; n < cameras.size(); ++n) {
    sources.push_back({pictures[n].picture, cameras[n].ball, o.sharpness});
  }
  const PixelFormat format = pictures.front().picture.format;
  return render_once({projection, format, pipeline::Combine::Sharpest, o.interpolation, o.match},
                     sources);
}

CliResult<> write_camera_info(const ProjectOptions& o, const optics::ViewProjection& view) {
  if (o.camera_info.empty()) return {};
  const auto intrinsics = view.intrinsics();
  if (!intrinsics) return usage_error("--camera-info: only a perspective view has one");
  const auto written =
      write_calibration(o.camera_info, *intrinsics, "view", files::CalibrationFormat::Ros);
  if (!written) return tl::unexpected(written.error());
  return {};
}

CliResult<std::string> project(const ProjectOptions& o, const std::vector<std::string>& alone) {
  if (o.output.empty()) return usage_error("-o OUT is missing");
  auto cameras = choose_cameras(o.cameras);
  if (!cameras) return tl::unexpected(cameras.error());
  if (auto assigned = assign_pictures(alone, *cameras); !assigned) {
    return tl::unexpected(assigned.error());
  }
  const auto view = optics::ViewProjection::make(o.view, cameras->front().ball);
  if (!view) return tl::unexpected(view.error());
  Progress progress;
  const auto pictures = read_pictures(*cameras, progress);
  if (!pictures) return tl::unexpected(pictures.error());
  const PixelFormat format = pictures->front().picture.format;
  if (auto named = check_picture_name(o.output, format, o.transparent); !named) {
    return tl::unexpected(named.error());
  }

  progress.begin("making the view");
  pipeline::StillView still = merged(o, *view, *cameras, *pictures);
  progress.erase();
  report(still.matches, *cameras);
  if (auto written = write_camera_info(o, *view); !written) {
    return tl::unexpected(written.error());
  }
  return write_picture(o.output, still.picture,
                       o.transparent ? still.validity_plane() : ImageView<std::uint8_t>{})
      .map([] { return std::string(); });
}

}  // namespace

CliResult<std::string> project_command(const Arguments& arguments) {
  ProjectOptions o;
  return run_command(arguments,
                     {.usage = kProjectUsage, .options = declare(o), .takes_words = true},
                     [&](const auto& alone) { return project(o, alone); });
}

}  // namespace orbwatch::app::cli
