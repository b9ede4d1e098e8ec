// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/progress.h"
#include "app/cli/setup/setup.h"
#include "app/cli/setup/setup_options.h"
#include "app/cli/setup/setup_text.h"
#include "app/cli/setup/site_files.h"
#include "app/daemon/site/cameras.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kSetupUsage =
    "Usage: orbwatch setup -o DIR --ball-diameter MM [options]\n"
    "\n"
    "Writes a site, a rig and a recipe for the cameras that are connected, or for pictures: finds\n"
    "the ball in each, registers the cameras to the first one, and checks what it wrote. Says "
    "what\n"
    "it could not find out, and which command adds it.\n"
    "\n";

constexpr const char* kSetupNotes =
    "\n"
    "SOURCE is a device, a camera's id of `orbwatch list`, a folder of pictures, a picture, a\n"
    "video, or a recording (.mcap) with pictures of NAME. NAME= may be left out where there is\n"
    "one camera. A process that runs while several cameras are recorded registers them by its\n"
    "light: sparks and melt pool.\n"
    "\n"
    "DIR gets site.toml, rig.toml, recipe.toml, and for each camera NAME.png, in which the "
    "outline\n"
    "is drawn, and NAME.yaml, its calibration. `sudo orbwatch configure DIR/site.toml`\n"
    "tries it in the installed service; without one `orbwatchd --config DIR/site.toml` runs it.\n"
    "\n"
    "The page is at http://localhost:8080/. With --page network it is also at https://HOST:8443/, "
    "for\n"
    "other computers; until a password is set, they may only set it, with the code that\n"
    "`orbwatch password --show` prints.\n"
    "\n"
    "--json prints one object: site (its file), cameras [{name, outline {centre [u, v], radii [rx, "
    "ry]\n"
    "in pixels, angle in degrees}, confidence [0, 1], registered, pose_change (degrees)}], "
    "left_out "
    "[name]\n"
    "of merged and measured views, missing [text].\n"
    "\n"
    "A matrix in --pose that is rounded to four decimals is replaced by the nearest rotation; "
    "pose_change\n"
    "is the largest angle between its axes and those stated.\n"
    "\n"
    "Exit status 1, with the files written: a camera is not registered, and left out until it "
    "is.\n";

/// Enough light of a process to register by, at any usual rate within the patience.
constexpr std::size_t kPictures = 24;
constexpr std::chrono::seconds kPatience{10};

Result<std::vector<CameraSource>> sources(const SetupOptions& o) {
  if (o.cameras.empty()) return connected_cameras();
  std::vector<CameraSource> sources;
  for (const std::string& word : o.cameras) {
    auto source = camera_source(word);
    if (!source) return tl::unexpected(source.error());
    sources.push_back(std::move(*source));
  }
  return sources;
}

/// A camera's name by what it sees, unless it has one.
std::string name_of(const CameraSource& source, const CameraRecord& record, const Setup& setup) {
  if (!source.name.empty()) return source.name;
  const PixelFormatInfo& facts = info(record.format.format);
  const std::string kind = record.format.format == PixelFormat::Y16 ? "thermal"
                           : facts.colour == ColourModel::Luminance ? "grey"
                                                                    : "colour";
  std::string name = kind;
  for (int n = 2; std::ranges::count(setup.cameras, name, &SetupCamera::name) > 0; ++n) {
    name = kind + std::to_string(n);
  }
  return name;
}

Result<> record_cameras(const SetupOptions& o, Setup& setup, Progress& progress) {
  auto found = sources(o);
  if (!found) return tl::unexpected(found.error());
  std::vector<std::unique_ptr<hal::Camera>> cameras;
  for (const CameraSource& source : *found) {
    files::CameraSettings settings;
    settings.name = source.name.empty() ? "camera" : source.name;
    settings.back_end = source.back_end;
    cameras.push_back(daemon::make_camera(settings, nullptr));
  }
  progress.begin("recording");
  auto records = record(cameras, kPictures, kPatience);
  for (std::size_t n = 0; n < records.size(); ++n) {
    if (!records[n]) return tl::unexpected(records[n].error());
    SetupCamera camera;
    camera.name = name_of((*found)[n], *records[n], setup);
    camera.back_end = (*found)[n].back_end;
    camera.record = std::move(*records[n]);
    if (std::ranges::count(setup.cameras, camera.name, &SetupCamera::name) > 0) {
      return fail("two cameras are named " + camera.name);
    }
    setup.cameras.push_back(std::move(camera));
  }
  return {};
}

/// Error, after the text: a camera is left out.
Result<std::string> said(const SetupOptions& o, const Setup& setup) {
  const auto site = o.folder / kSiteFile;
  std::string text = o.json ? setup_json(setup, site) : setup_text(setup, site);
  const auto all = left_out(setup);
  if (all.empty()) return text;
  std::cout << text << std::flush;
  std::string names;
  for (const std::string& name : all) names += (names.empty() ? "" : ", ") + name;
  return fail("left out of merged and measured views: " + names);
}

CliResult<std::string> set_up(const SetupOptions& o) {
  if (o.folder.empty()) return usage_error("give the site's folder, -o DIR");
  Setup setup;
  Progress progress;
  if (auto free = check_place(o.folder, o.force); !free) return tl::unexpected(free.error());
  if (auto read = read_machine(o, setup); !read) return tl::unexpected(read.error());
  if (auto done = record_cameras(o, setup, progress); !done) return tl::unexpected(done.error());
  if (auto read = read_cameras(o, setup); !read) return tl::unexpected(read.error());
  return align_cameras(setup, o.folder, progress)
      .and_then([&] { return place_site(setup, o.folder); })
      .and_then([&] { return said(o, setup); });
}

}  // namespace

CliResult<std::string> setup_command(const Arguments& arguments) {
  SetupOptions o;
  return run_command(arguments,
                     {.usage = kSetupUsage, .options = setup_options(o), .notes = kSetupNotes},
                     [&](const auto&) { return set_up(o); });
}

}  // namespace orbwatch::app::cli
