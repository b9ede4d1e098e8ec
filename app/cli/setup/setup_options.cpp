// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/setup_options.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "app/cli/setup/stated_rotation.h"
#include "app/files/plain_names.h"
#include "app/files/rig/camera_calibration.h"

namespace orbwatch::app::cli {
namespace {

constexpr std::array kPageClients{Word{"none", PageClients::None},
                                  Word{"loopback", PageClients::Loopback},
                                  Word{"network", PageClients::Network}};

/// `word` as NAME=VALUE; without a name, `otherwise`.
std::pair<std::string, std::string> named(const std::string& word, const std::string& otherwise) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || !files::is_plain_name(word.substr(0, equals))) {
    return {otherwise, word};
  }
  return {word.substr(0, equals), word.substr(equals + 1)};
}

CliResult<std::vector<double>> numbers(const char* option, const std::string& text,
                                       std::size_t count) {
  auto values = parse_numbers(option, text);
  if (values && values->size() != count) {
    return usage_error(std::string("--") + option + " has " + std::to_string(values->size()) +
                       " numbers; it takes " + std::to_string(count));
  }
  return values;
}

optics::Vec3 vector(const std::vector<double>& v, std::size_t at) {
  return {v[at], v[at + 1], v[at + 2]};
}

CliResult<optics::Box> box(const char* option, const std::string& text) {
  return numbers(option, text, 6).map([](const auto& v) {
    return optics::Box{vector(v, 0), vector(v, 3)};
  });
}

/// The camera that an option's value is for.
CliResult<SetupCamera*> camera_of(Setup& setup, const char* option, const std::string& name) {
  if (name.empty() && setup.cameras.size() == 1) return &setup.cameras.front();
  const auto found = std::ranges::find(setup.cameras, name, &SetupCamera::name);
  if (found != setup.cameras.end()) return &*found;
  std::string names;
  for (const SetupCamera& camera : setup.cameras)
    names += (names.empty() ? "" : ", ") + camera.name;
  return usage_error(
      std::string("--") + option + ": " +
      (name.empty() ? "say whose it is, as NAME=..." : "there is no camera " + name) +
      "; there are: " + names);
}

CliResult<> read_calibration_of(SetupCamera& camera, const std::string& file) {
  files::TextFiles files;
  const auto lens = read_calibration(file, files);
  if (!lens) return tl::unexpected(lens.error());
  const hal::StreamFormat& format = camera.record.format;
  if (lens->width != format.width || lens->height != format.height) {
    return fail(file + " is for pictures of " + std::to_string(lens->width) + "x" +
                std::to_string(lens->height) + ", " + camera.name + " delivers " +
                std::to_string(format.width) + "x" + std::to_string(format.height));
  }
  camera.calibration = file;
  camera.lens = *lens;
  return {};
}

CliResult<> read_pose_of(SetupCamera& camera, const std::string& text) {
  const auto v = numbers("pose", text, 12);
  if (!v) return tl::unexpected(v.error());
  const auto stated = stated_rotation({vector(*v, 3), vector(*v, 6), vector(*v, 9)});
  if (!stated) return usage_error("--pose of " + camera.name + ": " + stated.error().message);
  camera.pose = optics::Pose{stated->rotation, vector(*v, 0)};
  camera.pose_change = stated->change;
  return {};
}

CliResult<> read_distance_of(SetupCamera& camera, const std::string& text) {
  const auto mm = parse_number("distance", text);
  if (!mm) return tl::unexpected(mm.error());
  if (!(*mm > 0)) return usage_error("--distance is " + text + "; it must be above 0 mm");
  camera.distance = *mm;
  return {};
}

/// Applies each of an option's values to its camera.
CliResult<> for_cameras(Setup& setup, const char* option, const std::vector<std::string>& words,
                        CliResult<> (*read)(SetupCamera&, const std::string&)) {
  for (const std::string& word : words) {
    const auto [name, value] = named(word, "");
    const auto camera = camera_of(setup, option, name);
    if (!camera) return tl::unexpected(camera.error());
    if (auto done = read(**camera, value); !done) return done;
  }
  return {};
}

