// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/site_files.h"

#include <algorithm>

#include "app/cli/detect/overlay.h"
#include "app/cli/staged_folder.h"
#include "app/daemon/site/site_check.h"
#include "app/files/resolve.h"
#include "app/files/rig/camera_calibration.h"
#include "app/files/toml/toml_text.h"
#include "hal/atomic_file.h"
#include "hal/host.h"

namespace orbwatch::app::cli {
namespace {

std::string comments(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "# Missing: " + sentence + "\n";
  return text;
}

bool is_thermal(const SetupCamera& camera) {
  return camera.record.format.format == PixelFormat::Y16;
}

std::string camera_text(const SetupCamera& camera) {
  const hal::StreamFormat& format = camera.record.format;
  std::string text = "\n[[camera]]\n" + files::toml_line("name", files::toml_string(camera.name)) +
                     files::toml_line("width", std::to_string(format.width)) +
                     files::toml_line("height", std::to_string(format.height));
  if (format.frame_rate > 0)
    text += files::toml_line("frame_rate", files::toml_number(format.frame_rate));
  if (is_thermal(camera)) {
    text +=
        "# kelvin_per_count = 0.04       # of the camera's data sheet, if it is radiometric\n"
        "# kelvin_offset = 273.15        # besides, if its counts begin at 0 degC\n";
  }
  return text + back_end_text(camera.back_end);
}

std::string box_text(const optics::Box& box) {
  return files::toml_line("low", files::toml_vector(box.low)) +
         files::toml_line("high", files::toml_vector(box.high));
}

std::string lens_text(const SetupCamera& camera) {
  if (camera.calibration.empty()) return "";
  return "\n[camera.intrinsics]\n" +
         files::toml_line("file", files::toml_string(camera.name + ".yaml"));
}

std::string place_text(const Setup& setup, const SetupCamera& camera) {
  if (camera.pose) return "\n[camera.pose]\n" + toml_lines(files::toml_values(*camera.pose));
  std::string text = "\n[camera.outline]               # drawn into " + camera.name + ".png\n" +
                     toml_lines(files::toml_values(camera.ball.outline));
  if (!camera.lens) {
    const double distance =
        camera.distance ? *camera.distance / setup.ball_radius : kAssumedDistance;
    text +=
        files::toml_line("distance", files::toml_number(distance) +
                                         (camera.distance ? "" : "                   # assumed"));
  }
  if (!is_placed(setup, camera)) {
    return text +
           files::toml_line("registered",
                            "false              # nor is it shown beside others until it is");
  }
  return text + files::toml_line("rotation_matrix", files::toml_matrix(camera.registration));
}

std::string source_texts(const Setup& setup) {
  std::string text;
  for (const SetupCamera& camera : setup.cameras) {
    text += "\n[[view.source]]\n" + files::toml_line("camera", files::toml_string(camera.name));
    if (is_thermal(camera) && setup.cameras.size() > 1) {
      text += "weight = 0.5\ncolour_map = \"inferno\"\n";
    }
  }
  return text;
}

std::string page_text(PageClients page) {
  switch (page) {
    case PageClients::None:
      return "\n# [web]                          # these two lines switch the page on\n"
             "# enabled = true\n";
    case PageClients::Loopback:
      return "\n[web]\n"
             "enabled = true                   # http://localhost:8080/, for this computer only\n"
             "# address = \"0.0.0.0\"            # for others, too: https://HOST:8443/\n";
    case PageClients::Network:
      break;
  }
  const std::string name = hal::host_name();
  return "\n[web]\n"
         "enabled = true                   # http://localhost:8080/ on this computer\n"
         "address = \"0.0.0.0\"              # https://HOST:8443/ for others, by a password\n" +
         (name.empty() ? "" : files::toml_line("names", "[" + files::toml_string(name) + "]"));
}

std::string site_text(const Setup& setup) {
  std::string text =
      "# A site, as `orbwatch setup` wrote it. `orbwatch describe config` explains every key;\n"
      "# `orbwatchd --config FILE --check` checks all files.\n" +
      comments(setup.missing) + "\n" + files::toml_line("rig", files::toml_string(kRigFile)) +
      "\n[[recipe]]                       # what is measured\nnumber = 1\n" +
      files::toml_line("file", files::toml_string(kRecipeFile)) +
      "\n[modbus]\nport = 1502\n"
      "# address = \"192.168.1.10\"       # the machine network only; Modbus has no passwords\n"
      "# writers = [\"192.168.1.2\"]      # the PLC; without it only this computer may write\n"
      "\n[dds]\ndomain = 0\n" +
      page_text(setup.page);
  for (const SetupCamera& camera : setup.cameras) text += camera_text(camera);
  return text +
         "\n[[view]]                         # everything around the ball\n"
         "name = \"panorama\"\nkind = \"equirectangular\"\nwidth = 1024\nheight = 512\n" +
         source_texts(setup);
}

std::string rig_text(const Setup& setup) {
  const optics::Rig rig = rig_of(setup);
  std::string text =
      "# Where cameras, ball and machine stand, as `orbwatch setup` found it. `orbwatch describe "
      "rig`\n# explains every key.\n\n[ball]\n" +
      files::toml_line("centre", files::toml_vector(rig.ball.centre)) +
      files::toml_line("radius", files::toml_number(rig.ball.radius));
  if (rig.scene.room == optics::Scene::Room::Box) {
    text += "\n[scene]\nroom = \"box\"\n" + box_text(rig.scene.walls);
  }
  for (const NamedBox& obstacle : setup.obstacles) {
    text += "\n[[scene.obstacle]]\n" +
            (obstacle.remark.empty() ? "" : "# " + obstacle.remark + "\n") +
            files::toml_line("name", files::toml_string(obstacle.name)) + box_text(obstacle.box);
  }
  for (const SetupCamera& camera : setup.cameras) {
    const hal::StreamFormat& format = camera.record.format;
    text += "\n[[camera]]\n" + files::toml_line("name", files::toml_string(camera.name)) +
            files::toml_line("width", std::to_string(format.width)) +
            files::toml_line("height", std::to_string(format.height)) + lens_text(camera) +
            place_text(setup, camera);
  }
  return text;
}

std::string recipe_text(const Setup& setup) {
  const auto thermal = std::ranges::find_if(setup.cameras, [&](const SetupCamera& camera) {
    return is_thermal(camera) && is_placed(setup, camera);
  });
  const SetupCamera& measured = thermal == setup.cameras.end() ? setup.cameras.front() : *thermal;
  return "# The brightest place in front of the ball. `orbwatch describe recipe` explains every "
         "key.\n\nname = \"brightest\"\n\n[[view]]\nname = \"front\"\n" +
         files::toml_line("measured", files::toml_string(measured.name)) +
         "h_fov = 100\nwidth = 960\nheight = 540\n" + source_texts(setup) +
         "\n[[region]]\nname = \"front\"\nview = \"front\"\n"
         "hot_spot_threshold = 95          # percent of full scale\n";
}

/// Writes the site into `folder`.
Result<> write_site(const Setup& setup, const std::filesystem::path& folder) {
  for (const SetupCamera& camera : setup.cameras) {
    auto written = write_overlay(folder / (camera.name + ".png"),
                                 camera.record.pictures.front().picture, camera.ball.outline);
    if (written && camera.lens) {
      written = write_calibration(folder / (camera.name + ".yaml"), *camera.lens, camera.name,
                                  files::CalibrationFormat::Ros);
    }
    if (!written) return written;
  }
  constexpr auto kAccess = hal::FileAccess::Folder;
  return hal::write_file(folder / kRecipeFile, recipe_text(setup), kAccess)
      .and_then([&] { return hal::write_file(folder / kRigFile, rig_text(setup), kAccess); })
      .and_then([&] { return hal::write_file(folder / kSiteFile, site_text(setup), kAccess); });
}

/// Checks that the daemon would run it.
Result<> check_written(const std::filesystem::path& folder) {
  return files::resolve(folder / kSiteFile).and_then([](const files::Resolved& site) {
    return daemon::check_site(site, Dates::Ignored);
  });
}

}  // namespace

Result<> check_place(const std::filesystem::path& folder, bool overwrite) {
  for (const char* file : {kSiteFile, kRigFile, kRecipeFile}) {
    std::error_code error;
    if (!overwrite && std::filesystem::exists(folder / file, error)) {
      return fail((folder / file).string() + " exists already; --force overwrites it");
    }
  }
  return {};
}

Result<> place_site(const Setup& setup, const std::filesystem::path& folder) {
  auto staged = StagedFolder::beside(folder);
  if (!staged) return tl::unexpected(staged.error());
  const auto checked =
      write_site(setup, staged->path()).and_then([&] { return check_written(staged->path()); });
  if (!checked) return checked;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(folder.string() + ": cannot be made: " + error.message());
  return write_site(setup, folder);
}

}  // namespace orbwatch::app::cli
