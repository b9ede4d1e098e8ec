#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <vector>

#include "app/cli/camera_options.h"
#include "app/cli/command.h"
#include "app/cli/merged_view.h"
#include "app/cli/options.h"
#include "app/cli/view_options.h"
#include "app/config/camera_calibration.h"
#include "app/config/schema.h"
#include "app/pictures/picture_file.h"
#include "hal/replay/picture_decoder.h"

namespace orbwatch::app {
namespace {

constexpr const char* kUsage =
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
  bool help = false;
  std::filesystem::path output;
  std::filesystem::path camera_info;
  CameraOptions cameras;
  optics::ViewSpec view = kDefaultView;
  bool match = true;
  bool transparent = false;
  remap::Interpolation interpolation = remap::Interpolation::Area;
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
       word_option("interpolation", kInterpolations, o.interpolation)},
      {"match", 0, "photometric|none",
       "bring the cameras to the first one's exposure and\nwhite balance (default photometric)",
       word_option("match", kMatches, o.match)},
      {"camera-info", 0, "FILE", "write a perspective view's calibration: ROS camera_info YAML",
       text_option(o.camera_info)},
      {"help", 'h', "", "this text", flag_option(o.help)},
  });
  return options;
}

/// Gives the one picture that stands alone to the one camera, or sees that every camera has one.
Result<> assign_pictures(const std::vector<std::string>& alone,
                         std::vector<ChosenCamera>& cameras) {
  if (cameras.size() == 1 && cameras.front().picture.empty()) {
    if (alone.size() != 1) return fail("give exactly one picture IN; see --help");
    cameras.front().picture = alone.front();
    return {};
  }
  for (const ChosenCamera& camera : cameras) {
    if (camera.picture.empty()) {
      return fail("camera " + camera.name + " has no picture; use --camera " + camera.name + "=IN");
    }
  }
  if (!alone.empty()) return fail(alone.front() + " belongs to no camera; use --camera NAME=IN");
  return {};
}

std::string depth_and_channels(const Picture& picture) {
  return std::to_string(8 * info(picture.format).bytes_per_sample()) + " bit " +
         (info(picture.format).channels() == 1 ? "grey" : "colour");
}

Result<std::vector<hal::DecodedPicture>> read_pictures(const std::vector<ChosenCamera>& cameras) {
  std::vector<hal::DecodedPicture> pictures;
  for (const ChosenCamera& camera : cameras) {
    auto read = hal::read_picture(camera.picture);
    if (!read) return tl::unexpected(read.error());
    const Picture& picture = read->picture;
    if (auto fits = check_picture_size(camera, {picture.width, picture.height}); !fits) {
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

/// Tells the user of cameras whose exposure stays as it is.
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

Result<> write_camera_info(const ProjectOptions& o, const optics::ViewProjection& view) {
  if (o.camera_info.empty()) return {};
  const auto intrinsics = view.intrinsics();
  if (!intrinsics) return fail("--camera-info: only a perspective view has one");
  return write_calibration(o.camera_info, *intrinsics, "view", CalibrationFormat::Ros);
}

Result<> project(const ProjectOptions& o, const std::vector<std::string>& alone) {
  auto cameras = choose_cameras(o.cameras);
  if (!cameras) return tl::unexpected(cameras.error());
  if (auto assigned = assign_pictures(alone, *cameras); !assigned) return assigned;
  const auto view = optics::ViewProjection::make(o.view, cameras->front().ball);
  if (!view) return tl::unexpected(view.error());
  const auto pictures = read_pictures(*cameras);
  if (!pictures) return tl::unexpected(pictures.error());
  const PixelFormat format = pictures->front().picture.format;
  if (auto named = check_picture_name(o.output, format, o.transparent); !named) return named;

  std::vector<ViewedPicture> viewed;
  for (std::size_t n = 0; n < cameras->size(); ++n) {
    viewed.push_back({(*pictures)[n].picture, (*cameras)[n].ball});
  }
  MergedView merged = merge_pictures(*view, viewed, o.interpolation, o.match && viewed.size() > 1);
  report(merged.matches, *cameras);
  if (auto written = write_camera_info(o, *view); !written) return written;
  return write_picture(o.output, merged.picture,
                       o.transparent ? merged.validity() : ImageView<std::uint8_t>{});
}

}  // namespace

Result<> project_command(const std::vector<std::string>& arguments) {
  ProjectOptions o;
  const std::vector<Option> options = declare(o);
  const auto alone = parse_options(arguments, options);
  if (!alone) return tl::unexpected(alone.error());
  if (o.help) {
    std::cout << kUsage << options_help(options);
    return {};
  }
  if (o.output.empty()) return fail("-o OUT is missing; see --help");
  return project(o, *alone);
}

}  // namespace orbwatch::app
