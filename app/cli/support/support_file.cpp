// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/support_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/cli/doctor/checks.h"
#include "app/cli/doctor/doctor_text.h"
#include "app/cli/doctor/gather.h"
#include "app/cli/doctor/program_output.h"
#include "app/cli/support/collection.h"
#include "app/cli/support/site_parts.h"
#include "app/files/resolve.h"
#include "app/health/system_file.h"
#include "app/state/state_folder.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::support {
namespace {

namespace fs = std::filesystem;

Result<std::string> output_of(const SupportSources& sources, const fs::path& program,
                              const std::vector<std::string>& arguments,
                              const doctor::ProgramLimits& limits = {}) {
  if (!sources.board.has(program)) return fail(program.string() + " is not installed");
  if (auto text = doctor::program_output(sources.board.at(program), arguments, limits)) {
    return std::move(*text);
  }
  return fail(program.string() + " failed, printed too much or did not end in time");
}

/// Lines of the journal, as many as fit.
Result<std::string> journal(const SupportSources& sources, std::vector<std::string> selection) {
  constexpr doctor::ProgramLimits kLimits{std::chrono::seconds(20), std::size_t{8} << 20};
  constexpr std::array kLines{"20000", "2000"};
  selection.insert(selection.end(), {"--no-pager", "--quiet", "--output=short-iso-precise",
                                     "--since=-14days", "--lines"});
  Result<std::string> text;
  for (const char* lines : kLines) {
    auto arguments = selection;
    arguments.emplace_back(lines);
    text = output_of(sources, "/usr/bin/journalctl", arguments, kLimits);
    if (text) break;
  }
  if (text && text->empty()) {
    return fail("no line in 14 days, or not permitted; root may read the journal");
  }
  return text;
}

void add_diagnoses(const SupportSources& sources, Collection& to) {
  const auto diagnoses = doctor::diagnose(doctor::gather(sources.board, sources.config));
  to.add("doctor.txt", doctor::doctor_table(diagnoses));
  to.add("doctor.json", doctor::doctor_json(diagnoses));
}

Result<std::string> system_text(const SupportSources& sources, const char* file) {
  auto text = read_system_file(sources.board.at(file));
  if (!text) return fail(std::string(file) + " cannot be read");
  // The name of the board ends with a zero.
  std::erase(*text, '\0');
  if (!text->ends_with('\n')) *text += '\n';
  return std::move(*text);
}

void add_system(const SupportSources& sources, Collection& to) {
  const std::string unit = unit_of(sources.config);
  to.add("versions.txt", sources.versions);
  to.add("system/os-release.txt", system_text(sources, "/etc/os-release"));
  to.add("system/kernel.txt", system_text(sources, "/proc/version"));
  to.add("system/kernel-options.txt", system_text(sources, "/proc/cmdline"));
  to.add("system/board.txt", system_text(sources, "/proc/device-tree/model"));
  to.add("system/packages.txt", output_of(sources, "/usr/bin/dpkg-query", {"--show"}));
  to.add("system/service.txt",
         output_of(sources, "/usr/bin/systemctl",
                   {"show", unit,
                    "--property=ActiveState,SubState,Result,NRestarts,ExecMainStatus,"
                    "ExecMainStartTimestamp,MemoryCurrent,FragmentPath,DropInPaths"}));
  to.add("journal/service.txt", journal(sources, {"--unit", unit}));
  to.add("journal/kernel.txt", journal(sources, {"--dmesg"}));
}

/// Texts that the running daemon wrote for this support file.
void add_written_figures(const fs::path& folder, Collection& to) {
  constexpr std::size_t kMostBytes = std::size_t{16} << 20;
  std::vector<fs::path> files = entries(folder);
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    to.add("running/" + file.filename().string(), hal::read_regular_file(file, kMostBytes));
  }
  if (files.empty()) to.leave_out("running/", folder.string() + " has no files");
}

/// Figures of the running daemon over HTTP, which needs a login once there are users.
void add_asked_figures(const SupportSources& sources, const files::Configuration& site,
                       Collection& to) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kTargets{
      {{"running/status.json", "/api/v1/status"},
       {"running/metrics.txt", "/metrics"},
       {"running/figures.csv", "/api/v1/history/figures.csv"},
       {"running/alarms.json", "/api/v1/history/alarms"}}};
  const auto& web = std::get<WebSettings>(site.sinks);
  for (const auto& [name, target] : kTargets) {
    to.add(name, web.enabled ? sources.page(web, target) : fail("[web] is not enabled"));
  }
}

void add_figures(const SupportSources& sources, const files::Configuration& site, Collection& to) {
  if (sources.figures.empty()) {
    add_asked_figures(sources, site, to);
  } else {
    add_written_figures(sources.figures, to);
  }
  const auto& dds = std::get<DdsSettings>(site.sinks);
  to.add("running/state.json", dds.enabled ? sources.state(dds) : fail("[dds] is not enabled"));
}

/// Percent-encodes (RFC 3986).
std::string encoded(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) {
      out += c;
    } else {
      out += {'%', kDigits[byte >> 4], kDigits[byte & 15U]};
    }
  }
  return out;
}

/// The next picture of each view, and the newest pictures of the command snapshot.
void add_pictures(const SupportSources& sources, const files::Configuration& site,
                  const std::vector<std::string>& views, Collection& to) {
  const auto& web = std::get<WebSettings>(site.sinks);
  for (const std::string& view : views) {
    to.add_picture("pictures/views/" + encoded(view) + ".jpg",
                   web.enabled ? sources.page(web, "/snapshot.jpg?view=" + encoded(view))
                               : fail("[web] is not enabled"));
  }
  add_snapshots(std::get<SnapshotSettings>(site.sinks).folder, to);
}

/// Views of a configuration whose recipes cannot be read.
std::vector<std::string> views_of(const files::Configuration& site) {
  std::vector<std::string> views;
  for (const auto& view : site.views) views.push_back(view.name);
  return views;
}

}  // namespace

SupportFile support_file(const SupportSources& sources, bool with_pictures) {
  const auto resolved = files::resolve(sources.config);
  const auto site =
      resolved ? Result<files::Configuration>(resolved->site) : files::read_site(sources.config);
  const SiteFolders folders =
      site_folders(sources.config, site ? &*site : nullptr, sources.board.at("/var/lib"));
  Collection collection(secrets_of(folders, sources.board.at("/proc"), sources.environment));
  add_diagnoses(sources, collection);
  add_system(sources, collection);
  add_configuration(folders, resolved ? resolved->texts : files::FileTexts{}, collection);
  add_state(folders, collection);
  if (site) {
    add_figures(sources, *site, collection);
  } else {
    collection.leave_out("running/", "the configuration cannot be read: " + site.error().message);
  }
  if (site && with_pictures) {
    add_pictures(sources, *site, resolved ? resolved->names.views : views_of(*site), collection);
  } else {
    collection.leave_out("pictures/", with_pictures ? "the configuration cannot be read"
                                                    : "not asked for by --pictures");
  }
  return std::move(collection).finish();
}

}  // namespace orbwatch::app::cli::support
