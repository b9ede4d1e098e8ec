// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options/options.h"
#include "app/cli/setup/setup.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// The options of `orbwatch setup` as they were given.
struct SetupOptions {
  std::filesystem::path folder;
  double ball_diameter = 0;
  std::vector<std::string> cameras, calibrations, poses, distances, obstacles;
  std::string ball_centre, box;
  PageClients page = PageClients::Loopback;
  bool force = false;
  bool json = false;
};

/// The options; they write into `options`, which outlives them.
std::vector<Option> setup_options(SetupOptions& options);

/// Reads the options about ball and machine. Error: a missing or impossible value.
CliResult<> read_machine(const SetupOptions& options, Setup& setup);

/// Reads the options about the cameras of `setup`, which have their names and records. Error: also
/// an option for no camera.
CliResult<> read_cameras(const SetupOptions& options, Setup& setup);

}  // namespace orbwatch::app::cli
