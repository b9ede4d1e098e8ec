// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <string>

#include "app/cli/archive/compression.h"
#include "app/cli/archive/tar.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/progress.h"
#include "app/cli/support/support_file.h"
#include "app/files/runtime/site_file.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kSupportUsage =
    "Usage: orbwatch support -o FILE [options]\n\n"
    "Writes one file for technical support: findings of orbwatch doctor, versions, journal,\n"
    "figures of the running orbwatchd, configuration. It has no secret: passwords, keys, tokens,\n"
    "codes and the comments of the configuration are removed. contents.txt in it lists what could\n"
    "not be read. Run it as root, who may read all. FILE is accessible to its owner only.\n\n";

struct SupportOptions {
  std::filesystem::path output;
  std::filesystem::path config;
  std::filesystem::path figures;
  bool pictures = false;
};

CliResult<std::string> write_support_file(const SupportOptions& o) {
  if (o.output.empty()) return usage_error("-o FILE is missing");
  Progress progress;
  progress.begin("collecting");
  const auto file = support::support_file(support::this_computer(o.config, o.figures), o.pictures);
  progress.begin("writing");
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const auto written = tar_of(file.files, now)
                           .and_then([](const std::string& tar) { return compressed(tar); })
                           .and_then([&](const std::string& bytes) {
                             return hal::write_file(o.output, bytes, hal::FileAccess::Owner);
                           });
  progress.erase();
  if (!written) return tl::unexpected(written.error());
  std::string text =
      o.output.string() + ": " + std::to_string(file.files.size()) + " files; left out:\n";
  for (const auto& [name, reason] : file.left_out)
    text.append("  ").append(name).append(": ").append(reason).append("\n");
  return text;
}

}  // namespace

CliResult<std::string> support_command(const Arguments& arguments) {
  SupportOptions o;
  return run_command(
      arguments,
      {.usage = kSupportUsage,
       .options = {{"output", 'o', "FILE", "archive to write, such as support.tar.zst",
                    text_option(o.output)},
                   {"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(o.config)},
                   {"figures", 0, "FOLDER",
                    "texts of the running orbwatchd, instead of asking it;\nfor the service",
                    text_option(o.figures)},
                   {"pictures", 0, "",
                    "also the next picture of each view, and the newest\nsnapshots",
                    flag_option(o.pictures)}},
       .notes = "\n`tar --zstd -xf FILE` unpacks it.\n"},
      [&](const auto&) {
        o.config = files::site_file(o.config);
        return write_support_file(o);
      });
}

}  // namespace orbwatch::app::cli
