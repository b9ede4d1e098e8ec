// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>

#include "app/cli/command.h"
#include "app/cli/options/camera_options.h"
#include "app/cli/options/view_options.h"
#include "app/cli/text_table.h"
#include "app/model/status/json.h"
#include "app/pictures/picture_file.h"
#include "app/pipeline/views/view_settings.h"
#include "proc/image/image_view.h"
#include "proc/optics/resolution.h"
#include "proc/optics/vec.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::cli {
namespace {

/// Scale of the resolution map's picture.
constexpr double kCountsPerPixelPerDegree = 100;

constexpr const char* kDescribeViewNotes =
    "\n"
    "--json prints one object: view {kind, width, height, h_fov, v_fov (degrees; null: the "
    "projection\n"
    "ends before the edge)}, cameras [{name, pixels_per_degree {min, median, max} (null: it sees\n"
    "nothing), seen, blind, outside (shares of the view's pixels)}].\n";

struct DescribeViewOptions {
  CameraOptions cameras;
  std::optional<Size> picture_size;
  optics::ViewSpec view = kDefaultView;
  bool json = false;
  std::filesystem::path output;
};

std::vector<Option> declare(DescribeViewOptions& o) {
  std::vector<Option> options = camera_options(o.cameras);
  options.push_back({"size-of-picture", 0, "WxH", "without a rig: of the camera's picture",
                     [&o](const std::string& value) {
                       return parse_size("size-of-picture", value).map([&o](const Size& size) {
                         o.picture_size = size;
                       });
                     }});
  auto view = view_options(o.view);
  std::move(view.begin(), view.end(), std::back_inserter(options));
  options.push_back({"json", 0, "", "for programs", flag_option(o.json)});
  options.push_back({"output", 'o', "FILE.png",
                     "write the best camera's resolution as 16-bit grey\npicture, in 1/100 pixel "
                     "per degree; 0: not seen",
                     text_option(o.output)});
  return options;
}

/// Contribution of one camera to the view. Shares are of the view's pixels.
struct CameraFigures {
  std::string name;
  double seen = 0;
  double blind = 0;
  double outside = 0;
  /// Source pixels per degree within its coverage; nullopt if it covers nothing.
  struct Resolution {
    double least;
    double median;
    double most;
  };
  std::optional<Resolution> resolution;
};

std::optional<CameraFigures::Resolution> summary(std::vector<float> seen) {
  if (seen.empty()) return std::nullopt;
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  const double median = *middle;
  const auto [least, most] = std::minmax_element(seen.begin(), seen.end());
  return CameraFigures::Resolution{*least, median, *most};
}

CameraFigures figures_of(const ChosenCamera& camera, const optics::ViewProjection& view,
                         const Size& picture, const std::vector<float>& map) {
  const remap::CoordinateGrid grid(view, camera.ball, picture.width, picture.height);
  std::vector<std::uint8_t> validity(map.size());
  grid.write_validity({validity.data(), view.width(), view.height(), 1, view.width()});
  const auto share = [&](Validity value) {
    const auto count =
        std::count(validity.begin(), validity.end(), static_cast<std::uint8_t>(value));
    return static_cast<double>(count) / static_cast<double>(validity.size());
  };
  std::vector<float> seen;
  std::copy_if(map.begin(), map.end(), std::back_inserter(seen), [](float r) { return r > 0; });
  return {camera.name, share(Validity::Seen), share(Validity::Blind), share(Validity::Outside),
          summary(std::move(seen))};
}

/// Field of view from edge to edge through the middle, degrees; nullopt if the projection ends
/// before the edge.
struct Fov {
  std::optional<double> horizontal;
  std::optional<double> vertical;
};

Fov fov_of(const optics::ViewProjection& view) {
  const double u = (view.width() - 1) / 2.0, v = (view.height() - 1) / 2.0;
  const auto middle = view.direction(u, v);
  const auto span = [&](const std::optional<optics::Vec3>& a,
                        const std::optional<optics::Vec3>& b) -> std::optional<double> {
    if (!middle || !a || !b) return std::nullopt;
    return optics::degrees(optics::angle_between(*a, *middle) + optics::angle_between(*middle, *b));
  };
  return {span(view.direction(-0.5, v), view.direction(view.width() - 0.5, v)),
          span(view.direction(u, -0.5), view.direction(u, view.height() - 0.5))};
}

std::string angle_text(const std::optional<double>& degrees) {
  return degrees ? fixed_text(*degrees, 2) : kNoValue;
}

std::string markdown(const optics::ViewProjection& view,
                     const std::vector<CameraFigures>& cameras) {
  const Fov fov = fov_of(view);
  std::ostringstream out;
  out << "View: " << word_for(pipeline::kViewKinds, view.kind()) << ", " << view.width() << "x"
      << view.height() << " px, h_fov " << angle_text(fov.horizontal) << ", v_fov "
      << angle_text(fov.vertical) << " deg\n\n"
      << "Source pixels per degree where the camera sees, and shares of the view's pixels:\n\n"
      << "| camera | min | median | max | seen | blind | outside |\n"
      << "|---|---|---|---|---|---|---|\n";
  for (const CameraFigures& c : cameras) {
    out << "| " << c.name << " | ";
    if (const auto& r = c.resolution) {
      out << fixed_text(r->least, 2) << " | " << fixed_text(r->median, 2) << " | "
          << fixed_text(r->most, 2);
    } else {
      out << "- | - | -";
    }
    for (const double share : {c.seen, c.blind, c.outside}) {
      out << " | " << fixed_text(100 * share, 1) << " %";
    }
    out << " |\n";
  }
  return out.str();
}

std::string json(const optics::ViewProjection& view, const std::vector<CameraFigures>& cameras) {
  using Json = nlohmann::ordered_json;
  const Fov fov = fov_of(view);
  const auto optional = [](const std::optional<double>& value) {
    return value ? to_json(*value) : Json();
  };
  Json all{{"view",
            {{"kind", word_for(pipeline::kViewKinds, view.kind())},
             {"width", view.width()},
             {"height", view.height()},
             {"h_fov", optional(fov.horizontal)},
             {"v_fov", optional(fov.vertical)}}},
           {"cameras", Json::array()}};
  for (const CameraFigures& c : cameras) {
    Json resolution;
    if (const auto& r = c.resolution) {
      resolution = {{"min", r->least}, {"median", r->median}, {"max", r->most}};
    }
    all["cameras"].push_back({{"name", c.name},
                              {"pixels_per_degree", resolution},
                              {"seen", c.seen},
                              {"blind", c.blind},
                              {"outside", c.outside}});
  }
  return all.dump(2) + "\n";
}

Result<> write_map(const std::filesystem::path& path, const std::vector<float>& map,
                   const optics::ViewProjection& view) {
  std::vector<std::uint16_t> counts;
  counts.reserve(map.size());
  for (const float resolution : map) {
    counts.push_back(static_cast<std::uint16_t>(
        std::lround(std::min(kCountsPerPixelPerDegree * resolution, 65535.0))));
  }
  return write_picture(path, Picture::contiguous(PixelFormat::Y16, view.width(), view.height(),
                                                 reinterpret_cast<const std::byte*>(counts.data()),
                                                 row_bytes(PixelFormat::Y16, view.width())));
}

/// Size of a camera's pictures, stated by the rig or by an option.
CliResult<Size> picture_size(const ChosenCamera& camera, const DescribeViewOptions& o) {
  if (const auto& known = camera.rig_camera) return Size{known->width, known->height};
  if (!o.picture_size) return usage_error("--size-of-picture is missing");
  const Size size = *o.picture_size;
  const auto checked = optics::check_outline(*camera.outline, size.width, size.height);
  if (!checked) return tl::unexpected(checked.error());
  return size;
}

CliResult<std::string> describe(const DescribeViewOptions& o) {
  const auto cameras = choose_cameras(o.cameras);
  if (!cameras) return tl::unexpected(cameras.error());
  const auto view = optics::ViewProjection::make(o.view, cameras->front().ball);
  if (!view) return tl::unexpected(view.error());
  if (!o.output.empty()) {
    if (auto named = check_picture_name(o.output, PixelFormat::Y16, false); !named)
      return tl::unexpected(named.error());
  }
  std::vector<CameraFigures> figures;
  std::vector<float> best(static_cast<std::size_t>(view->width()) * view->height());
  for (const ChosenCamera& camera : *cameras) {
    if (!camera.picture.empty())
      return usage_error("--camera takes no picture here; give its name alone");
    const auto size = picture_size(camera, o);
    if (!size) return tl::unexpected(size.error());
    const auto map = optics::resolution_map(*view, camera.ball, size->width, size->height);
    figures.push_back(figures_of(camera, *view, *size, map));
    std::transform(best.begin(), best.end(), map.begin(), best.begin(),
                   [](float a, float b) { return std::max(a, b); });
  }
  if (!o.output.empty()) {
    if (auto written = write_map(o.output, best, *view); !written)
      return tl::unexpected(written.error());
  }
  return o.json ? json(*view, figures) : markdown(*view, figures);
}

}  // namespace

CliResult<std::string> describe_view(const Arguments& arguments) {
  DescribeViewOptions o;
  return run_command(
      arguments,
      {.usage =
           "Usage: orbwatch describe view --rig RIG --camera NAME [--camera NAME ...] [options]\n"
           "       orbwatch describe view --ball CX,CY,R --size-of-picture WxH\n"
           "                (--alpha DEG | --distance RADII) [options]\n\n"
           "Prints how many of a camera's pixels a degree of the view really has.\n\n",
       .options = declare(o),
       .notes = kDescribeViewNotes},
      [&](const auto&) { return describe(o); });
}

}  // namespace orbwatch::app::cli
