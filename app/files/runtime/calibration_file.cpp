// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/calibration_file.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>
#include <utility>

#include "app/files/rig/rig_file.h"
#include "app/files/rig/rig_settings.h"
#include "app/files/toml/toml_reader.h"
#include "app/files/toml/toml_text.h"
#include "app/model/status/utc_text.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::files {
namespace {

struct BallCentreSettings {
  optics::Vec3 centre;
};

struct EntrySettings {
  int number = 0;
  std::string time, camera, method, quality;
  std::uint32_t rig = 0;
  std::optional<BallCentreSettings> ball;
  std::optional<optics::Pose> pose;
  std::optional<OutlineSettings> limb;
  std::optional<IntrinsicsSettings> lens;
};

struct CalibrationSettings {
  std::vector<Located<EntrySettings>> entries;
};

template <class Visitor>
void visit(Visitor& v, BallCentreSettings& ball) {
  v.required("centre", ball.centre, kAnyNumber, "mm, machine frame");
}

template <class Visitor>
void visit(Visitor& v, EntrySettings& entry) {
  v.required("number", entry.number, Range::between(1, 1e9), "Counts entries");
  v.required("time", entry.time, "When it was accepted, UTC");
  v.required("camera", entry.camera, "The camera's name in the rig");
  v.required("method", entry.method, "How it was found");
  v.required("quality", entry.quality, "What is known of its errors");
  v.required("rig", entry.rig, Range::between(0, 4294967295.0), "CRC-32 of the rig it is for");
  v.table("ball", entry.ball, "The ball's place");
  v.table("pose", entry.pose, "As in the rig");
  v.table("outline", entry.limb, "As in the rig");
  v.table("intrinsics", entry.lens, "As in the rig");
}

template <class Visitor>
void visit(Visitor& v, CalibrationSettings& file) {
  v.tables("entry", file.entries, 0, kMaxCalibrations, "Accepted alignments, oldest first");
}

CalibrationEntry entry_of(const EntrySettings& settings) {
  CalibrationEntry entry{settings.number,  settings.time, settings.method,
                         settings.quality, settings.rig,  {}};
  CameraAlignment camera{.camera = settings.camera, .pose = settings.pose};
  if (settings.limb) {
    camera.outline = outline(*settings.limb);
    if (settings.limb->registered) camera.registration = registration(*settings.limb);
  }
  if (const auto& lens = settings.lens) {
    camera.intrinsics.emplace();
    camera.intrinsics->fx = lens->fx;
    camera.intrinsics->fy = lens->fy;
    camera.intrinsics->cx = lens->cx.value_or(0);
    camera.intrinsics->cy = lens->cy.value_or(0);
  }
  if (settings.ball) entry.alignment.ball_centre = settings.ball->centre;
  entry.alignment.cameras.push_back(camera);
  return entry;
}

std::string text_of(const CalibrationEntry& entry) {
  const CameraAlignment& camera = camera_of(entry);
  std::string text = "\n[[entry]]\n" + toml_line("number", std::to_string(entry.number)) +
                     toml_line("time", toml_string(entry.time)) +
                     toml_line("camera", toml_string(camera.camera)) +
                     toml_line("method", toml_string(entry.method)) +
                     toml_line("quality", toml_string(entry.quality)) +
                     toml_line("rig", std::to_string(entry.rig));
  if (entry.alignment.ball_centre) {
    text += "[entry.ball]\n" + toml_line("centre", toml_vector(*entry.alignment.ball_centre));
  }
  if (const auto& lens = camera.intrinsics) {
    text += "[entry.intrinsics]\n" + toml_lines(toml_values(*lens));
  }
  if (camera.pose) {
    text += "[entry.pose]\n" + toml_lines(toml_values(*camera.pose));
  } else if (const auto& limb = camera.outline) {
    text += "[entry.outline]\n" + toml_lines(toml_values(*limb)) +
            (camera.registration ? toml_line("rotation_matrix", toml_matrix(*camera.registration))
                                 : toml_line("registered", "false"));
  }
  return text;
}

}  // namespace

std::filesystem::path calibration_file(const std::filesystem::path& state_folder) {
  return state_folder / "calibration.toml";
}

Result<std::uint32_t> rig_checksum(const std::filesystem::path& rig, const FileTexts& instead) {
  TextFiles files(instead);
  return load_rig(rig, files).map([&](const auto&) { return files.checksum(); });
}

Result<std::vector<CalibrationEntry>> load_calibrations(const std::filesystem::path& file,
                                                        TextFiles& files) {
  std::error_code error;
  const bool is_replaced = files.instead().contains(file);
  if (!is_replaced && !std::filesystem::exists(file, error) && !error) return {};
  const auto text = files.read(file, "a TOML file");
  if (!text) return tl::unexpected(text.error());
  Finding finding{file.string(), file.parent_path()};
  CalibrationSettings settings;
  read_toml(*text, settings, finding);
  if (finding.message) return fail(*finding.message);
  std::vector<CalibrationEntry> entries;
  for (const EntrySettings& entry : settings.entries) entries.push_back(entry_of(entry));
  return entries;
}

std::string calibrations_text(const std::vector<CalibrationEntry>& entries) {
  std::string text =
      "# Alignments that orbwatchd accepted, in force instead of what the rig file says.\n"
      "# `orbwatch calibration history` lists them, `orbwatch calibration restore` goes back.\n";
  const std::size_t kept = std::min(entries.size(), kMaxCalibrations);
  for (std::size_t n = entries.size() - kept; n < entries.size(); ++n) text += text_of(entries[n]);
  return text;
}

Result<> save_calibrations(const std::filesystem::path& file,
                           const std::vector<CalibrationEntry>& entries) {
  return hal::write_file(file, calibrations_text(entries), hal::FileAccess::Folder);
}

Result<std::filesystem::path> keep_damaged(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path kept;
  for (int n = 1; n == 1 || error == std::errc::file_exists; ++n) {
    kept = file.string() + ".damaged-" + std::to_string(n);
    fs::create_hard_link(file, kept, error);
  }
  if (!error) return kept;
  // A hard link to another user's file is refused (fs.protected_hardlinks), and some file systems
  // have none. A file that cannot be copied either is moved.
  if (fs::copy_file(file, kept, error)) return kept;
  fs::remove(kept, error);  // an incomplete copy
  fs::rename(file, kept, error);
  if (error) return fail(kept.string() + ": cannot be written: " + error.message());
  return kept;
}

std::vector<CalibrationEntry> in_force(const std::vector<CalibrationEntry>& entries,
                                       std::uint32_t rig) {
  std::vector<CalibrationEntry> newest;
  std::set<std::string> done;
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    if (entry->rig != rig) continue;
    const bool is_newest = done.insert(camera_of(*entry).camera).second;
    if (is_newest) newest.insert(newest.begin(), *entry);
  }
  return newest;
}

void accept(std::vector<CalibrationEntry>& entries, CalibrationEntry entry) {
  entry.number = entries.empty() ? 1 : entries.back().number + 1;
  entry.time = utc_text(std::chrono::system_clock::now()).value_or("");
  entries.push_back(std::move(entry));
}

}  // namespace orbwatch::app::files
