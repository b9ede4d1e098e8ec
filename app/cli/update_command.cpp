// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>
#include <system_error>

#include "app/cli/command.h"
#include "app/cli/doctor/program_output.h"
#include "app/cli/options/options.h"
#include "app/cli/progress.h"
#include "app/update/install_update.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kUpdateUsage =
    "Usage: orbwatch update BUNDLE [options]\n\n"
    "Installs an update on a device that runs an image of platform/build-image: checks that it is\n"
    "signed by the machine builder's key, whole, and newer, and writes it into the slot that does\n"
    "not run. At the next start the device tries it, and keeps it once frame sets and interfaces\n"
    "have worked for two minutes; otherwise it returns to the running version by itself.\n\n";

struct UpdateOptions {
  bool reboot = false;
  bool skip_failed = false;
};

CliResult<std::string> update_device(const UpdateOptions& o, const std::filesystem::path& bundle) {
  const update::ImageFiles image;
  if (auto may = update::check_device(image); !may) return tl::unexpected(may.error());
  std::error_code none;
  if (!std::filesystem::is_regular_file(bundle, none))
    return fail(bundle.string() + " is not a file");
  auto installer = update::Installer::connect();
  if (!installer) return tl::unexpected(installer.error());
  Progress progress;
  const auto version =
      update::install_update(image, *installer,
                             {.bundle = bundle,
                              .name = bundle.string(),
                              .skips_failed = o.skip_failed,
                              .on_progress = [&](int percent, const std::string& step) {
                                progress.count(step, static_cast<std::size_t>(percent), 100, "%");
                              }});
  if (!version) return tl::unexpected(version.error());
  const std::string text = "version " + *version + " is installed, and tried at the next start\n";
  if (!o.reboot) return text + "restart: systemctl reboot\n";
  if (!doctor::program_output("/usr/bin/systemctl", {"--no-block", "reboot"})) {
    return fail(text + "but systemctl does not restart the device");
  }
  return text;
}

}  // namespace

CliResult<std::string> update_command(const Arguments& arguments) {
  UpdateOptions o;
  return run_command(
      arguments,
      {.usage = kUpdateUsage,
       .options = {{"reboot", 0, "", "restart the device at once", flag_option(o.reboot)},
                   {"skip-failed", 0, "", "refuse the version that was tried last and not kept",
                    flag_option(o.skip_failed)}},
       .takes_words = true},
      [&](const std::vector<std::string>& words) -> CliResult<std::string> {
        if (words.size() != 1) return usage_error("say one BUNDLE");
        return update_device(o, std::filesystem::absolute(words.front()));
      });
}

}  // namespace orbwatch::app::cli
