// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/model/configuration/device_files.h"
#include "app/model/configuration/device_update.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

template <class Visitor>
void visit(Visitor& v, DeviceFiles::CameraAddress& camera) {
  v.required("camera", camera.camera, "Name of the camera");
  v.required("address", camera.address, "Its device here: serial number, id or device node");
}

template <class Visitor>
void visit(Visitor& v, DeviceFiles::Restore& restore) {
  v.required("passphrase", restore.passphrase,
             "Of the backup; null: this device's users, certificates and keys are kept");
  v.optional("cameras", restore.cameras, "Cameras that are other devices here");
  v.optional("events", restore.events, "Also the kept events of the backup");
}

}  // namespace orbwatch::app

/// Bodies and answers of DeviceDesk.
namespace orbwatch::app::web {

/// Kinds of the files that can be made.
enum class DeviceFile { Support, Backup };
inline constexpr std::array kDeviceFiles{Word{"support", DeviceFile::Support},
                                         Word{"backup", DeviceFile::Backup}};

struct SupportBody {
  bool pictures = false;
};
template <class Visitor>
void visit(Visitor& v, SupportBody& body) {
  v.optional("pictures", body.pictures, "Also the newest pictures");
}

struct BackupBody {
  std::optional<std::string> passphrase;
  bool events = false;
};
template <class Visitor>
void visit(Visitor& v, BackupBody& body) {
  v.required("passphrase", body.passphrase,
             "Encrypts users, certificates and keys; null: they are left out");
  v.optional("events", body.events, "Also the recorder's events that are kept");
}

struct MadeAnswer {
  std::uint64_t bytes = 0;
  std::string report;
};
template <class Visitor>
void visit(Visitor& v, MadeAnswer& answer) {
  v.required("bytes", answer.bytes, "Size", "B");
  v.required("report", answer.report, "Lines about its contents");
}

struct DeviceFileQuery {
  DeviceFile file = DeviceFile::Support;
};
template <class Visitor>
void visit(Visitor& v, DeviceFileQuery& query) {
  v.required("file", query.file, kDeviceFiles, "Kind of the file");
}

struct UploadBody {
  std::uint64_t offset = 0;
  std::string bytes;
};
template <class Visitor>
void visit(Visitor& v, UploadBody& body) {
  v.required("offset", body.offset, "Place of the bytes in the file; 0 begins a new one", "B");
  v.required("bytes", body.bytes, "The next bytes of the file in Base64");
}

struct UploadAnswer {
  std::uint64_t size = 0;
};
template <class Visitor>
void visit(Visitor& v, UploadAnswer& answer) {
  v.required("size", answer.size, "Size of what has arrived, the next offset", "B");
}

/// A restore, of the backup that was checked if its hash is stated.
struct RestoreBody {
  DeviceFiles::Restore restore;
  std::optional<std::string> sha256;
};
template <class Visitor>
void visit(Visitor& v, RestoreBody& body) {
  visit(v, body.restore);
  v.optional("sha256", body.sha256,
             "SHA-256 as POST /api/v1/check_restore returned it: 409 if another backup was "
             "uploaded since then; without it the newest upload is restored");
}

struct ChangedFile {
  std::string file;
  std::string change;
};
template <class Visitor>
void visit(Visitor& v, ChangedFile& changed) {
  v.required("file", changed.file, "Folder and name");
  v.required("change", changed.change, "new, changed or same");
}

struct RestoredCamera {
  std::string name;
  std::string key;
  std::string address;
};
template <class Visitor>
void visit(Visitor& v, RestoredCamera& camera) {
  v.required("name", camera.name, "Name of the camera");
  v.required("key", camera.key, "Key of the configuration with its device");
  v.required("address", camera.address, "Its device: serial number, id or device node");
}

/// Contents of a backup, compared with this device.
struct ContentsAnswer {
  std::string host, made, version;
  std::vector<ChangedFile> changes;
  std::vector<std::string> not_restored, left_out;
  std::vector<RestoredCamera> cameras;
  std::vector<std::string> notes;
};
template <class Visitor>
void visit(Visitor& v, ContentsAnswer& answer) {
  v.required("host", answer.host, "Name of the device of the backup");
  v.required("made", answer.made, "Time of the backup, UTC");
  v.required("version", answer.version, "Version of its program");
  v.required("changes", answer.changes, "Files of the backup, compared with the present ones");
  v.required("not_restored", answer.not_restored, "Files with secrets that are not restored");
  v.required("left_out", answer.left_out, "Other files that the backup does not have");
  v.required("cameras", answer.cameras, "Cameras that are one device each");
  v.required("notes", answer.notes, "Other settings that depend on the device");
}

/// Contents of a checked backup.
struct CheckAnswer {
  ContentsAnswer contents;
  std::string sha256;
};
template <class Visitor>
void visit(Visitor& v, CheckAnswer& answer) {
  visit(v, answer.contents);
  v.required("sha256", answer.sha256,
             "SHA-256 of the uploaded file in hexadecimal digits, for POST /api/v1/restore");
}

/// Text that confirms a factory reset.
inline constexpr const char* kResetWords = "factory reset";

struct ResetBody {
  std::string confirmation;
};
template <class Visitor>
void visit(Visitor& v, ResetBody& body) {
  v.required("confirmation", body.confirmation, "The words: factory reset");
  v.require(body.confirmation == kResetWords, "confirmation must be: factory reset");
}

/// State of updates; has_slots is false on a computer that does not run an image.
struct UpdateAnswer {
  bool has_slots = false;
  DeviceUpdate::State state;
};
inline constexpr std::array kUpdateTrials{Word{"kept", DeviceUpdate::Trial::Kept},
                                          Word{"on_trial", DeviceUpdate::Trial::OnTrial},
                                          Word{"installed", DeviceUpdate::Trial::Installed},
                                          Word{"returned", DeviceUpdate::Trial::Returned}};
inline constexpr std::array kUpdateWorks{Word{"none", DeviceUpdate::Work::None},
                                         Word{"uploading", DeviceUpdate::Work::Uploading},
                                         Word{"checking", DeviceUpdate::Work::Checking},
                                         Word{"installing", DeviceUpdate::Work::Installing}};
template <class Visitor>
void visit(Visitor& v, UpdateAnswer& answer) {
  DeviceUpdate::State& state = answer.state;
  v.required("has_slots", answer.has_slots,
             "The device runs an image with two slots; otherwise updates come by packages");
  v.required("version", state.version, "Version of the running image");
  v.required("slot", state.slot, "Running slot: a or b");
  v.required("trial", state.trial, kUpdateTrials,
             "Result of the newest update: the running version is kept or on trial, or another one "
             "is installed and tried at the next start, or the device returned from it");
  v.required("other", state.other, "Version that is installed, or that the device returned from");
  v.required("reason", state.reason, "Why it returned");
  v.required("kept_in", state.kept_in,
             "Time until a version on trial is kept; null: it does not work at present", "s");
  v.required("returns_in", state.returns_in,
             "Time until the device returns from a version on trial that does not work", "s");
  v.required("refusal", state.refusal, "Why no update is accepted at present; empty: it is");
  v.required("work", state.work, kUpdateWorks, "Upload or installation under way");
  v.required("percent", state.percent, "Progress of the work", "%");
  v.required("step", state.step, "Step of the installation, in the words of RAUC");
  v.required("failure", state.failure,
             "Why the newest upload or installation failed; empty: it did not");
}

struct UploadUpdateBody {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
  std::string bytes;
};
template <class Visitor>
void visit(Visitor& v, UploadUpdateBody& body) {
  v.required("offset", body.offset, "Place of the bytes in the file; 0 begins a new one", "B");
  v.required("size", body.size, "Size of the whole file", "B");
  v.required("bytes", body.bytes, "The next bytes of the file in Base64");
}

}  // namespace orbwatch::app::web
