// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/cli/archive/archive.h"
#include "app/cli/doctor/sources.h"
#include "app/files/configuration.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::support {

/// Sources of a support file; tests use trees and servers of their own.
struct SupportSources {
  doctor::Sources board;
  std::filesystem::path config;   ///< configuration file of orbwatchd
  std::string versions;           ///< program and libraries, a line each
  std::filesystem::path figures;  ///< folder with texts of the running daemon; empty: it is asked
  std::string environment;  ///< entries NAME=VALUE of this process, each with a zero at its end
  /// Body of the answer of the running daemon's HTTP interface. Error: it gives none.
  std::function<Result<std::string>(const WebSettings& web, const std::string& target)> page;
  /// Newest process state of the running daemon over DDS, as JSON. Error: none arrives.
  std::function<Result<std::string>(const DdsSettings& dds)> state;
};

/// Sources of this computer for the configuration file `config`. `figures` as in SupportSources.
SupportSources this_computer(const std::filesystem::path& config,
                             const std::filesystem::path& figures = {});

/// Part of a support file that is missing.
struct LeftOut {
  std::string name;
  std::string reason;
};

struct SupportFile {
  Archive files;  ///< contents.txt first, which lists all and what is left out
  std::vector<LeftOut> left_out;
};

/// Collects what helps to find a fault remotely: findings of `orbwatch doctor`, versions, journal,
/// figures of the running daemon, configuration, and its pictures if `with_pictures`. No part has a
/// secret: see Redaction. Changes nothing; waits for programs and for the daemon, each a limited
/// time. Must not be called while the environment is changed.
SupportFile support_file(const SupportSources& sources, bool with_pictures);

}  // namespace orbwatch::app::cli::support
