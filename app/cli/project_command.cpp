#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/options/camera_options.h"
#include "app/cli/options/options.h"
#include "app/cli/options/view_options.h"
#include "app/cli/progress.h"
#include "app/files/camera_calibration.h"
#include "app/pictures/colour_maps.h"
#include "app/pictures/picture_file.h"
#include "app/pipeline/views/view_renderer.h"
#include "app/pipeline/views/view_settings.h"
#include "hal/replay/picture_decoder.h"

namespace orbwatch::app {
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
  double sharpness = kSharpness;
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
       "of 8 bit colour, " + kSharpnesses.text() + " (default 0.8); 0: pixels as they are",
       [&o](const std::string& value) {
         return parse_number("sharpness", value).and_then([&o](double sharpness) -> Result<> {
           if (!kSharpnesses.contains(sharpness)) {
             return fail("--sharpness must be " + kSharpnesses.text());
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
Result<> assign_pictures(const std::vector<std::string>& alone,
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

Result<std::vector<hal::DecodedPicture>> read_pictures(const std::vector<ChosenCamera>& cameras,
                                                       Progress& progress) {
  std::vector<hal::DecodedPicture> pictures;
  for (const ChosenCamera& camera : cameras) {
    progress.count("reading", pictures.size() + 1, cameras.size(), "pictures");
    auto read = hal::read_picture(camera.picture);
    if (!read) return tl::unexpected(read.error());
    const Picture& picture = read->picture;
    if (auto fits = check_picture_size(camera, {picture.width, picture.height}); !fits) {
      return fail(camera.picture.string() + ": " + fits.error().message + exif_note(*read));
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

/// The cameras' pictures merged by resolution, as orbwatchd does it. Owns its pixels; cannot be
/// copied, since `picture` points at them.
struct MergedView {
  MergedView(PixelFormat format, int width, int height)
      : pixels(static_cast<std::size_t>(row_bytes(format, width)) * height),
        validity(static_cast<std::size_t>(width) * height),
        picture(MutablePicture::contiguous(format, width, height, pixels.data(),
                                           row_bytes(format, width))) {}
  MergedView(const MergedView&) = delete;
  MergedView& operator=(const MergedView&) = delete;

  ImageView<std::uint8_t> validity_plane() {
    return {validity.data(), picture.width, picture.height, 1, picture.width};
  }

  std::vector<std::byte> pixels;
  std::vector<std::uint8_t> validity;  ///< one Validity per pixel
  MutablePicture picture;
};

/// Returns how the cameras' exposures were matched, nothing where they were not.
std::vector<remap::PhotometricMatch> merge(const ProjectOptions& o,
                                           const optics::ViewProjection& projection,
                                           const std::vector<ChosenCamera>& cameras,
                                           const std::vector<hal::DecodedPicture>& pictures,
                                           MergedView& merged) {
  const remap::ColourMap unused(colour_map_table("grey"), 0, 255);  // the picture keeps its format
  ViewPlan plan{0, "view", projection, {}, Combine::Sharpest, o.interpolation, std::nullopt};
  std::vector<hal::StreamFormat> formats;
  hal::FrameSet set;
  for (std::size_t n = 0; n < cameras.size(); ++n) {
    const auto frame = std::make_shared<hal::FrameBuffer>();
    frame->picture = pictures[n].picture;
    formats.push_back({frame->picture.format, {}, frame->picture.width, frame->picture.height, 0});
    plan.sources.push_back({n, formats.back(), cameras[n].ball, 1, unused, o.sharpness});
    set.frames[n] = frame;
  }
  WorkerPool workers(0);
  ViewRenderer renderer(std::move(plan));
  PictureUses uses;
  renderer.add_use(uses);
  FramePyramids pyramids(formats, uses);
  pyramids.build(set, uses, workers);
  std::vector<remap::PhotometricMatch> matches;
  if (o.match && cameras.size() > 1) matches = renderer.match_photometry(pyramids);
  renderer.render(pyramids, {merged.picture, merged.validity_plane(), {}, true}, workers);
  return matches;
}

Result<> write_camera_info(const ProjectOptions& o, const optics::ViewProjection& view) {
  if (o.camera_info.empty()) return {};
  const auto intrinsics = view.intrinsics();
  if (!intrinsics) return usage_error("--camera-info: only a perspective view has one");
  return write_calibration(o.camera_info, *intrinsics, "view", CalibrationFormat::Ros);
}

Result<> project(const ProjectOptions& o, const std::vector<std::string>& alone) {
  if (o.output.empty()) return usage_error("-o OUT is missing");
  auto cameras = choose_cameras(o.cameras);
  if (!cameras) return tl::unexpected(cameras.error());
  if (auto assigned = assign_pictures(alone, *cameras); !assigned) return assigned;
  const auto view = optics::ViewProjection::make(o.view, cameras->front().ball);
  if (!view) return tl::unexpected(view.error());
  Progress progress;
  const auto pictures = read_pictures(*cameras, progress);
  if (!pictures) return tl::unexpected(pictures.error());
  const PixelFormat format = pictures->front().picture.format;
  if (auto named = check_picture_name(o.output, format, o.transparent); !named) return named;

  MergedView merged(format, view->width(), view->height());
  progress.begin("making the view");
  const auto matches = merge(o, *view, *cameras, *pictures, merged);
  progress.erase();
  report(matches, *cameras);
  if (auto written = write_camera_info(o, *view); !written) return written;
  return write_picture(o.output, merged.picture,
                       o.transparent ? merged.validity_plane() : ImageView<std::uint8_t>{});
}

}  // namespace

Result<std::string> project_command(const std::vector<std::string>& arguments) {
  ProjectOptions o;
  return run_command(
      arguments, {.usage = kProjectUsage, .options = declare(o), .takes_words = true},
      [&](const auto& alone) { return project(o, alone).map([] { return std::string(); }); });
}

}  // namespace orbwatch::app
