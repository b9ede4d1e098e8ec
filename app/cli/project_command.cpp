#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/options.h"
#include "app/config/schema.h"
#include "app/pictures/picture_file.h"
#include "hal/replay/picture_decoder.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

constexpr const char* kUsage =
    "Usage: orbwatch project IN -o OUT --ball CX,CY,R (--alpha DEG | --distance RADII) [options]\n"
    "\n"
    "Turns the picture of a mirror ball into the view of a virtual camera in the ball's centre.\n"
    "IN is a JPEG or PNG, 8 or 16 bit, grey or colour; OUT a .png, .jpg or .jpeg.\n"
    "Without a rotation, yaw 0 looks back at the camera, positive yaw to the right of that view;\n"
    "the direction behind the ball (yaw 180) is blind.\n"
    "\n";

struct ProjectOptions {
  bool help = false;
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<optics::Outline> ball;
  std::optional<double> alpha;
  std::optional<double> distance;
  optics::BallModel::Kind model = optics::BallModel::Kind::Exact;
  optics::ViewSpec view{optics::ViewKind::Perspective, {}, {}, {}, 1280, 720};
  optics::YawPitchRoll rotation;
  bool transparent = false;
  remap::Interpolation interpolation = remap::Interpolation::Bilinear;
};

/// set() for an option that is one of some words.
template <class T, std::size_t N>
auto word_option(const char* name, const std::array<Word<T>, N>& words, T& target) {
  return [name, &words, &target](const std::string& value) -> Result<> {
    if (const T* found = find_word(words, value)) {
      target = *found;
      return {};
    }
    return fail("--" + std::string(name) + " is \"" + value + "\"; use one of: " + joined(words));
  };
}

Result<> set_ball(const std::string& value, std::optional<optics::Outline>& ball) {
  const auto n = parse_numbers("ball", value);
  if (!n) return tl::unexpected(n.error());
  if (n->size() == 3) {
    ball = optics::Outline{{(*n)[0], (*n)[1]}, (*n)[2], (*n)[2], 0};
  } else if (n->size() == 5) {
    ball = optics::Outline{{(*n)[0], (*n)[1]}, (*n)[2], (*n)[3], (*n)[4]};
  } else {
    return fail("--ball is \"" + value + "\"; it must be CX,CY,R or CX,CY,RX,RY,ANGLE");
  }
  return {};
}

Result<> set_size(const std::string& value, optics::ViewSpec& view) {
  const std::size_t cross = value.find('x');
  const auto width = parse_whole("size", value.substr(0, cross));
  const auto height =
      parse_whole("size", cross == std::string::npos ? "" : value.substr(cross + 1));
  if (!width || !height) return fail("--size is \"" + value + "\"; it must be WxH, like 1280x720");
  view.width = *width;
  view.height = *height;
  return {};
}

Result<> set_rotation(const std::string& value, optics::YawPitchRoll& rotation) {
  const auto n = parse_numbers("rotation", value);
  if (!n) return tl::unexpected(n.error());
  if (n->size() != 3) return fail("--rotation is \"" + value + "\"; it must be YAW,PITCH,ROLL");
  rotation = {(*n)[0], (*n)[1], (*n)[2]};
  return {};
}