/// Error: a camera would stand in the ball.
CliResult<> check_distances(const Setup& setup) {
  for (const SetupCamera& camera : setup.cameras) {
    if (!camera.distance || *camera.distance > setup.ball_radius) continue;
    std::ostringstream text;
    text << "--distance " << camera.name << "=" << *camera.distance
         << ": the camera would be in the ball, whose radius is " << setup.ball_radius
         << " mm; give the distance from the camera to the ball's centre, mm";
    return usage_error(text.str());
  }
  return {};
}

}  // namespace

std::vector<Option> setup_options(SetupOptions& o) {
  return {
      {"output", 'o', "DIR", "folder of the site", text_option(o.folder)},
      {"ball-diameter", 0, "MM", "of the mirror ball",
       number_option("ball-diameter", o.ball_diameter)},
      {"camera", 0, "[NAME=]SOURCE",
       "repeatable; the first is what the others are registered\nto; else all that are connected",
       list_option(o.cameras)},
      {"calibration", 0, "[NAME=]FILE", "of a camera, as OpenCV or ROS write it; repeatable",
       list_option(o.calibrations)},
      {"distance", 0, "[NAME=]MM",
       "from a camera without calibration to the ball's centre,\nby tape; repeatable",
       list_option(o.distances)},
      {"pose", 0, "[NAME=]X,Y,Z,R..",
       "of a camera in the machine: position, mm, and the 3x3\nmatrix by rows, as [camera.pose] "
       "in a rig, with four\ndecimals or more; repeatable",
       list_option(o.poses)},
      {"ball-centre", 0, "X,Y,Z", "in the machine, mm; else by --pose", text_option(o.ball_centre)},
      {"box", 0, "X,Y,Z,X,Y,Z", "the enclosure: its lowest and its highest corner, mm",
       text_option(o.box)},
      {"obstacle", 0, "[NAME=]X,Y,Z,X,Y,Z", "a box within: table, spindle; repeatable",
       list_option(o.obstacles)},
      {"page", 0, joined(kPageClients),
       "the page in a browser: off, for this computer\n(default), or for others, too",
       word_option("page", kPageClients, o.page)},
      {"force", 0, "", "overwrite the files of DIR", flag_option(o.force)},
      {"json", 0, "", "for programs", flag_option(o.json)},
  };
}

CliResult<> read_machine(const SetupOptions& o, Setup& setup) {
  if (!(o.ball_diameter > 0)) return usage_error("give --ball-diameter, above 0 mm");
  setup.ball_radius = o.ball_diameter / 2;
  setup.page = o.page;
  if (!o.ball_centre.empty()) {
    const auto centre = numbers("ball-centre", o.ball_centre, 3);
    if (!centre) return tl::unexpected(centre.error());
    setup.ball_centre = vector(*centre, 0);
  }
  if (!o.box.empty()) {
    const auto walls = box("box", o.box);
    if (!walls) return tl::unexpected(walls.error());
    setup.walls = *walls;
  }
  for (const std::string& word : o.obstacles) {
    const auto [name, text] = named(word, "obstacle" + std::to_string(setup.obstacles.size() + 1));
    const auto obstacle = box("obstacle", text);
    if (!obstacle) return tl::unexpected(obstacle.error());
    setup.obstacles.push_back({name, *obstacle, ""});
  }
  const bool knows_where = !o.poses.empty() || setup.ball_centre;
  if ((setup.walls || !setup.obstacles.empty()) && !knows_where) {
    return usage_error(
        "--box and --obstacle are in the machine's axes, in which nothing else is known; "
        "give --pose or --ball-centre, too");
  }
  return {};
}

CliResult<> read_cameras(const SetupOptions& o, Setup& setup) {
  return for_cameras(setup, "calibration", o.calibrations, read_calibration_of)
      .and_then([&] { return for_cameras(setup, "pose", o.poses, read_pose_of); })
      .and_then([&] { return for_cameras(setup, "distance", o.distances, read_distance_of); })
      .and_then([&] { return check_distances(setup); });
}

}  // namespace orbwatch::app::cli