std::vector<Option> declare(ProjectOptions& o) {
  static constexpr std::array kUndefined{Word{"black", false}, Word{"transparent", true}};
  return {
      {"output", 'o', "OUT", "picture to write",
       [&o](const std::string& v) -> Result<> {
         o.output = v;
         return {};
       }},
      {"ball", 0, "CX,CY,R | CX,CY,RX,RY,ANGLE",
       "limb of the ball in IN, pixels (centres at integers);\nANGLE in degrees turns RX from "
       "right to down",
       [&o](const std::string& v) { return set_ball(v, o.ball); }},
      {"alpha", 0, "DEG",
       "reflected field of view, above 180 to 360:\n360 minus the ball's apparent diameter",
       number_option("alpha", o.alpha)},
      {"distance", 0, "RADII", "camera to ball's centre in ball radii, above 1",
       number_option("distance", o.distance)},
      {"model", 0, "MODEL",
       "exact (default), paper, or classical, which takes\nneither alpha nor distance",
       word_option("model", kModels, o.model)},
      {"view", 0, "KIND", "perspective (default) or equirectangular",
       word_option("view", kViewKinds, o.view.kind)},
      {"yaw", 0, "DEG", "of the view, positive to the right",
       number_option("yaw", o.view.orientation.yaw)},
      {"pitch", 0, "DEG", "positive up", number_option("pitch", o.view.orientation.pitch)},
      {"roll", 0, "DEG", "positive: the right side dips",
       number_option("roll", o.view.orientation.roll)},
      {"h-fov", 0, "DEG",
       "edge to edge; perspective below 180 (default 90),\nequirectangular to 360 (default)",
       number_option("h-fov", o.view.h_fov)},
      {"v-fov", 0, "DEG", "default: square pixels, or 180 for equirectangular",
       number_option("v-fov", o.view.v_fov)},
      {"size", 0, "WxH", "of OUT, 1x1 to 16384x16384 (default 1280x720)",
       [&o](const std::string& v) { return set_size(v, o.view); }},
      {"rotation", 0, "YAW,PITCH,ROLL",
       "registration: turns the ball's picture into the\nreference frame",
       [&o](const std::string& v) { return set_rotation(v, o.rotation); }},
      {"undefined", 0, "black|transparent", "what the ball does not show (default black)",
       word_option("undefined", kUndefined, o.transparent)},
      {"interpolation", 0, "bilinear|nearest", "between pixels (default bilinear)",
       word_option("interpolation", kInterpolations, o.interpolation)},
      {"help", 'h', "", "this text",
       [&o](const std::string&) -> Result<> {
         o.help = true;
         return {};
       }},
  };
}

/// A picture in memory of its own, of the format that remapping `source` yields.
struct Canvas {
  Canvas(const Picture& source, int width, int height)
      : bytes(static_cast<std::size_t>(row_bytes(source.format, width)) * height),
        picture{source.format, source.colour_space, width,
                height,        bytes.data(),        row_bytes(source.format, width)} {}

  template <class T>
  ImageView<T> samples() {
    const int channels = info(picture.format).channels;
    return {reinterpret_cast<T*>(bytes.data()), picture.width, picture.height, channels,
            static_cast<std::ptrdiff_t>(picture.width) * channels};
  }

  std::vector<std::byte> bytes;
  Picture picture;
};

Result<> project(const ProjectOptions& o) {
  const auto model = optics::BallModel::make(o.model, o.alpha, o.distance);
  if (!model) return tl::unexpected(model.error());
  const auto view = optics::ViewProjection::make(o.view);
  if (!view) return tl::unexpected(view.error());
  const auto ball = optics::BallProjection::make(*model, *o.ball, optics::rotation(o.rotation));
  if (!ball) return tl::unexpected(ball.error());
  const auto source = hal::read_picture(o.input);
  if (!source) return tl::unexpected(source.error());
  const Picture& in = source->picture;
  if (auto placed = optics::check_outline(*o.ball, in.width, in.height); !placed) {
    return fail(o.input.string() + ": " + placed.error().message);
  }
  if (auto named = check_picture_name(o.output, in.format, o.transparent); !named) return named;

  const remap::CoordinateGrid grid(*view, *ball, in.width, in.height);
  Canvas out(in, o.view.width, o.view.height);
  const remap::TileRows rows{0, grid.tiles_y()};
  if (info(in.format).bytes_per_sample == 2) {
    remap::remap(grid, in, o.interpolation, out.samples<std::uint16_t>(), rows);
  } else {
    remap::remap(grid, in, o.interpolation, out.samples<std::uint8_t>(), rows);
  }
  if (!o.transparent) return write_picture(o.output, out.picture);
  Canvas validity(Picture{}, o.view.width, o.view.height);
  grid.write_validity(validity.samples<std::uint8_t>());
  return write_picture(o.output, out.picture, validity.samples<std::uint8_t>());
}

}  // namespace

Result<> project_command(const std::vector<std::string>& arguments) {
  ProjectOptions o;
  const std::vector<Option> options = declare(o);
  const auto rest = parse_options(arguments, options);
  if (!rest) return tl::unexpected(rest.error());
  if (o.help) {
    std::cout << kUsage << options_help(options);
    return {};
  }
  if (rest->size() != 1) return fail("give exactly one picture IN; see --help");
  if (o.output.empty()) return fail("-o OUT is missing; see --help");
  if (!o.ball) return fail("--ball is missing; see --help");
  o.input = rest->front();
  return project(o);
}

}  // namespace orbwatch::app
